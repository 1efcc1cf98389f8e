"""The page of a run, and what a result shows in a notebook."""

import base64
import gzip
import hashlib
import io
import json
import re
from html.parser import HTMLParser

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure
from PIL import Image
from tests.unit.mechanism.made_up import result as linkage

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.results import known, summarise
from tribodyn.papers.cheng_2022.reduced.key_results import KEY_RESULTS
from tribodyn.papers.cheng_2022.reduced.sections import CHAPTERS
from tribodyn.report import draw_all, write
from tribodyn.results import build
from tribodyn.views.numbers import in_words

HOSTILE = '<script>alert("x")</script> & "quotes" \' </title></style>{{ 7*7 }} ünïcode µ'


class _Page(HTMLParser):
    """Tags, attributes and text of a page; complains about tags that do not nest."""

    void = frozenset({"meta", "img", "br", "link", "input"})

    def __init__(self, text):
        super().__init__()
        self.open, self.tags, self.text, self.scripts = [], [], [], []
        self.feed(text)
        self.close()
        assert not self.open

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in self.void:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        inside = self.open[-1] if self.open else ""
        if inside == "script":
            self.scripts.append(data)
        elif inside != "style":
            self.text.append(data)

    @property
    def words(self):
        return " ".join("".join(self.text).split())


def _page(path):
    return _Page(path.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def report(make_result, tmp_path_factory):
    folder = tmp_path_factory.mktemp("run")
    result = make_result(7.0)
    return result, draw_all(result, folder / "figures", part=slice(None, None, 3)), write(result, folder)


def test_it_shows_every_key_result_with_its_meaning(report):
    words = _page(report[2]).words
    for key_result in KEY_RESULTS.values():
        assert key_result.label in words
        assert key_result.meaning in words
    assert "0.1 (the default, assumed)" in words


def test_results_of_joints_are_a_table_of_joints_and_quantities(tmp_path):
    dataset = linkage()
    page = _page(write(dataset, tmp_path))
    of_joints = [one for one in known(summarise(dataset), "mechanism").values() if one.part]
    joints, quantities = ({getattr(one, name) for one in of_joints} for name in ("part", "column"))
    assert len(joints) > 1
    assert len(of_joints) > len(quantities)
    heads = [attrs.get("scope") for tag, attrs in page.tags if tag == "th"]
    assert heads.count("col") >= len(quantities)
    # A row for each joint, not one for each number of it.
    assert all(page.text.count(joint) <= len(quantities) for joint in joints)


def test_stills_are_embedded_smaller_and_look_the_same(report):
    sources = [attrs["src"] for tag, attrs in _page(report[2]).tags if tag == "img"]
    stored = [base64.b64decode(source.removeprefix("data:image/webp;base64,")) for source in sources]
    embedded = [np.asarray(Image.open(io.BytesIO(one)).convert("RGB"), dtype=float) for one in stored]
    drawn = [np.asarray(Image.open(path).convert("RGB"), dtype=float) for path in report[1]]
    assert len(embedded) == len(drawn)
    for picture in drawn:
        same = [one for one in embedded if one.shape == picture.shape]
        # Of 255: where most of a page is white, another picture is off by more than ten.
        nearest = min((np.abs(one - picture) for one in same), key=np.mean)
        assert nearest.mean() < 2.0
        # Thin lines keep their colours.
        assert nearest.max() < 64.0
    assert sum(map(len, stored)) < 0.4 * sum(path.stat().st_size for path in report[1])


def test_nothing_is_fetched_and_only_our_scripts_run(report):
    page = _page(report[2])
    text = report[2].read_text(encoding="utf-8")
    for script in page.scripts:
        text = text.replace(script, "")
    assert not re.search(r"https?://|//cdn|@import|url\(", text)
    assert {tag for tag, _ in page.tags}.isdisjoint({"link", "iframe", "object", "embed", "base"})
    policy = next(attrs["content"] for _, attrs in page.tags if attrs.get("http-equiv"))
    assert policy.startswith("default-src 'none'; script-src 'sha256-")
    assert "unsafe-eval" not in policy
    assert "unsafe-inline" not in policy
    digest = hashlib.sha256(page.scripts[1].encode()).digest()
    assert base64.b64encode(digest).decode() in policy
    assert not [attrs for tag, attrs in page.tags if tag == "script" and "src" in attrs]
    assert not [name for _, attrs in page.tags for name in attrs if name.startswith("on")]


def test_the_default_case_stays_below_1200_kb(report):
    assert report[2].stat().st_size < 1.2e6


def test_every_figure_names_its_data(report):
    result, _, path = report
    page = _page(path)
    anchors = {attrs["id"] for _, attrs in page.tags if "id" in attrs}
    links = {attrs["href"] for tag, attrs in page.tags if tag == "a"}
    sections = [section for chapter in CHAPTERS for section in chapter.sections]
    drawn = [section for section in sections if section.payload(result)]
    assert len(drawn) >= 11
    for section in drawn:
        assert section.name in anchors
        assert {f"#v-{name}" for name in section.needs} <= links
    assert {f"v-{name}" for name in result.variables} <= anchors
    assert {link[1:] for link in links if link.startswith("#")} <= anchors


def test_warnings_come_before_numbers(report):
    words = _page(report[2]).words
    assert words.index("Why these numbers may be wrong") < words.index("Results")


def test_failure_comes_first_and_says_how_far_it_went(make_result, tmp_path):
    words = _page(write(make_result(1.0, failure="stopped at t = 1 s: step too small"), tmp_path)).words
    assert words.index("step too small") < words.index("Why these numbers may be wrong")
    assert "0.995 s that were simulated" in words


def test_hostile_texts_are_escaped(make_result, tmp_path):
    result = make_result(
        0.5,
        failure=HOSTILE,
        title=HOSTILE,
        case=HOSTILE,
        warnings=[HOSTILE],
        contact_law=HOSTILE,
        formulation=HOSTILE,
        solver={HOSTILE: HOSTILE},
        tribodyn_version=HOSTILE,
    )
    page = _page(write(result, tmp_path))
    assert "{{ 7*7 }}" in page.words
    # Title (head and page), law, formulation, failure, warning, solver name and value, version (table, foot).
    assert page.words.count("<script>alert(") == 11
    assert len(page.scripts) == 2


@pytest.mark.parametrize("end", [0.0, 0.005])
def test_a_run_that_hardly_began(make_result, tmp_path, end):
    assert "did not reach its end" in _page(write(make_result(end, failure="at once"), tmp_path)).words


def test_a_run_of_nothing_but_nan_has_a_page(make_result, tmp_path):
    for name, result in {"tail": make_result(2.0), "all": make_result(0.3)}.items():
        for variable in result.data_vars.values():
            variable.values[... if name == "all" else slice(-5, None)] = np.nan
        content = gzip.decompress(base64.b64decode(_page(write(result, tmp_path / name)).scripts[0]))
        header = json.loads(content[8 : 8 + int.from_bytes(content[:8], "little")])
        assert "motion" in header["figures"]


def test_a_result_with_next_to_nothing(tmp_path):
    path = write(
        build(coordinates={"time": []}, columns={}, attributes={"kind": "vsv"}),
        tmp_path / "new" / "some.html",
    )
    assert path.name == "some.html"
    assert "Nothing was computed" in _page(path).words


def test_a_failing_render_leaves_the_old_report(make_result, tmp_path):
    path = write(make_result(0.1), tmp_path)
    old = path.read_bytes()
    with pytest.raises(FileNotFoundError):
        write(make_result(0.2), tmp_path, [tmp_path / "absent.png"])
    assert path.read_bytes() == old
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0302934, "0.03029"),
        (12.0, "12"),
        (-1.5, "−1.5"),
        (1.589e-6, "1.589 × 10⁻⁶"),
        (2.5e7, "2.5 × 10⁷"),
        (24091, "24\u202f091"),
        ("bdf", "bdf"),
        (True, "True"),
    ],
)
def test_numbers_are_written_for_people(value, text):
    assert in_words(value) == text


