"""Loads from tables: constants as tables, energy balances where tables kink and of what they add."""

import math
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from tests.analytic.vane.full_system import assert_solved
from tests.journals import BORE

import tribodyn as td
from tribodyn.cases.case import with_entries
from tribodyn.core.signals import constant, sinusoid, spline
from tribodyn.kernels.vsv import functions
from tribodyn.kernels.vsv.data import AIR_M, AIR_X, AIR_Y, AIR_Z, BEND_X, BEND_Y, TIME, VANE
from tribodyn.kernels.vsv.functions import observe
from tribodyn.kernels.vsv.quantities import OBSERVED
from tribodyn.mechanisms.catalogue import parse_case
from tribodyn.mechanisms.shaft_loads import Term
from tribodyn.papers.cheng_2022.reduced.drives import ideal_motion, run_segments
from tribodyn.papers.cheng_2022.reduced.problem import vsv_data, vsv_memory
from tribodyn.papers.cheng_2022.reduced.system import vsv_of

SAME = 1e-12  #: A constant, and a spline through equal values: rounding.
NEIGHBOUR = 1e-9  #: Runs whose loads differ by rounding: 1e-11 after 50 ms.
#: Of the largest term: the balance of the clearance motion misses 2.2e-3, 1.1e-3 and 6e-4 of it at relative
#: tolerances of 1e-3, 1e-4 and 1e-5.
CLOSED = 5e-3
OFF = """
case = "vsv"
[loads]
air_force_x = "0.4 N"
air_force_y = "0 N"
air_moment = "0 N m"
"""
PLAIN = OFF.replace('"0 N"', '"1.2 N"').replace('"0 N m"', '"0.84 N m"')


def run(text: str, duration: str = "0.3 s") -> xr.Dataset:
    return td.simulate(parse_case(text, "test").replace({"run.duration": duration}))


FORCES = {
    "value": '"1.2 N"',
    "over time": '{times = "0, 5 s", values = "1.2, 1.2 N"}',
    "map": '{times = "0, 1, 5 s", angles = "0, 180 deg", values = "1.2, 1.2, 1.2, 1.2, 1.2, 1.2 N"}',
}
MOMENTS = {
    "value": '"0.84 N m"',
    "over time": '{times = "0, 1, 2, 5 s", values = "0.84, 0.84, 0.84, 0.84 N m"}',
    "map": '{angles = "0, 90, 180, 200 deg", values = "0.84, 0.84, 0.84, 0.84 N m"}',
}


@pytest.mark.parametrize("form", FORCES)
def test_a_constant_table_is_the_constant(form: str) -> None:
    own = run(
        f"{OFF}\n[loads.more.gas]\nforce_y = {FORCES[form]}\n"
        f"[loads.more.brake]\nagainst_motion = true\nmoment = {MOMENTS[form]}\n",
        "0.05 s",
    )
    paper = run(PLAIN, "0.05 s")
    for name in ("F_airy", "M_air", "e_x", "phi_y", "F_cx", "M_d", "energy_loads", "energy_clearance_loads"):
        # A map is a product of two splines; its rounding is that of a neighbouring run.
        same = NEIGHBOUR if form == "map" and "air" not in name else SAME
        size = float(np.abs(paper[name]).max())
        np.testing.assert_allclose(own[name], paper[name], rtol=0.0, atol=same * size)


def test_a_kinked_load_closes_the_balances() -> None:
    """A moment over the vane angle, a force over time and a map, two of which kink."""
    result = run(
        OFF
        + """
[loads.more.kinked]
moment = {angles = "40, 63, 63, 130 deg", values = "-0.4, 0.6, 0.6, 0.1 N m"}
force_y = {times = "0, 0.11, 0.11, 0.3, 1 s", values = "2, -1, -1, 2, 2 N"}
centre_of_pressure = "100 mm"
[loads.more.brake]
moment = {times = "0, 1 s", angles = "40, 130 deg", values = "0.2, 0.5, 0.4, 0.1 N m"}
against_motion = true
[loads.pulses.surge]
force_x = "1.5 N"
force_z = "-3 N"
begin = "0.15 s"
length = "60 ms"
[loads.passing.blades]
moment = "0.02 N m"
order = 3
shaft_speed = "600 rpm"
""",
        "0.6 s",
    )
    assert not result.attrs["failure"]
    assert result.attrs["energy_residual"] < 1e-4
    assert result.attrs["clearance_energy_residual"] < CLOSED
    times, angle = result["time"].values, np.degrees(result["theta_v_ideal"].values)
    for kink in (0.11, 0.15, 0.21):
        assert np.abs(times - kink).min() < 1e-12
    # The ideal vane passes the kink at a row, that is at the end of a step.
    assert np.abs(angle - 63.0).min() < 1e-6
    assert float(result["F_airx"].max()) > 1.0
    work = np.trapezoid(result["M_air"] * result["omega_v"], times)
    # The moment does nearly all of the work; forces move by micrometres.
    assert float(result["energy_loads"][-1]) == pytest.approx(work, rel=2e-2)


def test_no_step_crosses_a_kink() -> None:
    kinked = 'moment = {angles = "0, 75, 75, 90, 90, 200 deg", values = "0, 0, 0, 1, 1, 1 N m"}'
    case = parse_case(f"{OFF}\n[loads.more.a]\n{kinked}\n", "test")
    vsv = vsv_of(case)  # type: ignore[arg-type]
    found = run_segments(vsv, 2.0 * math.pi)
    angles = np.degrees(ideal_motion(vsv.lengths, vsv.drive, 2.0 * math.pi).vane_angle(found.breaks))
    np.testing.assert_allclose(angles, [75.0, 90.0, 120.277, 90.0, 75.0], atol=1e-3)
    np.testing.assert_allclose(np.diff(found.breaks[[0, 2, 4]]), [math.pi - found.breaks[0]] * 2)
    assert list(found.turns) == [pytest.approx(math.pi)]
    ends = np.degrees([found.segments.low[:, VANE], found.segments.high[:, VANE]])
    held = [(0, 75), (75, 90), (90, 200), (90, 200), (75, 90), (0, 75)]
    np.testing.assert_allclose(ends.T, held, atol=1e-6)


