"""``mien toon check``: each fault is found, and told with its place; faces without faults have none."""

import copy
import json
import re
from functools import cache
from importlib.resources import files

import numpy as np
import pytest
from jsonschema import Draft202012Validator

from mien.core import LoadError
from mien.faces.toon.checks import check_bytes
from mien.faces.toon.checks_faults import rules
from mien.faces.toon.checks_poses import find_wild_poses
from mien.faces.toon.checks_schema import find_mismatches
from mien.faces.toon.hands import SharedHand
from mien.faces.toon.polygons import Shape
from mien.faces.toon.reader import parse_toon
from mien.faces.toon.schema import toon_schema
from mien.faces.toon.shipped import FOLDER, SUFFIX, toon_names
from mien.faces.toon.starters import copied_text, starter_text
from support import ROOT

BASE = json.loads(starter_text("base"))
STRICT = json.loads(starter_text("base", "strict"))
NAMES = [polygon["id"] for polygon in BASE["polygons"]]
BOW = [[100, 100], [160, 160], [160, 100], [100, 150]]
REMOVE = object()
HAND = {"use": "cartoon", "at": [330, 380], "skin": "skin", "shade": "shade", "sleeve": "shirt", "fold": "shirt"}
KEY = {"time": 1, "values": {"HI": 1}}
VALIDATOR = Draft202012Validator(toon_schema())


def edit(place, value, base=BASE):
    """The base document with one value set or removed; a polygon is named by its id, - is a new one."""
    document = copy.deepcopy(base)
    *way, last = place
    here = document
    for key in way:
        ids = [polygon["id"] for polygon in document["polygons"]]
        here = here[ids.index(key) if here is document["polygons"] else key]
    if last == "-":
        here.append(value)
    elif value is REMOVE:
        del here[last]
    else:
        here[last] = value
    return document


def check(document, poses=0):
    return check_text(json.dumps(document, indent=1), poses)


@cache
def check_text(text, poses):
    return check_bytes(text.encode(), poses).faults


def polygon(**keys):
    return {"id": "new", "kind": "free", "fill": "skin", "path": [[10, 10], [30, 10], [20, 30]], **keys}