@pytest.fixture(scope="module")
def result() -> xr.Dataset:
    return td.simulate(td.load_case("vsv").replace({"run.duration": "20 ms"}))


def test_figures_are_methods(result: xr.Dataset) -> None:
    names = dir(result.tribodyn.plot)
    assert {"orbit", "vane_error", "contact_force"} <= set(names)
    assert isinstance(result.tribodyn.plot.orbit(), Figure)
    with pytest.raises(AttributeError, match='did you mean "orbit"'):
        _ = result.tribodyn.plot.orbitt


def test_a_mechanism_of_ones_own_has_orbits_too() -> None:
    crank = td.simulate(td.load_case("slider-crank").replace({"run.cycles": 0.01}))
    assert isinstance(crank.tribodyn.plot.mechanism(), Figure)


def test_a_figure_of_joints_shows_the_one_that_is_named(result: xr.Dataset) -> None:
    plot = td.simulate(td.load_case("slider-crank").replace({"run.cycles": 0.01})).tribodyn.plot
    for figure in (
        plot.orbit(joint="wrist"),
        plot.joint_forces(joint="wrist"),
        plot.wear_maps(joint="wrist"),
    ):
        texts = [axes.get_title(loc="left") + axes.get_ylabel() for axes in figure.axes]
        assert any("wrist" in text for text in texts)
        assert not any("main" in text for text in texts)
    with pytest.raises(InputError, match='did you mean "wrist"'):
        plot.orbit(joint="wirst")
    with pytest.raises(InputError, match="does not show joints one by one"):
        plot.energy(joint="wrist")
    with pytest.raises(InputError, match="does not show joints one by one"):
        result.tribodyn.plot.orbit(joint="wrist")


def test_a_case_shows_what_was_given_first() -> None:
    case = td.load_case("vsv").replace({"joint.clearance": "30 um"})
    page = case._repr_html_()
    assert page.index("joint.clearance") < page.index("<details>")
    assert "30 um" in page
    assert "default 20 um" not in page.split("<details>")[1]