def loaded(vsv, terms):
    return vsv_data(replace(vsv, terms=tuple(terms)))


ALL = [
    Term(AIR_X, ((constant(3.0), TIME),)),
    Term(AIR_Y, ((sinusoid(0.0, 2.0, 3.0, 0.5), TIME),)),
    Term(AIR_Z, ((constant(-4.0), TIME),)),
    Term(BEND_X, ((constant(0.05), TIME),)),
    Term(BEND_Y, ((spline([0.0, 1.0, 2.0, 3.0], [0.1, -0.1, 0.2, 0.0]), VANE),)),
    Term(AIR_M, ((constant(0.3), TIME), (spline([0.0, 1.0, 3.0], [1.0, 0.5, -1.0]), VANE)), against=True),
]


@pytest.mark.parametrize("formulation", ["exact", "paper"])
def test_projected_equations_equal_the_full_system_under_all_loads(make_vsv, formulation) -> None:
    vsv = make_vsv(formulation, clearance=2e-3)
    data = loaded(vsv, ALL)
    for seed in range(10):
        random = np.random.default_rng(seed)
        y = random.uniform(-1.0, 1.0, 8) * [5e-4, 5e-4, 0.05, 0.05, 1e-2, 1e-2, 1.0, 1.0]
        memory = vsv_memory(data)
        f, row = np.empty(8), np.empty(len(OBSERVED))
        t = random.uniform(0.0, 3.0)
        functions.rhs(t, y, data, memory, f)
        observe(t, y, data, memory, row)
        assert_solved(vsv, data.mechanism, y, memory.scratch, f[4:], row)
        assert row[OBSERVED.index("F_airz")] == -4.0


def test_a_force_beside_the_centre_is_that_force_and_its_moment(make_vsv) -> None:
    """Virtual work of the point at 120 mm, whose displacement is e_x + 120 mm tan φ_y."""
    vsv = make_vsv("exact", clearance=2e-3)
    at_rest, y = loaded(vsv, []), np.array([1e-4, 2e-4, 0.02, -0.03, 0.0, 0.0, 0.0, 0.0])
    arm = 0.12 - vsv.vane_arm
    force = loaded(vsv, [Term(AIR_X, ((constant(5.0), TIME),)), Term(BEND_Y, ((constant(5.0 * arm), TIME),))])
    loads = []
    for data in (at_rest, force):
        memory = vsv_memory(data)
        functions.rhs(0.5, y, data, memory, np.empty(8))
        loads.append(memory.scratch.load[1:].copy())
    found = loads[1] - loads[0]
    # F_43x grows with the force on the vane and with it the collar's share: compare what the point adds.
    point = 5.0 * np.array([1.0, 0.0, 0.0, 0.12 / math.cos(y[3]) ** 2])
    centre = loaded(vsv, [Term(AIR_X, ((constant(5.0), TIME),))])
    memory = vsv_memory(centre)
    functions.rhs(0.5, y, centre, memory, np.empty(8))
    with_centre = memory.scratch.load[1:] - loads[0]
    at_centre = 5.0 * np.array([1.0, 0.0, 0.0, vsv.vane_arm / math.cos(y[3]) ** 2])
    np.testing.assert_allclose(found - with_centre, point - at_centre, rtol=0.0, atol=1e-12)


def test_a_load_spread_along_the_span_acts_at_its_centroid() -> None:
    case = parse_case(
        f'{OFF}\n[loads.more.gas]\nforce_y = "10 N"\n'
        '[loads.more.gas.span]\npositions = "10, 70, 130 mm"\nvalues = "0, 50, 100 N/m"\n',
        "test",
    )
    # A triangle from 10 to 130 mm has its centroid two thirds down.
    assert case.loads.more["gas"].arm == pytest.approx(0.09, rel=1e-12)  # type: ignore[attr-defined]


def test_a_kinked_load_and_a_reversed_journal_close_their_balance() -> None:
    changes = {
        f"{BORE}.friction_coefficient": 0.1,
        "drives.motor.speed.times": "0, 2, 2, 6, 6, 20 ms",
        "drives.motor.speed.values": "100, 100, 100, -100, -100, -100 rad/s",
        "loads.x.force.times": "0, 3, 3, 5, 20 ms",
        "loads.x.force.values": "100, 200, 200, 50, 50 N",
        "loads.y.along": "bearing",
        "loads.y.force.angles": "-2, 0.1, 0.1, 1 rad",
        "loads.y.force.values": "10, 50, 50, 40 N",
        "run.duration": "8 ms",
    }
    result = td.simulate(with_entries(td.load_case("journal-dry"), changes, "test"))
    assert not result.attrs["failure"]
    assert result.attrs["energy_residual"] < CLOSED
    assert float(result["joint_angle"][-1, 0]) == pytest.approx(0.2 + 0.0 - 0.2, abs=1e-9)
    power = -result["reaction_moment"][:, 0, 2] * result["relative_rate"][:, 0, 2]
    driven = float((result["energy_in"] - result["energy_loads"])[-1])
    assert driven == pytest.approx(float(np.trapezoid(power, result["time"])), rel=1e-2)
