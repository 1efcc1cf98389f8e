"""The clearance at temperature, against closed forms and elasticity."""

from __future__ import annotations

import numpy as np
import pytest

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.joints.expansion import Casing, clearance_rates, expanded
from tribodyn.joints.shapes import Cylinder
from tribodyn.kernels.actions import NONE
from tribodyn.papers.cheng_2022.reduced.equilibrium import equilibrium
from tribodyn.papers.cheng_2022.reduced.system import VsvSystem

COLD = Cylinder(clearance=60e-6, radius=6e-3, length=20e-3)
ALPHA_T, ALPHA_B, ALPHA_C, NU, THICKNESS, RISE = 12e-6, 50e-6, 11e-6, 0.34, 1e-3, 380.0
CASING = Casing(ALPHA_C * RISE, THICKNESS, NU)


def test_a_free_bushing_widens() -> None:
    hot = expanded(COLD, trunnion=ALPHA_T * RISE, bushing=ALPHA_B * RISE)
    # c + ΔT (α_b r_b − α_t r_j), to rounding.
    assert hot.clearance == pytest.approx(60e-6 + RISE * (ALPHA_B * 6.06e-3 - ALPHA_T * 6e-3), rel=1e-9)
    assert hot.bore_radius == pytest.approx(6.06e-3 * (1.0 + ALPHA_B * RISE), rel=1e-14)


def test_a_bonded_sleeve_closes_the_clearance() -> None:
    hot = expanded(COLD, trunnion=ALPHA_T * RISE, bushing=ALPHA_B * RISE, casing=CASING)
    thicker = ALPHA_B * RISE + 2.0 * NU / (1.0 - NU) * (ALPHA_B - ALPHA_C) * RISE
    closing = RISE * (ALPHA_T * 6e-3 - ALPHA_C * 7.06e-3) + THICKNESS * thicker
    assert hot.clearance == pytest.approx(60e-6 - closing, rel=1e-9)
    # What 380 K on a sleeve of polyimide take from a clearance: the range that the paper studies.
    assert 15e-6 < closing < 40e-6


def test_the_thickening_is_that_of_a_sheet_held_in_its_plane() -> None:
    """Hooke's law: ε_x = ε_y = ε_c, σ_z = 0, each strain αΔT plus an elastic part."""
    free, held = ALPHA_B * RISE, ALPHA_C * RISE
    compliance = np.array([[1.0, -NU, -NU], [-NU, 1.0, -NU], [-NU, -NU, 1.0]])
    stress = np.linalg.solve(compliance[:2, :2], np.full(2, held - free))
    strain = free + compliance[2, :2] @ stress
    assert strain == pytest.approx(free + 2.0 * NU / (1.0 - NU) * (free - held), rel=1e-12)


def test_a_seizure_is_refused_in_words() -> None:
    tight = Cylinder(clearance=20e-6, radius=6e-3, length=20e-3)
    with pytest.raises(InputError, match="would seize") as caught:
        expanded(tight, trunnion=ALPHA_T * RISE, bushing=ALPHA_B * RISE, casing=CASING)
    assert caught.value.key == "joint.clearance"
    needed = float(str(caught.value).split("more than ")[1].split(" um")[0]) * 1e-6
    expanded(
        Cylinder(6e-3, 1.01 * needed, 20e-3), trunnion=ALPHA_T * RISE, bushing=ALPHA_B * RISE, casing=CASING
    )


def test_a_hot_run_is_the_cold_run_of_its_clearance() -> None:
    hot = td.load_case("vsv").replace(
        {
            "run.cycles": 0.1,
            "joint.clearance": "50 um",
            "surfaces.trunnion.thermal_expansion": "12e-6 1/K",
            "temperature.trunnion": "400 degC",
        }
    )
    run = td.simulate(hot)
    assert "not 50 um" in run.attrs["notes"]
    assert run.attrs["assembly_clearance"] == 50e-6
    same = td.simulate(
        hot.replace(
            {
                "joint.clearance": f"{run.attrs['clearance']} m",
                "joint.radius": f"{6e-3 * (1.0 + 12e-6 * 380.0)} m",
                "temperature.trunnion": "20 degC",
            }
        )
    )
    assert run.attrs["clearance"] == pytest.approx(50e-6 - 6e-3 * 12e-6 * 380.0, rel=1e-9)
    # The same numbers but for the rounding of the radius.
    peaks = [result["contact_force_impact"].values for result in (run, same)]
    assert peaks[0] == pytest.approx(peaks[1], rel=1e-6)


EXPANSIONS = {
    "surfaces.trunnion.thermal_expansion": "12e-6 1/K",
    "surfaces.bushing.thermal_expansion": "50e-6 1/K",
}


def over_time(part: str, times: str, values: str) -> dict[str, str]:
    return {f"temperature.over_time.{part}.times": times, f"temperature.over_time.{part}.values": values}