# Where the base is edited, to what; then the rule that tells of it, the place told, and words of the message.
FAULTS = [
    (["polygons", "nose", "colour"], "red", "unknown", "polygons[{}].colour", "unknown key 'colour'"),
    (["polygons", "nose", "fil"], "skin", "unknown", "polygons[{}].fil", "did you mean 'fill'?"),
    (["paltte"], {}, "unknown", "paltte", "did you mean 'palette' or 'palettes'"),
    (["version"], 2, "name", "version", "want 1, got 2"),
    (["version"], True, "name", "version", "got true"),
    (["format"], "mien-face", "name", "format", 'want "mien-toon"'),
    (["mode"], "strikt", "name", "mode", "did you mean 'strict'?"),
    (["size"], [400], "type", "size", "want [width, height] of 2, got [400]"),
    (["size"], [400, 0], "range", "size[1]", "from 1 to 100000, got 0"),
    (["size"], [400, float("nan")], "range", "size[1]", "got NaN"),
    (["size"], [400, float("inf")], "range", "size[1]", "got a number without end"),
    (["size"], [1e300, 400], "range", "size[0]", "got 1e+300"),
    (["size"], [True, 400], "type", "size[0]", "want a length, got true"),
    (["background"], 7, "type", "background", "got 7"),
    (["background"], "sky", "palette", "background", "unknown colour 'sky'"),
    (["palette", "skin"], "#E9A57", "color", "palette.skin", 'want a colour #rrggbb, got "#E9A57"'),
    (["palettes", "winter", "skim"], "#112233", "palette", "palettes.winter.skim", "did you mean 'skin'"),
    (["palette", "spare"], "#112233", "unseen", "palette.spare", "used by no polygon"),
    (["head"], REMOVE, "missing", "document", "'head' is missing"),
    (["head", "center"], [-200, 10], "canvas", "head.center", "outside the canvas"),
    (["features", "PR"], REMOVE, "missing", "features", "'PR' is missing"),
    (["features", "BR", "points", "BRC"], REMOVE, "missing", "features.BR.points", "'BRC' is missing"),
    (["features", "BR", "points", "BRX"], [1, 2], "unknown", "features.BR.points.BRX", "unknown key 'BRX'"),
    (["features", "BR", "points", "BRC"], [132, 166], "coincide", "features.BR.points.BRC", "is where BRL is"),
    (["features", "BR", "points", "BRC"], [132, 150], "coincide", "features.BR.points.BRC", "straight above"),
    (["features", "ER", "points", "ERO"], [190, 204], "order", "features.ER.points.ERO", "to the right of ERI"),
    (["features", "ER", "points", "ERU"], [158, 230], "order", "features.ER.points.ERU", "below ERL"),
    (["features", "PR", "points", "PR"], [300, 203], "order", "features.PR.points.PR", "to the right of PL"),
    (["features", "PR", "points", "PR"], [160, 300], "pupil", "features.PR.points.PR", "not inside the eye ER"),
    (["features", "M", "shape"], [[0, 1], [-1, 2]], "table", "features.M.shape[1]", "want above 0, got -1"),
    (["motors", "MB"], REMOVE, "missing", "motors", "'MB' is missing"),
    (["motors", "MB", "max"], REMOVE, "missing", "motors.MB", "'max' is missing"),
    (["motors", "ZZ"], {}, "unknown", "motors.ZZ", "unknown key 'ZZ'"),
    (["motors", "BRL"], {"min": 5, "max": -3}, "limits", "motors.BRL.min", "above the maximum, -3"),
    (["motors", "BRL"], {"min": 2, "max": 9}, "limits", "motors.BRL.min", "rest, 0, is not between 2 and 9"),
    (["motors", "BRL"], {"min": -9, "max": -2}, "limits", "motors.BRL.max", "rest, 0, is not between -9 and -2"),
    (["motors", "BRL"], {"min": 0, "max": 0}, "still", "motors.BRL.min", "nothing moves"),
    (["motors", "HH", "min_deg"], 5, "limits", "motors.HH.min_deg", "rest, 0, is not between 5 and 26"),
    (["motors", "PRH", "min_deg"], 0, "limits", "motors.PRH.min_deg", "is 0, but min is -10"),
    (["motors", "ERU", "min"], -10, "shut", "motors.ERU.min", "stops short of the lower one: want about -34, got -10"),
    (["motors", "BRL", "max"], "14", "type", "motors.BRL.max", 'want an offset of 0 or above, got "14"'),
    (["polygons"], {}, "type", "polygons", "is of another kind"),
    (["polygons"], [], "empty", "polygons", "is empty"),
    (["polygons", "-"], 7, "type", "polygons[{n}]", "want a polygon, got 7"),
    (["polygons", "nose", "id"], REMOVE, "missing", "polygons[{}]", "'id' is missing"),
    (["polygons", "nose", "id"], "face", "repeated id", "polygons[{}].id", "also the id of polygons[5]"),
    (["polygons", "nose", "kind"], "fre", "name", "polygons[{}].kind", "unknown kind 'fre' — did you mean 'free'"),
    (["polygons", "nose", "fill"], "skn", "palette", "polygons[{}].fill", "did you mean 'skin'"),
    (["polygons", "nose", "path"], REMOVE, "shape", "polygons[{}]", "has none of these: want path or span or stroke"),
    (["polygons", "nose", "stroke"], {"feature": "M"}, "shape", "polygons[{}]", "got path and stroke"),
    (["polygons", "lip line", "width"], REMOVE, "missing", "polygons[{}]", "'width' is missing"),
    (["polygons", "lip line", "width"], [[0, 3], [0, 5]], "table", "polygons[{}].width[1]", "want above 0, got 0"),
    (["polygons", "nose", "max"], "M1 1 L9 9 L1 9 Z", "missing", "polygons[{}]", "'min' is missing"),
    (["polygons", "chin", "motor"], REMOVE, "missing", "polygons[{}]", "'motor' is missing"),
    (["polygons", "chin", "motor"], "MX", "name", "polygons[{}].motor", "unknown motor code 'MX'"),
    (["polygons", "chin", "motor"], "EAR", "attached", "polygons[{}].motor", "unknown motor 'EAR'"),
    (["polygons", "chin", "max"], "M1 1 L9 9 L1 9 Z", "states", "polygons[{}].max", "differs from min from piece 2 on"),
    (["polygons", "chin", "max"], [[1, 1], [9, 9], [1, 9], [0, 3]], "states", "polygons[{}].max", "has 4 pieces"),
    (["polygons", "brow right", "feature"], "BX", "name", "polygons[{}].feature", "did you mean"),
    (["polygons", "-"], polygon(kind="feature"), "missing", "polygons[{n}]", "'feature' is missing"),
    (["polygons", "-"], polygon(kind="feature", feature="N"), "attached", "polygons[{n}].feature", "feature 'N'"),
    (["polygons", "-"], polygon(**{"with": "AR"}), "attached", "polygons[{n}].with", "unknown control point 'AR'"),
    (["polygons", "-"], polygon(part="hand"), "attached", "polygons[{n}].part", "unknown part 'hand'"),
    (["polygons", "-"], polygon(clip=["face", "hat"]), "attached", "polygons[{n}].clip", "unknown polygon 'hat'"),
    (["polygons", "-"], polygon(clip=[["face"]]), "type", "polygons[{n}].clip[0]", "want a name"),
    (["polygons", "-"], polygon(clip=7), "type", "polygons[{n}].clip", "want a name or a list of ids, got 7"),
    (["polygons", "-"], polygon(opacity=0), "unseen", "polygons[{n}].opacity", "nothing of it is seen"),
    (["polygons", "-"], polygon(opacity=2), "range", "polygons[{n}].opacity", "from 0 to 1, got 2"),
    (["polygons", "-"], polygon(path=""), "empty", "polygons[{n}].path", "is empty"),
    (["polygons", "-"], polygon(path="  "), "path", "polygons[{n}].path", "empty"),
    (["polygons", "-"], polygon(path="M1 1 L2"), "path", "polygons[{n}].path", "'L' wants 2 numbers"),
    (["polygons", "-"], polygon(path="M1 1 A5 5 0 0 1 9 9 Z"), "path", "polygons[{n}].path", "written as cubic curves"),
    (["polygons", "-"], polygon(path="M1 1 L5 5 L9 9 Z"), "empty", "polygons[{n}].path", "encloses nothing"),
    (["polygons", "-"], polygon(path=[[1, 1], [9, 9]]), "empty", "polygons[{n}].path", "3 or more"),
    (["polygons", "-"], polygon(path=[[1, 1], [9, 9], [1, 9, 2]]), "type", "polygons[{n}].path[2]", "another length"),
    (["polygons", "-"], polygon(path="M1 1 L9 9 L1 9e7 Z"), "range", "polygons[{n}].path", "within 100000 of 0"),
    (["polygons", "-"], polygon(path="M5 5 L5 5 Z", width=3), "empty", "polygons[{n}].path", "a single point"),
    (["polygons", "-"], polygon(path=[[500, 10], [530, 10], [520, 30]]), "canvas", "polygons[{n}]", "the canvas"),
    (["polygons", "-"], polygon(path=BOW), "crossing", "polygons[{n}].path", "near (1"),
    (["polygons", "-"], polygon(path=BOW, kind="hole"), "crossing", "polygons[{n}].path", "crosses the"),
    (["polygons", "-"], polygon(kind="hole"), "hole", "polygons[{n}]", "wholly outside the face"),
    (
        ["polygons", "-"],
        polygon(kind="hole", path=[[180, 300], [220, 300], [200, 380]]),
        "hole",
        "polygons[{n}]",
        "crosses the outline of the face",
    ),
    (
        ["polygons", "-"],
        polygon(drivers=[{"motor": "MB"}]),
        "shape",
        "polygons[{n}].drivers[0]",
        "want min or max",
    ),
    (
        ["polygons", "-"],
        polygon(drivers=[{"motor": "EAR", "max": {"move": [1, 1]}}]),
        "attached",
        "polygons[{n}].drivers[0].motor",
        "unknown motor 'EAR'",
    ),
    (
        ["polygons", "-"],
        polygon(drivers=[{"motor": "MB", "max": "M1 1 C1 2 3 4 5 6 Z"}]),
        "states",
        "polygons[{n}].drivers[0].max",
        "has 2 pieces, but the path has 3",
    ),
    (
        ["polygons", "lip line", "drivers"],
        [{"motor": "MB", "max": "M1 1 L9 9 L1 9 Z"}],
        "states",
        "polygons[{}].drivers[0].max",
        "has no path",
    ),
    (
        ["polygons", "-"],
        polygon(drivers=[{"motor": "MB", "max": {"move": [0, 9], "ramp": [5, 5]}}]),
        "table",
        "polygons[{n}].drivers[0].max.ramp",
        "ends where it begins",
    ),
    (["polygons", "lip line", "stroke"], {"feature": "M", "range": [1, 0]}, "table", "polygons[{}].stroke.range", "e"),
    (["polygons", "lip line", "stroke"], {"feature": "PR"}, "name", "polygons[{}].stroke.feature", "unknown feature"),
    (["expressions"], {"grin": {"MB": 2}}, "range", "expressions.grin.MB", "want from 0 to 1, got 2"),
    (["expressions"], {"grin": {"EAR": 1}}, "attached", "expressions.grin.EAR", "unknown motor 'EAR'"),
    (["expressions"], {"grin": {"HH": 40}}, "range", "expressions.grin.HH", "from -26 to 26"),
    (["proportions"], {"eyes.size": [0.5, 0.9]}, "range", "proportions.eyes.size[1]", "from 1 to 10"),
    (["proportions"], {"eyes.sise": [0.5, 2]}, "unknown", "proportions.eyes.sise", "did you mean 'eyes.size'"),
    (["hand"], {}, "shape", "hand", "want use, at, skin, shade, sleeve and fold or poses or moves"),
    (["hand"], HAND | {"use": "cartoons"}, "attached", "hand.use", "did you mean 'cartoon'"),
    (["hand"], HAND | {"fold": "gold"}, "palette", "hand.fold", "unknown colour 'gold'"),
    (["hand"], HAND | {"poses": {"fist": {"HI": 2}}}, "range", "hand.poses.fist.HI", "from 0 to 1, got 2"),
    (["hand"], HAND | {"poses": {"fist": {"EAR": 1}}}, "attached", "hand.poses.fist.EAR", "unknown motor 'EAR'"),
    (["hand"], HAND | {"moves": {"wave": [KEY, KEY]}}, "table", "hand.moves.wave[1].time", "want above 1, got 1"),
    (["parts"], {"hand": [{"motor": "MB", "max": {"move": [0, 1]}}]}, "unseen", "parts.hand", "used by no polygon"),
]  # fmt: skip


