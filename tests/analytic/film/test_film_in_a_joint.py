"""The oil film of a joint against film and contact by themselves, and a short bearing by an own solution."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

import tribodyn as td
from mebdf.arrays import FloatArray
from tribodyn.joints.bushing import joint_wrench
from tribodyn.joints.clearances import pose_at
from tribodyn.kernels.film.wrench import film_wrench
from tribodyn.kernels.jit import new_record
from tribodyn.kernels.joints.film import new_oil
from tribodyn.kernels.joints.surface.memory import Scratch
from tribodyn.kernels.mechanism.data import REPORTS, SLOPES, CouplingNow
from tribodyn.kernels.mechanism.forces import film_force
from tribodyn.lubrication import Film, FilmGrid, Roughness, stacked_data, stacked_memory
from tribodyn.mechanism.analyses.shaft_in_bore import journal_of
from tribodyn.mechanisms import results

SIZE = (0.01, 20e-6, 6e-3, 20e-3)
FILMS = {
    "rough": Film(*SIZE, Roughness((0.4e-6, 0.6e-6)), grid=FilmGrid(48, 8)),
    "half-sommerfeld": Film(*SIZE, cavitation="half-sommerfeld", grid=FilmGrid(48, 8)),
    "groove": Film(*SIZE, boundary="groove", grid=FilmGrid(48, 8)),
}
#: d [m], a rotation [rad], v [m/s] and ω [rad/s] of a shaft that leans, spins and slides.
LEANING = np.array([5e-6, 3e-6, 1e-3, 2e-4, -1e-4, 0.3, 1e-3, 2e-3, 0.01, 0.3, -0.2, 100.0])


class JointFilm:
    """A film as kernels of mechanisms call it, second of two."""

    def __init__(self, film: Film) -> None:
        self.films = stacked_data([film, film], [None, None])
        self.memory, self.oil = stacked_memory(self.films), new_oil(2)

    def __call__(
        self, motion: FloatArray, turn: Sequence[float] = (0.0, 0.0, 0.0), mode: float = REPORTS
    ) -> Any:
        """Return the coupling after the call; ``turn`` is a small rotation of the shaft [rad]."""
        rotation = Rotation.from_rotvec(turn) * Rotation.from_rotvec(motion[3:6])
        now: Any = new_record(CouplingNow)
        now.pose = pose_at(motion[:3], rotation.as_matrix(), motion[6:9], motion[9:])
        film_force(mode, self.films, self.memory, 1, now, new_record(Scratch), self.oil)
        return now


def test_a_level_film_is_the_film_by_itself() -> None:
    motion = np.array([5e-6, 3e-6, 0.0, 0.0, 0.0, 0.0, 1e-3, 2e-3, 0.0, 0.0, 0.0, 100.0])
    film, out = FILMS["rough"], np.empty(5)
    film_wrench(
        film.data(), film.memory(), np.array([5e-6, 3e-6, 0.0, 0.0, 1e-3, 2e-3, 0.0, 0.0]), 100.0, out
    )
    found = JointFilm(film)(motion).wrench
    assert found[[0, 1, 5]] == pytest.approx(out[[0, 1, 4]], rel=1e-14)
    assert not found[2:5].any()


@pytest.mark.parametrize("name", FILMS)
def test_derivatives_of_a_leaning_film_are_those_of_differences(name: str) -> None:
    film, steps = JointFilm(FILMS[name]), np.repeat([1e-10, 1e-8, 1e-7, 1e-5], 3)
    slope = np.array(film(LEANING, mode=SLOPES).slope)
    for k, step in enumerate(steps):
        change = step * np.eye(12)[k]
        turn, moved = change[3:6], change * np.repeat([1.0, 0.0, 1.0, 1.0], 3)
        ahead, back = (np.array(film(LEANING + s * moved, s * turn).wrench) for s in (1.0, -1.0))
        differences = (ahead - back) / (2.0 * step)
        assert slope[:, k] == pytest.approx(differences, abs=1e-5 * np.abs(differences).max()), k


@pytest.mark.parametrize("name", FILMS)
def test_a_film_turns_power_into_heat_and_pushes_across_the_shaft(name: str) -> None:
    film = JointFilm(FILMS[name])
    now = film(LEANING)
    twist = np.append(LEANING[6:9], LEANING[9:])
    assert film.oil[1]["power"] == pytest.approx(-now.wrench @ twist, rel=1e-12)
    assert film.oil[1]["power"] > 0.0
    # It resists no sliding along the axis of the shaft.
    axis = Rotation.from_rotvec(LEANING[3:6]).as_matrix()[:, 2]
    assert abs(now.wrench[:3] @ axis) < 1e-12 * np.linalg.norm(now.wrench[:3])


BEARING = {"radius": "6 mm", "radial": "20 um", "length": "20 mm", "friction_coefficient": 0}
RUN = {"duration": "5 ms", "output_interval": "0.25 ms"}


def bearing(
    mass: str,
    clearance: Mapping[str, object],
    film: Mapping[str, object],
    force: Mapping[str, object],
    run: Mapping[str, object],
    speed: str,
    rtol: float,
) -> td.Case:
    """Return the mechanism of one journal in a bearing at rest, with forces along x and y."""
    made = td.Mechanism(
        "Journal",
        solver={"rtol": rtol},
        run={**run, "start": "centred", "step_rows": 0},
        contact={"law": "ke"},
    )
    made.body("journal", mass=mass, centre="0, 0, 0 mm", inertia=["5.41e-4 kg m^2"] * 3)
    made.revolute("main", "ground", "journal", point="0, 0, 0 mm", axis=[0, 0, 1])
    made.clearance("main", **clearance).film("main", **film)
    for name, direction in (("x", [1, 0, 0]), ("y", [0, 1, 0])):
        made.load(name, "journal", direction=direction, force=force[name])
    return made.drive("motor", "main", speed=speed).case()


@pytest.mark.parametrize(("speed", "load"), [(0.0, 2000.0), (300.0, 200.0)])
def test_a_journal_in_oil_moves_as_film_and_contact_by_themselves(speed: float, load: float) -> None:
    """From the middle through the film onto the asperities, and with rotation.

    With damping the contact would remember approach speeds of accepted steps, which are others.
    """
    force = {"x": f"{load} N", "y": f"{0.5 * load} N"}
    case: Any = td.load_case("journal-oil").replace({"contact.law": "ke"})
    journal = journal_of(case)
    assert journal.film is not None
    contact, film, oil = journal.joint.data(), journal.film.data(), journal.film.memory()
    loads, of_film, zero = np.array([load, 0.5 * load]), np.empty(5), np.zeros(2)

    def rates(t: float, y: FloatArray) -> FloatArray:
        state = np.concatenate([y[:2], zero, y[2:4], zero])
        film_wrench(film, oil, state, speed, of_film)
        push = joint_wrench(contact, state, omega=speed)
        heat = -of_film[:2] @ y[2:4] - of_film[4] * speed
        return np.concatenate(
            [y[2:4], (loads + of_film[:2] + push[:2]) / case.bodies["journal"].mass, [heat]]
        )

    times = np.linspace(0.0, 5e-3, 21)
    atol = [1e-14, 1e-14, 1e-10, 1e-10, 1e-14]
    own = solve_ivp(rates, (0.0, 5e-3), np.zeros(5), "LSODA", times, rtol=1e-9, atol=atol)
    made = bearing("0.253 kg", BEARING, {"viscosity": "0.01 Pa s"}, force, RUN, f"{speed} rad/s", 1e-10)
    # Heats are integrals of parabolas over steps, which are long at this tolerance, or from row to row.
    joint = td.simulate(made.replace({"run.output_interval": "0.005 ms"})).isel(time=slice(None, None, 50))
    states = [np.concatenate([y[:2], zero, y[2:4], zero]) for y in own.y.T]
    wrenches = np.array([_film_at(film, oil, state, speed) for state in states])
    pushes = np.array([joint_wrench(contact, state, omega=speed) for state in states])
    pairs = {
        "displacement": (joint["displacement"][:, 0, :2], own.y[:2].T),
        "film_force": (joint["film_force"][:, 0, :2], wrenches[:, :2]),
        "film_moment": (joint["film_moment"][:, 0, 2], wrenches[:, 4]),
        "contact_force": (joint["contact_force"][:, 0, :2], pushes[:, :2]),
        "energy_film": (joint["energy_film"], own.y[4]),
    }
    for name, (found, wanted) in pairs.items():
        # The moment on a journal at rest is rounding of film pressures, a first touch that of loads.
        assert found.values == pytest.approx(wanted, abs=1e-6 * np.abs(wanted).max() + 1e-9), name
    carried = np.abs(pushes[:, 0]).max() / load
    assert carried > 0.1 if speed == 0.0 else carried < 1e-3
    assert joint.attrs["energy_residual"] < 1e-5


def _film_at(film: Any, memory: Any, state: FloatArray, speed: float) -> FloatArray:
    """Return the wrench of a film by itself, shape (5,)."""
    out = np.empty(5)
    film_wrench(film, memory, state, speed, out)
    return out


RADIUS, CLEARANCE, LENGTH, VISCOSITY, MASS, OMEGA = 25e-3, 25e-6, 6.25e-3, 0.01, 0.05, 300.0
#: Constant and rotating part of the load on a short bearing [N]; that rotates with the journal.
LOAD, TURNING = 14.0, 10.0


def short_bearing(x: FloatArray, v: FloatArray, angles: FloatArray) -> tuple[FloatArray, float]:
    """Return force [N] and largest pressure [Pa] of a film whose oil flows along the axis alone, p ≥ 0."""
    normal = np.stack([np.cos(angles), np.sin(angles)])
    gap, across = CLEARANCE - x @ normal, x @ np.stack([np.sin(angles), -np.cos(angles)])
    source = np.minimum(0.5 * OMEGA * across - v @ normal, 0.0)
    pressure = -6.0 * VISCOSITY * source / gap**3
    force = -(normal * pressure * LENGTH**3 / 6.0).sum(axis=1) * RADIUS * (angles[1] - angles[0])
    return force, float(np.max(pressure)) * LENGTH**2 / 4.0


def test_a_dynamically_loaded_short_bearing_moves_as_its_own_solution() -> None:
    """A constant and a rotating load, L/D = 1/8; the own solution is of J. F. Booker's short bearing."""
    turn, angles = 2.0 * np.pi / OMEGA, np.linspace(0.0, 2.0 * np.pi, 720, endpoint=False)
    times = np.linspace(2.0 * turn, 3.0 * turn, 41)
    duration = float(times[-1])

    def rates(t: float, y: FloatArray) -> FloatArray:
        load = np.array([LOAD + TURNING * np.sin(OMEGA * t), -TURNING * np.cos(OMEGA * t)])
        return np.append(y[2:], (short_bearing(y[:2], y[2:], angles)[0] + load) / MASS)

    own = solve_ivp(rates, (0.0, duration), np.zeros(4), "Radau", times, rtol=1e-6, atol=1e-11)
    sine = {"amplitude": f"{TURNING} N", "angular_frequency": f"{OMEGA} rad/s"}
    joint = td.simulate(
        bearing(
            f"{MASS} kg",
            {"radius": "25 mm", "radial": "25 um", "length": "6.25 mm", "friction_coefficient": 0},
            {
                "viscosity": f"{VISCOSITY} Pa s",
                "cavitation": "half-sommerfeld",
                "rough_flow": False,
                "grid": {"theta": 128, "z": 8},
            },
            {"x": {"value": f"{LOAD} N", **sine}, "y": {"value": "0 N", "phase": "-90 deg", **sine}},
            {"duration": f"{duration!r} s", "output_interval": f"{turn / 40.0!r} s"},
            f"{OMEGA} rad/s",
            1e-6,
        )
    )
    path = joint["displacement"].values[-41:, 0, :2]
    assert np.hypot(*path.T).max() > 0.5 * CLEARANCE
    assert path == pytest.approx(own.y[:2].T, abs=0.02 * CLEARANCE)
    states = zip(own.y[:2].T, own.y[2:].T, strict=True)
    wanted = np.array([short_bearing(x, v, angles)[1] for x, v in states])
    found = joint["film_pressure_max"].values[-41:, 0]
    assert found.max() == pytest.approx(wanted.max(), rel=0.02)
    assert joint["film_thickness_min"].values[-41:, 0].min() == pytest.approx(
        CLEARANCE - np.hypot(*own.y[:2]).max(), rel=0.02
    )


def test_the_pressure_map_of_a_film_adds_up_to_its_force(tmp_path: Path) -> None:
    results.write_run(td.simulate(td.load_case("slider-crank-oil").replace({"run.cycles": 0.3})), tmp_path)
    run = results.read(tmp_path)
    keys = td.load_case("slider-crank-oil").joints["big-end"].clearance
    pressure, place = run["film_pressure_cycle"].isel(film=0), run["film_place"].values[0]
    angle = run["film_angle"].values
    around = (keys.radius + keys.radial) * 2.0 * np.pi / angle.size
    force = run["film_force"].sel(joint="big-end").interp(time=run["frame_time"].values).values[:, :2]
    line = np.trapezoid(pressure.values, place, axis=2) * around
    found = -np.stack([line @ np.cos(angle), line @ np.sin(angle)], axis=1)
    np.testing.assert_allclose(found, force, atol=0.02 * np.abs(force).max())
    assert np.abs(force).max() > 100.0
