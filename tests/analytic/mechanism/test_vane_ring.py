"""The ring of vanes: equal vanes, one of twice the clearance, and the pull of N vanes against that of one."""

from typing import Any, Final

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from mebdf.arrays import FloatArray
from tribodyn.cases.case import Case, with_entries
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


def test_a_trunnion_tilted_about_its_lever_turns_its_vane(equal: xr.Dataset) -> None:
    """The pin, h = 10 mm above the trunnion, is d h off across the lever, as a hole may be."""
    lever = np.array([24.240900475e-3, 43.730752842e-3])
    length = float(np.linalg.norm(lever))
    tilt = ", ".join(repr(1e-3 * one) for one in (*(lever / length).tolist(), 0.0))
    found = td.simulate(ring(4, **{"joints.trunnion[1].tilt": f"{tilt} rad"}))
    assert found["output_ideal"].values[-1] == pytest.approx(equal["output_ideal"].values[-1], abs=1e-12)
    moved = (late(found, "output_error") - late(equal, "output_error")).mean(axis=0)
    whole = 1e-3 * 10e-3 / length
    assert whole * (lever[1] / length) ** 2 < moved[0] < whole
    assert np.max(np.abs(moved[1:])) < 0.02 * moved[0]


def test_a_lever_turned_on_its_vane_turns_the_vane_back(equal: xr.Dataset) -> None:
    """The vane is the first body of the joint; the axis of the second of four copies is along x."""
    found = td.simulate(ring(4, **{"joints.root[2].tilt": "1, 0, 0 mrad"}))
    moved = late(found, "output_error") - late(equal, "output_error")
    # The pin stays where it is; tolerances of the integration are 1e-3 of the errors, 5e-4.
    np.testing.assert_allclose(moved[:, 1], -1e-3, atol=2e-6)


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


def test_the_pull_of_vanes_is_that_of_one_times_their_number() -> None:
    """The force of the ring's own inertia, which it has without vanes, counts apart."""
    text = TEMPLATES["vsv-ring"].text.replace(RIGID, "")
    one = text[: text.index("[pattern.vanes]")] + text[text.index("[bodies.ring]") :]
    none = one[: one.index("[bodies.vane]")] + one[one.index("[run]") :]
    shared = {"run.duration": "1 s", "run.output_interval": "20 ms", "solver.rtol": 1e-5}
    cases = [parse_case(few, "test").replace(shared) for few in (none, one)]
    cases += [ring(count, **{"solver.rtol": 1e-5}) for count in (2, 4)]
    empty, *pulls = (late(td.simulate(case), "element_force")[:, 0] for case in cases)
    assert np.min(pulls[0]) > 16.0
    for count, pull in ((2, pulls[1]), (4, pulls[2])):
        # The integration errs by 2e-4 of it; at rtol = 1e-3 by 1e-2, and by 6e-4 between.
        np.testing.assert_allclose(pull - empty, count * (pulls[0] - empty), rtol=1e-3)


def test_a_vane_of_twice_the_clearance_moves_as_alone_on_the_ring_of_equal_ones(equal: xr.Dataset) -> None:
    """Within what the ring gives way: a slide of it turns a lever (x, y) by x/(x² + y²) of the way at most.

    More than that the ring cannot turn either, since the actuator holds it.
    """
    x, y = 24.240900475e-3, 43.730752842e-3
    loose = td.simulate(ring(4, **{"joints.trunnion[3].clearance.radial": "40 um"}))
    together = late(loose, "output_error")[:, 2] - late(equal, "output_error")[:, 2]
    time, slides = np.linspace(0.0, 1.0, 120), [one.sel(joint="guide") for one in (equal, loose)]
    way = np.interp(time, equal["time"].values, slides[0]["displacement"].values[:, 2])
    case: Any = ring(4)
    held = {
        "drives.slide.joint": "guide",
        "drives.slide.position.interpolation": "smooth",
        "drives.slide.position.times": f"{', '.join(map(repr, time.tolist()))} s",
        "drives.slide.position.values": f"{', '.join(map(repr, way.tolist()))} m",
    }
    alone = with_entries(case.one_copy(equal, [0.5]), held, "test")
    both = [alone.replace({"joints.trunnion.clearance.radial": play}) for play in ("20 um", "40 um")]
    turns = [late(td.simulate(one).sel(body="vane"), "orientation") for one in both]
    less, more = (2.0 * np.arctan2(turn[:, 3], turn[:, 0]) for turn in turns)
    moved = late(slides[1], "displacement")[:, 2] - late(slides[0], "displacement")[:, 2]
    gives_way = np.abs(moved).max() * x / (x**2 + y**2)
    assert gives_way < 0.03 * np.abs(together).max()
    np.testing.assert_allclose(more - less, together, atol=gives_way)


def test_two_links_turn_the_ring_as_one_does_and_leave_its_guide_their_difference() -> None:
    """Of one link the guide bears the whole pull; two on opposite sides are a couple but for the rest."""
    text = TEMPLATES["vsv-ring"].text
    link = text[text.index("[bodies.actuator]") : text.index("[bodies.vane]")]
    for old, new in (
        *(("actuator", "second"), ("cylinder", "other"), ("piston", "push"), ("drag-link", "drag-link-2")),
        *((" 420 mm", " -420 mm"), ('"150, ', '"-150, ')),
    ):
        link = link.replace(old, new)
    motion = next(line for line in link.splitlines() if line.startswith("position"))
    case = ring(4, **{"solver.rtol": 1e-5})
    pushed = link.replace(motion, 'force = { value = "35 N" }')
    both = parse_case(f"{case.to_toml()}\n{pushed}", "test")
    one, two = td.simulate(case), td.simulate(both)
    assert late(two, "output_error") == pytest.approx(late(one, "output_error"), rel=1e-3)
    for found, most in ((one, 75.0), (two, 4.0)):
        links = late(found, "element_force")
        bearing = late(found.sel(joint="guide"), "reaction_force_global")[:, 0]
        # The links stay along x within 1e-3 of their force; the ring's inertia takes 5 mN.
        assert bearing == pytest.approx(links @ [1.0, -1.0][: links.shape[1]], abs=0.1)
        assert np.abs(bearing).max() < most


def test_a_limit_is_of_what_the_drive_gives() -> None:
    with pytest.raises(InputError, match="the limit of this drive is force_limit"):
        ring(2, **{"drives.piston.torque_limit": "1 N m"})


def test_charts_go_over_the_position_of_the_actuator(equal: xr.Dataset) -> None:
    label, values = angle_of(equal, "cylinder")
    assert label == "position of cylinder [mm]"
    time = equal["time"].values
    assert values == pytest.approx(-20.0 * (1.0 - np.cos(time)), abs=0.1)
    assert coordinates(equal, 1.0)[0]["label"] == label