@pytest.mark.parametrize(("place", "value", "rule", "told", "words"), FAULTS)
def test_a_fault_is_found_with_its_place(place, value, rule, told, words):
    document = edit(place, value)
    faults = check(document)
    found = [fault for fault in faults if fault.rule == rule]
    assert found, [fault.text() for fault in faults]
    number = next((NAMES.index(key) for key in place if key in NAMES), "")
    told = told.format(number, n=len(NAMES))
    texts = [fault.text() for fault in found]
    assert any(f" {told}" in text and words in text for text in texts), texts


@pytest.mark.parametrize(("place", "value"), [fault[:2] for fault in FAULTS])
def test_one_slip_is_told_with_little_else(place, value):
    faults = check(edit(place, value))
    assert len(faults) <= 4, [fault.text() for fault in faults]
    assert len({(fault.rule, fault.place, fault.what) for fault in faults}) == len(faults)


@pytest.mark.parametrize(("place", "value"), [fault[:2] for fault in FAULTS])
def test_verdicts_are_those_of_a_complete_implementation_and_of_the_reader(place, value):
    document = edit(place, value)
    mistaken = any(fault.grave for fault in check(document))
    try:
        parse_toon(json.dumps(document), "document")
    except LoadError:
        assert mistaken
    if "NaN" not in json.dumps(document):  # which is no JSON, so that no schema is asked about it
        theirs = any(VALIDATOR.iter_errors(document))
        assert any(find_mismatches(document, toon_schema())) == theirs
        assert mistaken or not theirs


