"""Every face documents its parameters; every table of names fits the faces."""

import pytest

from mien.vocab import families, load_remap, load_rules, vocabularies, vocabulary
from mien.vocab.rules import KINDS
from mien.vocab.tables import shipped_tables
from support import FACE_NAMES, face

# What a value is counted in. A share goes from 0 to 1 or from -1 to 1.
UNITS = {"deg", "m", "s", "share", "factor", "Parke unit", "linear light", "iris radius", "eyeball radius"}

every_face = pytest.mark.parametrize("name", FACE_NAMES)


@every_face
def test_every_parameter_has_a_unit_a_group_a_doc_and_a_source(name):
    for row in face(name).parameters:
        assert row.unit in UNITS, row.name
        assert row.group, row.name
        assert row.source, row.name
        assert row.doc[:1].isupper(), f"{row.name}: {row.doc!r} is no sentence"


@every_face
def test_parameter_names_are_region_action_and_side(name):
    for row in face(name).parameters:
        parts = row.name.split(".")
        assert len(parts) >= 2, row.name
        assert all(part.isidentifier() and part == part.lower() for part in parts), row.name


@every_face
def test_presets_are_described(name):
    for key, preset in face(name).presets.items():
        assert key == preset.name
        assert preset.kind, key
        assert preset.doc, key


def family(name):
    return next((face(known) for known in FACE_NAMES if face(known).family == name), None)


REMAPS = [(name, kind) for name in vocabularies() for kind in families(name)]


@pytest.mark.parametrize(("name", "kind"), REMAPS)
def test_both_sets_of_names_in_a_table_exist(name, kind):
    subject, remap = family(kind), load_remap(name, kind)
    assert subject is not None, f"{name}.{kind}.csv: no installed face is of the family {kind!r}"
    remap.check(vocabulary(name), subject.parameters)
    assert remap.from_names
    assert all(remap.sources.values())


@pytest.mark.parametrize(("name", "kind"), [remap for remap in REMAPS if remap[0] != "channels"])
def test_no_name_goes_past_the_end_of_a_range(name, kind):
    table, remap = family(kind).parameters, load_remap(name, kind)
    for each in remap.from_names:
        for target, pushes in remap.pushes({each: 1.0}).items():
            row = table[target]
            assert row.low <= row.default + pushes[0][0] <= row.high, f"{name}.{kind}.csv: {each}, {target}"
        for target, factor in remap.scale({each: 1.0}).items():
            assert 0.0 <= factor <= 1.0, f"{name}.{kind}.csv: {each}, {target}"
            assert table[target].low <= 0.0, f"{name}.{kind}.csv: {target} does not go down to 0"


@pytest.mark.parametrize("name", vocabularies())
def test_names_of_a_vocabulary_are_described(name):
    for row in vocabulary(name):
        assert row.low <= 0.0 <= row.high, row.name
        assert row.doc[:1].isupper(), row.name
        assert row.group, row.name
        assert row.source, row.name


@pytest.mark.parametrize("name", vocabularies())
def test_rules_of_a_vocabulary_are_about_its_names(name):
    for rule in load_rules(name):
        assert rule.name in vocabulary(name).index, rule
        assert rule.other in vocabulary(name).index, rule
        assert rule.kind in KINDS, rule
        assert 0.0 < rule.share <= 1.0, rule
        assert rule.source, rule


def test_every_table_that_ships_is_read_by_something():
    listed = {"vocabularies", *vocabularies(), *(f"{name}_rules" for name in vocabularies() if load_rules(name))}
    assert set(shipped_tables()) == listed | {f"{name}.{kind}" for name, kind in REMAPS}
