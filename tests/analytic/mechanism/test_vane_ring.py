"""The ring of vanes: equal vanes, one of twice the clearance, and the pull of N vanes against that of one."""

from typing import Final

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from mebdf.arrays import FloatArray
from tribodyn.cases.case import Case
from tribodyn.core.errors import InputError
from tribodyn.mechanism.descriptor import TEMPLATES
from tribodyn.mechanism.sections.charts import joint_forces
from tribodyn.mechanism.sections.copies import COPIES, around
from tribodyn.mechanisms.catalogue import parse_case
from tribodyn.mechanisms.results import summarise
from tribodyn.views.section import angle_of, coordinates

RIGID: Final = 'elastic = "beam"\n'


def ring(count: int, *, rigid: bool = True, **changes: object) -> Case:
    """Return the template with so many equal vanes for a part of the stroke, without gravity."""
    text = TEMPLATES["vsv-ring"].text
    play = text[text.index("[scatter.play]") : text.index("[bodies.ring]")]
    case = parse_case(text.replace(play, "").replace(RIGID, "" if rigid else RIGID), "test")
    given = {"pattern.vanes.count": count, "run.duration": "1 s", "run.output_interval": "20 ms", **changes}
    return case.replace(given)


def late(found: xr.Dataset, name: str) -> FloatArray:
    """Return a variable once the start has died away, at times that all runs share, shape (n, …)."""
    return np.asarray(found[name].interp(time=np.linspace(0.4, 1.0, 31)).values)


@pytest.fixture(scope="module")
def equal() -> xr.Dataset:
    return td.simulate(ring(4))


def test_equal_vanes_do_not_differ(equal: xr.Dataset) -> None:
    assert equal.attrs["failure"] == ""
    found = summarise(equal)
    error = np.degrees(np.abs(equal["output_error"].values)).max()
    assert found["copies_spread_max_deg"] < 1e-3 * error
    assert found["copies_sigma_deg"] < 1e-3 * error


def test_a_vane_of_twice_the_clearance_is_the_worst_copy(equal: xr.Dataset) -> None:
    loose = td.simulate(ring(4, **{"joints.trunnion[3].clearance.radial": "40 um"}))
    assert summarise(loose)["copies_worst"] == 3
    moved = np.abs(late(loose, "output_error") - late(equal, "output_error")).max(axis=0)
    assert np.max(np.delete(moved, 2)) < 0.1 * moved[2]


def test_a_hole_off_its_place_turns_its_vane_as_the_lever_does(equal: xr.Dataset) -> None:
    """A hole that is off by δ along the ring turns a lever (x, y) by δ/y, or by δ y/(x² + y²) if that is all.

    Between these the vane yields in its bore. A bore that is off does the opposite. No other vane feels it.
    """
    x, y = 24.240900475e-3, 43.730752842e-3
    for joint, sign in (("pin", -1.0), ("trunnion", 1.0)):
        found = td.simulate(ring(4, **{f"joints.{joint}[1].deviation": "10, 0, 0 um"}))
        assert found["output_ideal"].values[-1] == pytest.approx(equal["output_ideal"].values[-1], abs=1e-12)
        moved = sign * (late(found, "output_error") - late(equal, "output_error")).mean(axis=0)
        assert 10e-6 * y / (x**2 + y**2) < moved[0] < 10e-6 / y
        assert np.max(np.abs(moved[1:])) < 0.02 * moved[0]
    with pytest.raises(InputError, match="a kinematic analysis has ideal joints in their places"):
        ring(4, **{"joints.pin[1].deviation": "10, 0, 0 um", "run.analysis": "kinematic"})


def test_where_a_copy_has_no_error_none_is_the_worst_and_none_is_drawn() -> None:
    found = td.simulate(ring(4, **{"joints.trunnion[1].other_point": "0.01, 0, 390 mm"}))
    assert np.isnan(found["output_error"].values).all()
    assert np.isnan(summarise(found).get("copies_worst", np.nan))
    assert not around(found)


def test_elastic_levers_add_their_bending(equal: xr.Dataset) -> None:
    found = td.simulate(ring(4, rigid=False))
    assert found.attrs["failure"] == ""
    error = [np.abs(late(one, "output_error")).mean() for one in (equal, found)]
    bending = 0.84 * 50e-3 / (3.0 * 110e9 * 3e-3 * 10e-3**3 / 12.0)
    assert error[1] - error[0] == pytest.approx(bending, rel=0.2)


def test_the_pull_is_shown_against_the_limit_of_the_actuator(equal: xr.Dataset) -> None:
    limited = td.simulate(ring(4, **{"drives.piston.force_limit": "400 N"}))
    found, force = summarise(limited), np.abs(limited["drive_force"].values)
    assert found["drive_of_limit_max_percent"] == pytest.approx(100.0 * force.max() / 400.0)
    share = found["drive_of_limit_sustained_percent"] / found["drive_force_sustained_N"]
    assert share == pytest.approx(100.0 / 400.0)
    *_, panel = joint_forces(limited)
    drawn = {curve.name: curve.values for curve in panel.curves}
    reached = {"upper": drawn["cylinder"].max() > 0.0, "lower": drawn["cylinder"].min() < 0.0}
    assert {side: f"{side} limit, cylinder" in drawn for side in reached} == reached
    assert set(np.abs(np.concatenate([drawn[name] for name in drawn if "limit" in name]))) == {400.0}
    assert "drive_of_limit_max_percent" not in summarise(equal)


def test_vanes_stand_around_their_axis_with_the_worst_one_marked() -> None:
    loose = td.simulate(ring(4, **{"joints.trunnion[3].clearance.radial": "40 um"}))
    (one,) = around(loose)
    payload = COPIES.payload(loose)
    assert payload is not None
    (drawn,) = payload["parts"]
    curves = {curve["name"]: curve for curve in drawn["panels"][0]["curves"]}
    assert curves["vane[3], furthest from the mean"]["colour"] == "vermilion"
    # The third of four, clockwise from above, is below; a loose one is further out at one end.
    line = one.curve("", np.repeat(one.angles[2], 2), np.array([one.low[2], one.high[2]]), "ink")
    assert line.x == pytest.approx(0.0, abs=1e-9 * one.span)
    assert line.values == pytest.approx([one.middle - one.low[2], one.middle - one.high[2]])
    assert np.argmax(np.maximum(one.high, -one.low)) == 2


def test_the_pull_of_vanes_is_that_of_one_times_their_number(equal: xr.Dataset) -> None:
    """Two vanes and four: forces of the ring's own inertia cancel from the difference."""
    two = td.simulate(ring(2))
    pull = [np.abs(late(found, "element_force")[:, 0]) for found in (two, equal)]
    assert pull[1] == pytest.approx(2.0 * pull[0], rel=2e-2)


def test_a_limit_is_of_what_the_drive_gives() -> None:
    with pytest.raises(InputError, match="the limit of this drive is force_limit"):
        ring(2, **{"drives.piston.torque_limit": "1 N m"})


def test_charts_go_over_the_position_of_the_actuator(equal: xr.Dataset) -> None:
    label, values = angle_of(equal, "cylinder")
    assert label == "position of cylinder [mm]"
    time = equal["time"].values
    assert values == pytest.approx(-20.0 * (1.0 - np.cos(time)), abs=0.1)
    assert coordinates(equal, 1.0)[0]["label"] == label