def test_a_shipped_hand_has_motors_polygons_and_a_part_of_its_own():
    assert check(edit(["hand"], HAND), 80) == ()
    document = edit(["hand"], HAND | {"poses": {"fist": {"HI": 1, "HO": 1}}})
    document["expressions"] = {"hello": {"HY": 1}}
    assert check(document) == ()
    document["polygons"].append(polygon(id=SharedHand("cartoon", (0, 0), 1, {}).ids[0]))
    document["parts"] = {"hand": [{"motor": "MB", "max": {"move": [0, 1]}}]}
    faults = [fault for fault in check(document) if fault.grave]
    assert [fault.rule for fault in faults] == ["repeated id"] * 2


def test_gaze_that_leaves_the_eye():
    document = edit(["motors", "PLH", "max"], 30)
    assert check(document) == ()  # the pupil is clipped by the eye
    del document["polygons"][NAMES.index("pupil left")]["clip"]
    (fault,) = check(document)
    assert (fault.rule, fault.place, fault.got) == ("gaze", ("motors", "PLH", "max"), "30")


def test_polygons_that_go_wild_are_told_with_the_motors_that_do_it():
    far = {"move": [0, 9000]}
    document = edit(["polygons", "-"], polygon(drivers=[{"motor": "MB", "max": far}, {"motor": "HV", "min": far}]))
    (fault,) = check(document, 80)
    assert (fault.rule, fault.place[1], fault.got) == ("wild", len(NAMES), "MB 1")


