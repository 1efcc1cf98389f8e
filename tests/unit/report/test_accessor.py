"""``result.tribodyn`` in a notebook, and what cases show there."""

import pytest
import xarray as xr
from matplotlib.figure import Figure

import tribodyn as td
from tribodyn.core.errors import InputError


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
