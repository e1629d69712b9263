"""The page about a solution: what it says, that it is whole, and that nothing in names gets out of hand."""

from __future__ import annotations

import json
import math
import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mien.capture.project_records import METRES, Project
from mien.capture.records import (
    Camera,
    Lens,
    Observation,
    Photograph,
    Reference,
    Residual,
    Solution,
    SolvedPoint,
    Survey,
)
from mien.capture.report import write_report
from mien.capture.report_lines import edges_of, neighbours, polygons_of
from mien.capture.report_numbers import Exactness, Unit, round_down, significant
from mien.capture.report_photographs import arrow_magnification
from mien.capture.report_views import CHI2_95, Standpoint, standpoint
from mien.core import UnknownNameError

NASTY = '</script><img src=x onerror="alert(1)">&\'"'


class Reader(HTMLParser):
    """Tags that are open, all tags, all text."""

    VOID = frozenset(("meta", "input", "img", "br"))

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: list[str] = []
        self.texts: list[str] = []
        self.data: list[str] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        (self.data if self.open and self.open[-1] == "script" else self.texts).append(data)


def make_solution(folder: Path | None = None, *, name: str = "nose", moments: tuple[str, ...] = ("rest",)) -> Solution:
    """Two cameras a metre before three points and two references; residuals of (3, 4) px, and one suspect."""
    photographs, cameras, residuals, points = [], {}, [], {}
    names = [name, "chin", "brow"]
    for moment in moments:
        for side in (-1, 1):
            photo = f"{moment}{side:+d}.png"
            path = None if folder is None else folder / photo
            photographs.append(Photograph(photo, (400, 300), "a", moment, path=path))
            lens = Lens(500.0, (200.0, 150.0), -0.1, 0.0, ("focal", "k1"))
            cameras[photo] = Camera(lens, np.diag([1.0, -1.0, -1.0]), np.array([0.3 * side, 0.0, 1.0]))
            for k, point in enumerate([*names, "near", "far"]):
                seen = Observation(photo, point, 100.0 + 40 * k, 150.0, 1.0, len(residuals) + 2)
                residuals.append(Residual(seen, 3.0, 4.0, 2.0))
        for k, point in enumerate(names):
            covariance = np.diag([1e-8, 1e-8, 4e-8])
            points[moment, point] = SolvedPoint(
                point, moment, np.array([0.02 * k, 0.01 * k * k, 0.0]), covariance, tuple(cameras)
            )
        for k, point in enumerate(("near", "far")):
            place = np.array([0.254 * k, 0.0, 0.0])
            points[moment, point] = SolvedPoint(point, moment, place, np.zeros((3, 3)), tuple(cameras), "reference")
    bad = replace(residuals[1], du=60.0, dv=-20.0, statistic=400.0)
    residuals[1] = bad
    references = (Reference("near", 0.0, 0.0, 0.0), Reference("far", 0.254, 0.0, 0.0))
    survey = Survey(tuple(photographs), tuple(each.observation for each in residuals), references)
    remarks = ("camera 'a': took k2 for 0",)
    return Solution(survey, cameras, points, tuple(residuals), (bad,), 1.21, remarks)


def write(solution: Solution, folder: Path, **options) -> tuple[str, tuple[str, ...]]:
    out = folder / "report.html"
    missing = write_report(solution, out, **options)
    return out.read_text(encoding="utf-8"), missing


@pytest.fixture
def pictures(tmp_path):
    for side in ("-1", "+1"):
        Image.effect_noise((400, 300), 60).convert("RGB").save(tmp_path / f"rest{side}.png")
    return tmp_path


@pytest.mark.parametrize(
    ("value", "told"), [(0.0, "0"), (0.12345, "0.123"), (254.4, "254"), (12345.0, "12300"), (-0.05, "−0.0500")]
)
def test_numbers_have_three_digits_and_no_powers_of_ten(value, told):
    assert significant(value) == told


@pytest.mark.parametrize(
    ("value", "step"), [(1.0, 1.0), (1.99, 1.0), (4.9, 2.0), (73.0, 50.0), (0.2, 0.2), (0.09, 0.05)]
)
def test_magnifications_are_round(value, step):
    assert round_down(value) == pytest.approx(step)


def test_summary_tells_sigma_and_its_share_of_the_references(tmp_path):
    # Variances 1, 1 and 4 (1e-8 m²): their mean is 2, so that sigma is 0.1414 mm of 254 mm.
    exactness = Exactness.of(make_solution())
    assert exactness.point_rms_m == pytest.approx(math.sqrt(2e-8))
    assert exactness.span_m == pytest.approx(0.254)
    assert exactness.residual_rms_px == pytest.approx(5.0)
    text, _ = write(make_solution(), tmp_path)
    assert "3 points measured, exact to 0.141 mm — 0.056 % of the 254 mm that the references span." in text
    assert "Clicks fit to 5.0 px" in text
    assert "1 click of 10 does not fit" in text
    assert "took k2 for 0" in text