def test_polygons_without_a_finite_place_are_told(monkeypatch):
    face = check_bytes(starter_text("kim").encode(), 0).face

    whole = Shape.contours

    def contours(shape, moment):
        share = np.nan if shape.polygon.id == "nose" and moment.activation("HV") else 1.0
        return tuple(contour * share for contour in whole(shape, moment))

    monkeypatch.setattr(Shape, "contours", contours)
    (fault,) = find_wild_poses(face, {name: ("polygons", number) for number, name in enumerate(NAMES)}, 100)
    assert (fault.rule, fault.place, fault.got) == ("pose", ("polygons", NAMES.index("nose")), "HV -18")


def test_every_rule_is_tried():
    elsewhere = {"file", "json", "depth", "repeated", "strict", "large", "gaze", "wild", "pose"}
    assert {fault[2] for fault in FAULTS} | elsewhere == set(rules())


def test_severity_is_as_the_table_says_or_less():
    for fault in [fault for place, value, *_ in FAULTS for fault in check(edit(place, value))]:
        assert fault.grave <= (rules()[fault.rule].severity == "error") or fault.rule == "crossing"


def test_crossings_are_errors_only_where_what_is_inside_depends_on_them():
    for keys, grave in (({}, False), ({"rule": "evenodd"}, True), ({"kind": "hole", "fill": "dark"}, True)):
        document = edit(["polygons", "-"], polygon(path=[[160, 230], [240, 250], [240, 230], [160, 248]], **keys))
        assert [(fault.rule, fault.grave) for fault in check(document)] == [("crossing", grave)]
    ribbon = polygon(path=[[160, 230], [240, 250], [240, 230], [160, 248]], width=4)
    assert check(edit(["polygons", "-"], ribbon)) == ()


