import io
import itertools
import struct
import subprocess
import sys
from xml.etree import ElementTree

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.colors import to_rgb

from tribodyn.papers.cheng_2022.reduced.figures import FIGURES as ALL
from tribodyn.report import draw_all
from tribodyn.results import build


def _nan_tail(make_result):
    """A run whose last samples were lost to a failing integration."""
    result = make_result(2.0, failure="NaN in e_x")
    for name, variable in result.data_vars.items():
        if variable.dims == ("time",):
            result[name].values[-5:] = np.nan
    result["pressure"].values[0] = np.nan
    return result


RUNS = {
    "whole": lambda make: make(),
    "one sample": lambda make: make(0.005, failure="interrupted"),
    "empty": lambda make: make(0.0, failure="interrupted"),
    "nan": _nan_tail,
    "all nan": lambda make: make(0.3) * np.nan,
}


#: Those of every run; the other one is of campaigns.
FIGURES = {name: family for name, family in ALL.items() if name != "wear_history"}


@pytest.fixture(scope="module")
def runs(make_result):
    return {name: prepare(make_result) for name, prepare in RUNS.items()}


@pytest.mark.parametrize(
    "run",
    [pytest.param(run, marks=pytest.mark.long) if run in ("one sample", "all nan") else run for run in RUNS],
)
@pytest.mark.parametrize("name", FIGURES)
def test_every_figure_draws_every_run(name, run, runs):
    figure = FIGURES[name].draw(runs[run])
    if run in ("whole", "nan"):  # the others have the same texts and axes
        figure.savefig(io.BytesIO(), format="png", dpi=30)
    texts = [text.get_text() for text in figure.texts]
    assert FIGURES[name].title in texts
    assert any("partial run" in text for text in texts) == bool(runs[run].attrs.get("failure"))


@pytest.mark.parametrize("name", FIGURES)
def test_axes_are_labelled_with_units(name, runs):
    if not FIGURES[name].drawable(runs["whole"]):
        assert name == "clearance"  # it is constant
        return
    figure = FIGURES[name].draw(runs["whole"])
    labels = [label for axes in figure.axes for label in (axes.get_xlabel(), axes.get_ylabel()) if label]
    assert labels
    assert all("[" in label for label in labels)


def _lightness(colour):
    return float(np.dot(to_rgb(colour), (0.299, 0.587, 0.114)))


def _told_apart_in_grey(one, other):
    widths = sorted((one.get_linewidth(), other.get_linewidth()))
    return (
        one._unscaled_dash_pattern != other._unscaled_dash_pattern
        or widths[1] >= 1.5 * widths[0]
        or abs(_lightness(one.get_color()) - _lightness(other.get_color())) >= 0.3
    )


@pytest.mark.parametrize("name", FIGURES)
def test_lines_are_told_apart_in_grey(name, runs):
    for axes in FIGURES[name].draw(runs["whole"]).axes:
        drawn = [line for line in axes.lines if line.get_linestyle() != "None"]
        named = [line for line in drawn if not line.get_label().startswith("_")]
        assert all(_told_apart_in_grey(*pair) for pair in itertools.combinations(named, 2))


def test_draw_all_writes_png_of_sensible_size_and_pdf(make_result, tmp_path):
    some = slice(None, None, 4)
    paths = draw_all(make_result(0.4), tmp_path / "figures", part=some)
    assert [path.stem for path in paths] == [name for name in list(FIGURES)[some] if name != "clearance"]
    for path in paths:
        head = path.read_bytes()[:24]
        assert head.startswith(b"\x89PNG")
        width, height = struct.unpack(">II", head[16:])
        assert 1000 <= width <= 1600
        assert 450 <= height <= 1200
        assert path.with_suffix(".pdf").read_bytes().startswith(b"%PDF")
    expected = [f"{path.stem}{ending}" for path in paths for ending in (".pdf", ".png")]
    assert sorted(path.name for path in (tmp_path / "figures").iterdir()) == sorted(expected)


def test_what_a_result_does_not_hold_is_not_drawn_and_not_left_over(tmp_path):
    (tmp_path / "motion.png").write_bytes(b"of an earlier run")
    result = build(
        coordinates={"time": [0.0, 1.0]},
        columns={"e_x": [0.0, 1e-6], "e_y": [0.0, 1e-6]},
        attributes={"kind": "vsv"},
    )
    assert draw_all(result, tmp_path) == []
    assert list(tmp_path.iterdir()) == []


def test_a_hostile_title_is_printed_as_it_is(make_result):
    title, file = r"$\frac{1}$ & <b> 100 % $x_1$", io.BytesIO()
    with mpl.rc_context({"svg.fonttype": "none"}):
        FIGURES["vane_error"].draw(make_result(0.1, title=title)).savefig(file, format="svg")
    assert title in "".join(ElementTree.fromstring(file.getvalue()).itertext())


def test_names_captions_and_needs_are_complete():
    for name, family in FIGURES.items():
        assert family.name == name
        assert family.caption.endswith(".")
        assert family.needs


def test_pyplot_is_never_imported():
    code = "import sys, tribodyn.figures; sys.exit('matplotlib.pyplot' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_global_state_is_left_alone(make_result):
    before = dict(mpl.rcParams)
    for family in FIGURES.values():
        family.draw(make_result(0.1))
    assert dict(mpl.rcParams) == before