def test_lengths_are_in_the_unit_of_the_project(tmp_path):
    text, _ = write(make_solution(), tmp_path, unit="inch")
    assert "exact to 0.00557 inch" in text
    assert "of the 10.0 inch that" in text
    with pytest.raises(UnknownNameError, match="'ell'"):
        write(make_solution(), tmp_path, unit="ell")
    assert set(METRES) == {"m", "cm", "mm", "inch"}


def test_decimals_show_two_digits_of_sigma():
    assert Unit.of("mm", make_solution()).number(0.0123456) == "12.35"
    assert Unit.of("m", make_solution()).number(0.0123456) == "0.01235"


def test_scatter_beyond_the_sigmas_is_told_with_what_to_do(tmp_path):
    text, _ = write(replace(make_solution(), chi2_per_dof=9.0), tmp_path)
    assert "3.0 times worse than their sigmas say" in text
    assert "Look at the largest arrows, at the references" in text


def test_without_references_the_points_themselves_are_the_measure():
    solution = make_solution()
    solution = replace(
        solution,
        survey=replace(solution.survey, references=()),
        points={key: point for key, point in solution.points.items() if point.kind == "measured"},
    )
    exactness = Exactness.of(solution)
    assert exactness.spanned == "points"
    assert exactness.span_m == pytest.approx(math.hypot(0.04, 0.04))


def test_names_are_text_wherever_they_stand(pictures):
    text, _ = write(make_solution(pictures, name=NASTY), pictures, name=NASTY)
    page = Reader(text)
    assert page.open == []
    assert "img" not in page.tags
    assert page.tags.count("script") == 2
    assert page.texts.count(NASTY) >= 3
    data = json.loads(next(each for each in page.data if each.startswith("{")))
    assert data["points"][0]["name"] == NASTY


def test_page_asks_nobody_for_anything(pictures):
    text, missing = write(make_solution(pictures), pictures)
    assert missing == ()
    assert "default-src 'none'" in text
    assert re.findall(r"(?:https?:)?//[a-z]", re.sub(r'"data:[^"]*"', "", text)) == []
    assert {link.split(",")[0] for link in re.findall(r'href="([^"]*)"', text)} == {"data:image/jpeg;base64"}
    assert text.count("data:image/jpeg;base64") == 3  # two photographs, and the suspect at full size


def test_same_solution_makes_the_same_page(pictures):
    assert write(make_solution(pictures), pictures) == write(make_solution(pictures), pictures)


def test_photograph_that_is_gone_is_told_and_the_rest_is_there(pictures):
    (pictures / "rest+1.png").unlink()
    text, missing = write(make_solution(pictures), pictures)
    assert len(missing) == 1
    assert "rest+1.png" in missing[0]
    assert missing[0] in re.sub(r"&#x27;", "'", text)
    assert text.count('<figure class="photograph">') == 2
    assert text.count("data:image/jpeg;base64") == 2


def test_photograph_of_another_size_is_not_drawn_on(pictures):
    Image.new("RGB", (300, 400)).save(pictures / "rest+1.png")
    _, missing = write(make_solution(pictures), pictures)
    assert "300 × 400" in missing[0]
    assert "400 × 300" in missing[0]


def test_pictures_may_lie_elsewhere(pictures):
    text, missing = write(
        make_solution(), pictures, pictures={f"rest{side}.png": pictures / f"rest{side}.png" for side in ("-1", "+1")}
    )
    assert missing == ()
    assert text.count("data:image/jpeg;base64") == 3


def test_arrows_are_magnified_alike_and_suspects_are_not():
    # Residuals of 5 px in pictures 400 px wide: 1.25 %; twice that is the 2.5 % wanted.
    assert arrow_magnification(make_solution()) == 2.0


def test_arrow_leads_from_the_solution_to_the_click(tmp_path):
    text, _ = write(make_solution(), tmp_path)
    # Clicked at (100, 150), (3, 4) off, drawn twice as long.
    assert 'd="M97.0 146.0L103.0 154.0' in text
    # The suspect was clicked at (140, 150) and expected at (80, 170).
    assert 'class="way" d="M80.0 170.0L140.0 150.0"' in text


def test_ellipse_of_a_covariance_lies_along_its_longest_axis():
    view = Standpoint(np.eye(3), np.zeros(3))
    along = np.array([math.cos(0.5), math.sin(0.5), 0.0])
    covariance = 9.0 * np.outer(along, along) + np.diag([0.0, 0.0, 25.0])
    large, small, turn = view.ellipse(covariance)
    assert large == pytest.approx(3.0 * math.sqrt(CHI2_95))
    assert small == pytest.approx(0.0, abs=1e-6)
    assert (turn + math.degrees(0.5)) % 180.0 == pytest.approx(0.0, abs=1e-6)


