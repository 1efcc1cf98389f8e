import numpy as np
import pytest

import tribodyn as td
from tribodyn.contact import Liner, SurfacePair, law, lined, tabulate
from tribodyn.contact.bounce import bounce
from tribodyn.core.errors import InputError
from tribodyn.core.remembered import ContactTable
from tribodyn.kernels.lookup import pressure_and_damping, stored_energy

LINER = Liner(1e-3, 7.17e9, 0.34)
GAPS = np.array([-40.3, -8.01, -1.003, 0.501, 1.499, 2.502, 3.303])


@pytest.fixture(scope="module")
def table(table_1_pair: SurfacePair) -> ContactTable:
    return tabulate(law("rsdc", table_1_pair))


@pytest.fixture(scope="module")
def stiffness(table_1_pair: SurfacePair) -> float:
    return LINER.stiffness * table_1_pair.roughness_rms


def test_stiffness_of_a_polyimide_sleeve() -> None:
    # E(1 − ν)/((1 + ν)(1 − 2ν)t): confined, 7.17 GPa become 11.04.
    assert LINER.stiffness == pytest.approx(11.036e12, rel=1e-4)
    assert Liner(2e-3, 7.17e9, 0.34).stiffness == pytest.approx(0.5 * LINER.stiffness)


def test_on_a_rigid_base_nothing_changes(table: ContactTable) -> None:
    hard = lined(table, 1e25)
    assert (hard.h_first, hard.h_last, hard.inverse_step) == (table.h_first, table.h_last, table.inverse_step)
    np.testing.assert_allclose(hard.nodes, table.nodes, rtol=1e-9, atol=1e-12 * np.abs(table.nodes).max())


@pytest.mark.parametrize("gap", GAPS)
def test_asperities_and_layer_carry_the_same_pressure(table, stiffness, gap):
    soft = lined(table, stiffness)
    pressure, slope, damping, _ = pressure_and_damping(soft, gap)
    separation = gap + pressure / stiffness
    alone, its_slope, its_damping, _ = pressure_and_damping(table, separation)
    # The table's own interpolation: 1e-6 of a value, 1e-5 of a slope.
    assert pressure == pytest.approx(alone, rel=1e-6)
    share = 1.0 / (1.0 - its_slope / stiffness)
    assert slope == pytest.approx(its_slope * share, rel=1e-5)
    assert damping == pytest.approx(its_damping * share**2, rel=1e-5, abs=1e-9 * its_damping)


@pytest.mark.parametrize("gap", GAPS)
def test_stored_energy_is_that_of_both_springs(table: ContactTable, stiffness: float, gap: float) -> None:
    soft = lined(table, stiffness)
    pressure = pressure_and_damping(soft, gap)[0]
    separation = gap + pressure / stiffness
    both = stored_energy(table, separation) + 0.5 * pressure**2 / stiffness
    assert stored_energy(soft, gap) == pytest.approx(both, rel=1e-6)


def test_rigid_asperities_leave_the_layer_alone(table_1_pair: SurfacePair, stiffness: float) -> None:
    # The law's springs round their corner over a tenth of σ, so that they touch 0.2 σ above it.
    hard = tabulate(law("linear", table_1_pair, penalty_stiffness=1e3 * LINER.stiffness))
    soft = lined(hard, stiffness)
    for gap in (-200.0, -90.0, -30.0):
        assert pressure_and_damping(soft, gap)[0] == pytest.approx(-gap * stiffness, rel=1e-2)


def test_a_layer_gives_back_what_it_takes(table: ContactTable, stiffness: float) -> None:
    """The softer the layer, the larger its share of the energy, and it loses none."""
    returned = [
        bounce(t, onset=4.0, design_pressure=20e6).restitution
        for t in (
            table,
            lined(table, 4.0 * stiffness),
            lined(table, stiffness),
            lined(table, 1e-2 * stiffness),
        )
    ]
    assert np.all(np.diff(returned) > 0.0)
    assert returned[-1] > 0.98


def test_a_layer_of_rubber_is_refused() -> None:
    rubber = {"joint.liner.thickness": "1 mm", "surfaces.bushing.poisson_ratio": 0.5}
    with pytest.raises(InputError, match=r"below 0\.5"):
        td.load_case("vsv").replace(rubber)


def test_points_stand_on_no_liner() -> None:
    with pytest.raises(InputError, match="no liner"):
        td.load_case("vsv").replace({"joint.liner.thickness": "1 mm", "joint.contact": "point-johnson"})


def test_a_run_says_when_its_liner_is_not_thin() -> None:
    thick = td.load_case("vsv").replace({"joint.liner.thickness": "8 mm", "run.cycles": 0.1})
    assert "for a thin layer" in td.simulate(thick).attrs["warnings"]
    thin = thick.replace({"joint.liner.thickness": "0.5 mm"})
    assert "for a thin layer" not in td.simulate(thin).attrs["warnings"]
