"""A slider-crank whose wrist is real: it tends to the ideal one, and its books close at every clearance."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from tests.unit.mechanism.drawings import Run, chain, run, slider_crank, with_clearance

from tribodyn.contact import SurfacePair, law
from tribodyn.joints.clearances import Clearance, contact_table
from tribodyn.mechanism.assembly.assembly import assemble
from tribodyn.mechanism.assembly.parts_by_number import Model

TURN = 0.012  #: One turn of the crank at 5000 rpm [s].
TIMES = TURN * np.linspace(0.0, 2.0, 401)
LAST = TIMES >= TURN  #: The second turn: the shaft starts in the middle and lands in the first.
WRIST = 2
POINT = "point-lankarani-nikravesh"


def with_wrist(make_clearance: Callable[..., Clearance], clearance: float) -> Model:
    """Return the slider-crank with a wrist pin of 9.5 mm in a bushing."""
    real = make_clearance("cylinder", grid=(96, 4), radius=9.5e-3, clearance=clearance, slip_velocity=1e-3)
    return with_clearance(slider_crank(), real, "wrist")


@pytest.fixture(scope="module")
def ideal() -> Run:
    return run(slider_crank(), TIMES, 1e-6)


@pytest.fixture(scope="module")
def real(make_clearance: Callable[..., Clearance]) -> dict[float, Run]:
    """Runs over clearance, from the velocities of the ideal mechanism; otherwise it strikes at 12 m/s."""
    sizes, begin = (200e-6, 100e-6, 50e-6, 20e-6, 5e-6), assemble(slider_crank()).state
    return {c: run(with_wrist(make_clearance, c), TIMES, 1e-4, state=begin) for c in sizes}


def test_energy_and_momentum_close_at_every_clearance(real: dict[float, Run]) -> None:
    for clearance, result in real.items():
        assert result.imbalance < 1e-2, clearance
        change = result.whole("momentum_x") - result.whole("momentum_x")[0]
        left = np.abs(change - result.whole("impulse_x")).max()
        assert left < 1e-2 * np.ptp(result.whole("momentum_x")), clearance


def test_motion_and_mean_forces_tend_to_the_ideal_ones(ideal: Run, real: dict[float, Run]) -> None:
    def force(result: Run) -> float:
        return float(
            np.mean(
                np.hypot(
                    result.joint(WRIST, "reaction_force", "x"), result.joint(WRIST, "reaction_force", "y")
                )[LAST]
            )
        )

    for clearance, result in real.items():
        # The pin lies within the clearance, and a few micrometres deeper where surfaces give way.
        off = np.abs(result.body(2, "position", "x") - ideal.body(2, "position", "x")).max()
        assert off < 1.5 * clearance + 5e-6, clearance
        assert result.whole("gap").max() < 1e-10
    errors = [abs(force(result) / force(ideal) - 1.0) for result in real.values()]
    # Impacts at 200 um, next to none at 5 um.
    assert errors[-1] < 1e-2
    assert errors[-1] < errors[0]


def test_a_loose_wrist_flies_and_strikes_as_in_the_literature(make_clearance, ideal):
    """Half a millimetre, steel, Lankarani and Nikravesh with e = 0.9: chaotic, so compared in kind."""
    pair = SurfacePair((207e9, 207e9), (0.3, 0.3), (0.4e-6, 0.4e-6), 2e9, 0.03e12, 8e-6)
    chosen = law("ceb", pair, damping_factor="lankarani-nikravesh", restitution=0.9)
    loose = make_clearance("cylinder", contact=POINT, radius=10e-3, clearance=5e-4, coefficient=0.0)
    table = contact_table(POINT, chosen, loose.shape, onset=4.0, smoothing_width=1.0)
    loose = replace(loose, table=table, roughness=pair.roughness_rms)
    model = with_clearance(slider_crank(), loose, "wrist")
    times = TURN * np.linspace(0.0, 4.0, 4001)
    longest = 0
    for rtol in 1e-4 * np.linspace(0.8, 1.2, 5):
        result = run(model, times, rtol)
        assert result.imbalance < 1e-2
        later = times > TURN
        force = np.hypot(
            result.joint(WRIST, "reaction_force", "x"), result.joint(WRIST, "reaction_force", "y")
        )[later]
        peak = (
            np.abs(result.body(2, "acceleration", "x")[later]).max()
            / np.abs(ideal.body(2, "acceleration", "x")).max()
        )
        # 6 to 10 over tolerances from 1e-4 to 1e-5 and restitutions from 0.5 to 0.9.
        assert peak > 3.0
        flying = force == 0.0
        assert 0.02 < np.mean(flying) < 0.5
        landings = np.flatnonzero(np.diff(flying.astype(int)) == -1)
        assert landings.size >= 5
        longest = max(longest, np.diff(np.flatnonzero(flying)).max())
    # Impacts end flights; between them contact lasts for a twentieth of a turn and longer: in 9 of 10 runs.
    assert longest > 50


@pytest.mark.parametrize("socket", ["ground", "crank"])
def test_a_driven_real_joint_turns_the_same_way_wherever_its_socket_is(make_clearance, socket):
    real = make_clearance("flanged", radius=9.5e-3, flange=14e-3)
    driven = with_clearance(slider_crank(), real, "main", socket=socket)
    result = run(driven, TURN * np.linspace(0.0, 0.1, 11), 1e-4)
    # At the start the crank turns at the speed of the drive, to within what the clearance lets it tilt.
    assert result.body(0, "angular_velocity", "z") == pytest.approx(5000.0 * np.pi / 30.0, rel=1e-2)


def test_every_pin_of_a_chain_may_be_real(make_clearance: Callable[..., Clearance]) -> None:
    pin = make_clearance(
        "flanged", grid=(24, 4), radius=5e-3, length=10e-3, clearance=50e-6, axial=50e-6, flange=8e-3
    )
    hanging = chain(4)
    real = with_clearance(hanging, pin, *hanging.joints)
    times = np.linspace(0.0, 0.05, 11)
    ours, ideal = run(real, times, 1e-4), run(hanging, times, 1e-6)
    # Four clearances, and what the surfaces give way.
    assert ours.body(3, "position", "z") == pytest.approx(ideal.body(3, "position", "z"), abs=5e-4)
    assert ours.imbalance < 1e-2
