"""Damping in proportion to the speed, P_d = 3/2 α P_k δ̇: its restitution is known for any stiffness."""

from dataclasses import replace

import numpy as np
import pytest

import tribodyn as td
from tribodyn.contact import law, tabulate
from tribodyn.contact.bounce import bounce
from tribodyn.contact.contact_law import MEMORYLESS
from tribodyn.contact.damping_factors import rebound
from tribodyn.core.errors import InputError
from tribodyn.joints import contact_table
from tribodyn.joints.drop import drop

ALPHA = 0.2


@pytest.mark.parametrize("speed", [0.01, 0.3, 2.0])
def test_a_plate_returns_what_the_energy_balance_says(table_1_pair, speed):
    table = tabulate(law("linear", table_1_pair, loss_coefficient=ALPHA))
    found = bounce(table, design_pressure=200e6, scale=speed / MEMORYLESS)
    # The springs touch below the onset, where damping is all there; the bounce is integrated to 1e-6.
    assert found.restitution == pytest.approx(float(rebound(np.array(1.5 * ALPHA * speed))), abs=1e-5)


def test_slow_impacts_lose_in_proportion_to_their_speed(table_1_pair):
    """Hunt and Crossley (1975): e = 1 − αv."""
    table = tabulate(law("linear", table_1_pair, loss_coefficient=ALPHA))
    found = bounce(table, design_pressure=200e6, scale=0.01 / MEMORYLESS).restitution
    # The next term of the energy balance is (αv)², 4e-6.
    assert 1.0 - found == pytest.approx(ALPHA * 0.01, rel=5e-3)


@pytest.mark.parametrize("speed", [0.01, 0.1])
def test_a_shaft_returns_it_too(make_joint, table_1_pair, speed):
    """Each point of a bushing has the same coefficient, so the balance holds for all of it."""
    chosen = law("linear", table_1_pair, loss_coefficient=1.0)
    joint = make_joint(grid=(384, 2), coefficient=0.0)
    table = contact_table("surface", chosen, joint.geometry, onset=4.0, smoothing_width=1.0)
    joint = replace(joint, table=table, entry=replace(joint.entry, minimum_velocity=MEMORYLESS))
    found = drop(joint, mass=0.25, speed=speed).restitution
    # Away from the middle of the arc a point approaches with the cosine of the speed.
    assert 1.0 - found == pytest.approx(1.0 - float(rebound(np.array(1.5 * speed))), rel=0.03)


def test_a_run_knows_no_least_entry_velocity():
    case = td.load_case("vsv").replace({"run.cycles": 0.6, "contact.loss_coefficient": "0.2 s/m"})
    one, other = (
        td.simulate(case.replace({"contact.minimum_entry_velocity": v})) for v in ("0.1 mm/s", "5 mm/s")
    )
    np.testing.assert_array_equal(one.F_cx, other.F_cx)
    assert abs(one.attrs["energy_residual"]) < 1e-3
    assert float(one.energy_damping[-1]) != 0.0


@pytest.mark.parametrize("also", [{"contact.restitution": 0.7}, {"contact.damping_factor": "flores"}])
def test_two_kinds_of_damping_are_refused(also):
    with pytest.raises(InputError, match="either this or"):
        td.load_case("vsv").replace({"contact.loss_coefficient": "0.2 s/m"} | also)