def test_side_view_looks_along_the_left_to_right_axis():
    side = Standpoint(np.eye(3), np.zeros(3)).turned(90.0)
    np.testing.assert_allclose(side.places(np.array([[1.0, 2.0, 3.0]])), [[-3.0, 2.0, 1.0]], atol=1e-12)
    above = Standpoint(np.eye(3), np.zeros(3)).above()
    np.testing.assert_allclose(above.places(np.array([[1.0, 2.0, 3.0]])), [[1.0, -3.0, 2.0]], atol=1e-12)


def test_front_is_where_the_cameras_are_and_up_is_up_in_the_photographs():
    solution = make_solution()
    view = standpoint(solution, [point for point in solution.points.values() if point.kind == "measured"])
    np.testing.assert_allclose(view.rows[1], [0.0, 1.0, 0.0], atol=1e-12)
    assert view.rows[2][2] > 0.99
    assert np.linalg.det(view.rows) == pytest.approx(1.0)


def test_neighbours_have_nothing_between_them():
    places = np.array([[0.0, 0.0, 0.0], [1.0, 0.2, 0.0], [2.0, 0.0, 0.0], [1.0, 5.0, 0.0]])
    assert neighbours(places) == [(0, 1), (1, 2), (1, 3)]


def test_topology_tells_the_lines_where_there_is_one():
    assert edges_of(["a", "b", "c"], np.zeros((3, 3)), [("a", "b", "unknown"), ("b", "c")]) == [(0, 1), (1, 2)]


def test_every_moment_is_drawn(tmp_path):
    text, _ = write(make_solution(moments=("rest", "smile")), tmp_path)
    assert text.count("<summary>rest</summary>") == 2
    assert text.count("<summary>smile</summary>") == 2
    assert text.count("<canvas") == 2
    assert Reader(text).open == []


def test_solution_without_measured_points_says_so(tmp_path):
    solution = make_solution()
    known = {key: point for key, point in solution.points.items() if point.kind == "reference"}
    text, _ = write(replace(solution, points=known), tmp_path)
    assert "no point besides the references" in text
    assert Reader(text).open == []
    text, _ = write(replace(solution, points={}, cameras={}), tmp_path)
    assert Reader(text).open == []


def test_lens_terms_that_were_assumed_are_told_apart(tmp_path):
    text, _ = write(make_solution(), tmp_path)
    lenses = text[text.index("<h2>Lenses") : text.index("<h2>Photographs")]
    assert "534" not in lenses
    assert ">500.0 <small>44°</small><" in lenses  # 400 px wide: 2 atan(200 / 500)
    assert ">−0.1000<" in lenses
    assert '<span class="assumed">200.0, 150.0</span>' in lenses
    assert '<span class="assumed">0.0000</span>' in lenses
    assert '<span class="assumed">1.0000</span>' in lenses
    assert lenses.count("<th ") == lenses.count("<td") == 9


def test_cameras_that_are_endlessly_far_are_not_drawn(tmp_path):
    solution = make_solution()
    near, _ = write(solution, tmp_path)
    far = {name: replace(camera, place=camera.place * 1e4) for name, camera in solution.cameras.items()}
    endless, _ = write(replace(solution, cameras=far), tmp_path)
    assert near.count('<g class="camera">') == 2
    assert '<g class="camera">' not in endless
    assert "very far" in endless


def test_polygons_go_by_the_names_of_the_project(tmp_path):
    project = Project(tmp_path, "anna", ())
    assert polygons_of(project) == []
    (tmp_path / "topology.txt").write_text("part skin\n1 2 3 #e0ac96\n", encoding="utf-8")
    assert polygons_of(project) == [("1", "2", "3")]
    (tmp_path / "marks.csv").write_text(
        "number,name,body,follows,touches,x,y,z\n1,nose,,,,,,\n2,chin,,,,,,\n3,brow,,,,,,\n", encoding="utf-8"
    )
    assert polygons_of(project) == [("nose", "chin", "brow")]


def test_many_clicks_carry_no_names_but_those_of_suspects(tmp_path):
    solution = make_solution()
    seen = solution.residuals[0].observation
    crowd = tuple(Residual(replace(seen, point=f"q{k}", u=5.0 + 2.0 * k, v=20.0), 0.1, 0.0) for k in range(180))
    text, _ = write(replace(solution, residuals=(*solution.residuals, *crowd)), tmp_path)
    first = text[text.index('<figure class="photograph">') : text.index("<figcaption><b>rest-1.png")]
    assert first.count("<text") == 1
    assert 'class="suspect" x=' in first
    assert "<title>q7: 0.1 px</title>" in first