@pytest.fixture(scope="module")
def cooling() -> td.Case:
    """The clearance falls by 5.9 um in 3 s, first fast."""
    table = over_time("bushing", "0, 1, 3 s", "60, 45, 40 degC")
    return td.load_case("vsv").replace(EXPANSIONS | table | {"run.duration": "3 s"})


def test_a_moving_clearance_closes_both_balances(cooling: td.Case) -> None:
    run = td.simulate(cooling)
    assert run.attrs["energy_residual"] < 0.01
    assert run.attrs["clearance_energy_residual"] < 0.01
    # Without its entry the balance of the clearance would miss more than all that the contact stores.
    stored = np.abs(run["energy_clearance_contact"]).max()
    assert np.abs(run["energy_expansion"]).max() > 5.0 * stored
    clearance = run["radial_clearance"].values
    # Bushing: α ΔT r_b, at the start and at the end.
    expected = [20e-6 + 50e-6 * rise * 6.02e-3 for rise in (40.0, 20.0)]
    assert clearance[[0, -1]] == pytest.approx(expected, rel=1e-9)


def test_a_slow_change_passes_through_the_equilibria(cooling: td.Case) -> None:
    """Against the equilibrium of a joint that has the clearance of that time for good."""
    run = td.simulate(cooling)
    problem = VsvSystem(cooling).problem(3.0)
    data, memory = problem.data, problem.memory
    data.mechanism.opening = NONE
    memory.joint.scratch.pose.opening = memory.joint.scratch.pose.v_opening = 0.0
    for t in (1.2, 2.0, 2.8):
        row = run.isel(time=int(np.abs(run["time"].values - t).argmin()))
        still = data._replace(joint=data.joint._replace(clearance=float(row["radial_clearance"])))
        there = equilibrium(
            still, memory, float(row["time"]), direction=1.0, slip_speed=float(row["omega_v"])
        )
        # Measured: 0.03 um at most, ringing; the clearance moves by 5.8 um and the trunnion with it.
        assert [float(row["e_x"]), float(row["e_y"])] == pytest.approx(there[:2], abs=0.1e-6)


def test_a_trunnion_that_seizes_on_the_way_is_refused_before_the_run() -> None:
    table = over_time("trunnion", "0, 1, 2 s", "20, 250, 350 degC")
    case = td.load_case("vsv").replace(EXPANSIONS | table | {"run.duration": "0.9 s"})
    with pytest.raises(InputError, match="would seize: 2 s after the start") as caught:
        case.replace({"run.duration": "2 s"})
    assert caught.value.key == "temperature.over_time"


def test_a_run_says_what_the_heat_did_to_the_material() -> None:
    case = td.load_case("vsv").replace(EXPANSIONS | {"run.cycles": 0.02, "temperature.bushing": "110 degC"})
    tables = {
        "temperature.properties.temperatures": "20, 200 degC",
        "temperature.properties.young_modulus": "7, 5 GPa",
        "temperature.properties.hardness": "490, 490 MPa",
    }
    notes = str(td.simulate(case.replace(tables)).attrs["notes"])
    assert "not 20 um. Of the material change surfaces.bushing.young_modulus by -14.3 %." in notes
    given = case.replace(tables | {"surfaces.bushing.young_modulus": "6.5 GPa"})
    assert "Of the material" not in str(td.simulate(given).attrs["notes"])


def test_a_sleeve_of_the_casings_material_is_part_of_it() -> None:
    alone = expanded(COLD, trunnion=0.0, bushing=2e-3)
    bonded = expanded(COLD, trunnion=0.0, bushing=2e-3, casing=Casing(2e-3, THICKNESS, NU))
    assert bonded.bore_radius == pytest.approx(alone.bore_radius, rel=1e-14)


@pytest.mark.parametrize("casing", [None, CASING])
def test_the_clearance_is_linear_in_the_strains(casing: Casing | None) -> None:
    rates = clearance_rates(COLD, casing)
    hot = expanded(COLD, trunnion=ALPHA_T * RISE, bushing=ALPHA_B * RISE, casing=casing)
    strains = {"trunnion": ALPHA_T * RISE, "bushing": ALPHA_B * RISE, "casing": ALPHA_C * RISE}
    gained = sum(rate * strains[part] for part, rate in rates.items())
    assert hot.clearance == pytest.approx(60e-6 + gained, rel=1e-9)


def test_a_constant_table_is_the_constant_temperature() -> None:
    case = td.load_case("vsv").replace(EXPANSIONS | {"run.cycles": 0.1})
    kept = case.replace({"temperature.trunnion": "100 degC", "temperature.bushing": "60 degC"})
    trunnion = over_time("trunnion", "0, 0.2, 0.7 s", "100, 100, 100 degC")
    tables = case.replace(trunnion | over_time("bushing", "0, 5 s", "60, 60 degC"))
    first, second = td.simulate(kept), td.simulate(tables)
    assert set(second) - set(first) == {"radial_clearance"}
    for name in first:
        np.testing.assert_array_equal(first[name].values, second[name].values, err_msg=str(name))