def test_a_crossing_names_its_pieces():
    path = "M160 230 L240 250 L240 230 C220 240 200 250 160 248 Z"
    (fault,) = check(edit(["polygons", "-"], polygon(path=path)))
    assert fault.what.startswith("the line to (240, 250) crosses the curve to (160, 248) near (2")


def test_all_faults_are_told_and_in_the_order_of_their_lines():
    document = edit(["polygons", "nose", "fill"], "skn")
    document["polygons"][0]["kind"] = "fre"
    document["motors"]["BRL"] = {"min": 5, "max": -3}
    document["features"]["PR"]["points"]["PR"] = [160, 300]
    document["polygons"].append(polygon(path=BOW))
    document["size"] = [400]
    faults = check(document)
    assert [fault.rule for fault in faults] == ["type", "limits", "name", "palette", "crossing"]
    text = json.dumps(document, indent=1).splitlines()
    lines = [text[fault.line - 1].strip(" [,") for fault in faults]
    assert lines == ['"size":', '"min": 5', '"kind": "fre"', '"fill": "skn"', '"path":']


@pytest.mark.parametrize(
    ("place", "value"),
    [
        (["features", "N"], {"points": {"N": [200, 220]}}),
        (["features", "BR", "smooth"], True),
        (["motors", "MT"], {"min": 0, "max": 3}),
        (["palettes"], {"winter": {"skin": "#112233"}}),
        (["proportions"], {"eyes.size": [0.9, 1.1]}),
        (["polygons", "nose", "layer"], "front"),
        (["polygons", "nose", "clip"], "face"),
        (["polygons", "nose", "depth"], 0.3),
        (["polygons", "brow left", "line"], "upper"),
    ],
)
def test_strict_faces_have_no_extensions(place, value):
    assert check(STRICT) == ()
    document = edit(place, value, STRICT)
    faults = [fault for fault in check(document) if fault.rule == "strict"]
    assert [fault.place[-1] for fault in faults] == [place[-1]]
    with pytest.raises(LoadError, match="extension"):
        parse_toon(json.dumps(document), "document")
    document["mode"] = "extended"
    assert not [fault for fault in check(document) if fault.rule == "strict"]


@pytest.mark.parametrize("name", toon_names())
def test_what_ships_has_no_faults(name):
    report = check_bytes(files("mien.faces.toon").joinpath(*FOLDER, name + SUFFIX).read_bytes(), 80)
    assert [fault.text() for fault in report.faults] == []
    assert report.face is not None


@pytest.mark.parametrize("text", [starter_text("kim"), starter_text("kim", "strict"), copied_text("kim", "toon:olav")])
def test_starters_have_no_faults_and_the_name_asked_for(text):
    report = check_bytes(text.encode(), 80)
    assert report.faults == ()
    assert report.face.character.name == "kim"


def test_the_face_in_the_documentation_has_no_faults():
    page = (ROOT / "docs/toon-format.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"```json\n(.*?)```", page, re.DOTALL)
    assert check_bytes(example.encode(), 80).faults == ()
    assert len(example.splitlines()) <= 32


def test_strict_faces_are_looked_at_as_drawn():
    outside = edit(["polygons", "-"], polygon(kind="hole", path=[[-90, -90], [-50, -90], [-50, -50]]), STRICT)
    assert any(fault.rule == "hole" and "wholly outside" in fault.what for fault in check(outside))


def test_wrong_limits_hide_no_fault_of_a_polygon():
    outside = edit(["polygons", "-"], polygon(kind="hole", path=[[-90, -90], [-50, -90], [-50, -50]]))
    outside["motors"]["MB"] = {"min": 50, "max": 38}
    assert {"hole", "limits"} <= {fault.rule for fault in check(outside)}
