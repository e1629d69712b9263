"""Every face documents its parameters; every table of names fits the faces."""

import pytest

from mien.core import ParameterTable
from mien.faces.keypose.table import standard_table
from mien.vocab import load_remap, load_rules, targets, vocabularies, vocabulary
from mien.vocab.posing import MOTORS
from mien.vocab.remap import HALVES, whole
from mien.vocab.rules import KINDS
from mien.vocab.tables import shipped_rows, shipped_tables
from support import FACE_NAMES, face

# What a value is counted in. A share goes from 0 to 1 or from -1 to 1.
UNITS = {
    "deg",
    "m",
    "s",
    "share",
    "factor",
    "Parke unit",
    "linear light",
    "iris radius",
    "mm",
    "eyeball radius",
    "drawing unit",
    "1/m",
    "phase",
}

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


def tables(target):
    """The tables that a remap ends in: of a vocabulary, or of each face of a family."""
    if target in vocabularies():
        return [vocabulary(target)]
    found = {id(face(name).parameters): face(name).parameters for name in FACE_NAMES if face(name).family == target}
    assert found, f"no installed face is of the family {target!r}"
    # Nobody has been measured in every standard phase.
    return [*found.values(), *([standard_table()] if target == "keypose" else [])]


def played(target):
    """All names that a remap can end in: a face of a family need not have all of them, but one of them has each."""
    return ParameterTable(tuple({row.name: row for table in tables(target) for row in table}.values()))


REMAPS = [(name, target) for name in vocabularies() for target in targets(name)]


@pytest.mark.parametrize(("name", "target"), REMAPS)
def test_both_sets_of_names_in_a_table_exist(name, target):
    remap = load_remap(name, target)
    remap.check(vocabulary(name), played(target))
    assert remap.from_names
    assert all(link.source for link in remap.links)


@pytest.mark.parametrize(("name", "target"), [remap for remap in REMAPS if remap[0] != "channels"])
def test_no_name_goes_past_the_end_of_a_range(name, target):
    for table in tables(target):
        remap = load_remap(name, target).on(table)
        for each in remap.from_names:
            for moved, pushes in [*remap.pushes({each: 1.0}).items(), *remap.moves({each: 1.0}).items()]:
                row = table[moved]
                assert row.low <= row.default + pushes[0][0] <= row.high, f"{name}.{target}.csv: {each}, {moved}"
            for moved, factor in remap.scale({each: 1.0}).items():
                assert 0.0 <= factor <= 1.0, f"{name}.{target}.csv: {each}, {moved}"
                assert table[moved].low <= 0.0, f"{name}.{target}.csv: {moved} does not go down to 0"


@pytest.mark.parametrize(("name", "target"), REMAPS)
def test_shares_of_a_range_are_counted_upwards_from_rest(name, target):
    # A turn to either side would go as far to the one as to the other.
    table = vocabulary(name)
    for link in load_remap(name, target).links:
        assert link.blend != "share" or table[whole(link.name)].low == 0.0, link


@pytest.mark.parametrize(("name", "target"), REMAPS)
def test_no_parameter_has_two_names_that_say_where_it_is(name, target):
    placed = [
        link.parameter for link in load_remap(name, target).links if link.blend == "set" and link.name[-1] not in HALVES
    ]
    assert len(placed) == len(set(placed))


def test_no_face_calls_a_parameter_what_a_vocabulary_calls_something_else():
    # Motor codes are looked for where a face has no parameter of that name.
    for name in FACE_NAMES:
        own = {*face(name).parameters.names, *face(name).parameters.symmetric}
        assert not own & {*vocabulary(MOTORS).names, *vocabulary(MOTORS).aliases}


@pytest.mark.parametrize("name", vocabularies())
def test_names_of_a_vocabulary_are_described(name):
    for row in vocabulary(name):
        assert row.low <= 0.0 <= row.high, row.name
        assert row.doc[:1].isupper(), row.name
        assert row.doc.endswith("."), row.name
        assert row.group, row.name
        assert row.source, row.name


@pytest.mark.parametrize("name", shipped_tables())
def test_rows_of_a_table_fill_its_columns(name):
    for row in shipped_rows(name):
        assert None not in row, row
        assert None not in row.values(), row


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
    assert set(shipped_tables()) == listed | {f"{name}.{target}" for name, target in REMAPS}
