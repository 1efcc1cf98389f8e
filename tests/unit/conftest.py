"""A made-up result with the shape of a real one, for tests of what reads results."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import xarray as xr

import tribodyn.simulation
from mebdf.arrays import FloatArray
from tribodyn.core.errors import IntegrationFailure
from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.results import build
from tribodyn.results.variables import BUSHING

ResultFactory = Callable[..., xr.Dataset]

VSV = MECHANISMS["vsv"]

PERIOD = 2.0 * np.pi
IMPACT_TIME = 0.1 * np.pi
CLEARANCE = 20e-6
LENGTH = 20e-3
SURFACE_ROUGHNESS = 1.634e-6


def _ringing(t: FloatArray, scale: float) -> FloatArray:
    """Return what the impacts after each reversal add, shape (n_t,)."""
    since = np.mod(t, np.pi)
    return scale * np.exp(-since / 0.03) * np.sin(since / 0.004)


def _motion(t: FloatArray) -> dict[str, FloatArray]:
    theta_a = np.deg2rad(-16.0 + 20.0 * (1.0 - np.cos(t)))
    omega_a = np.deg2rad(20.0 * np.sin(t))
    ideal = np.deg2rad(61.0) + 1.48 * (theta_a + np.deg2rad(16.0))
    direction = np.where(np.sin(t) >= 0.0, 1.0, -1.0)
    error = direction * np.deg2rad(0.02) * (1.0 + 0.2 * np.cos(t)) + _ringing(t, 1e-4)
    return {
        "theta_a": theta_a,
        "theta_b": 0.12 * np.sin(ideal - np.pi / 2),
        "theta_v": ideal + error,
        "theta_v_ideal": ideal,
        "omega_a": omega_a,
        "omega_v": 1.48 * omega_a + _ringing(t, 2e-3),
        "omega_v_ideal": 1.48 * omega_a,
        "h_1": 0.05 * (np.sin(ideal) - 1.0),
    }


def _attitude(t: FloatArray) -> dict[str, FloatArray]:
    direction = np.tanh(np.sin(t) / 0.02)
    return {
        "e_x": 3e-6 * -direction + _ringing(t, 4e-6),
        "e_y": 6e-6 + 1e-6 * np.cos(2 * t) + _ringing(t, 2e-6),
        "phi_x": 9e-4 + 1e-4 * np.cos(t),
        "phi_y": 4e-4 * direction + 5e-5 * np.cos(t),
        "e_x_dot": _ringing(t, 1e-3),
        "e_y_dot": _ringing(t, 5e-4),
        "phi_x_dot": _ringing(t, 0.1),
        "phi_y_dot": _ringing(t, 0.1),
    }


def _forces(t: FloatArray) -> dict[str, FloatArray]:
    direction = np.tanh(np.sin(t) / 0.02)
    rigid = {"F_kx": 18.0 * direction + 2.0 * np.cos(t), "F_ky": -4.0 - np.cos(2 * t)}
    damping = {"F_dx": _ringing(t, 120.0), "F_dy": _ringing(t, 30.0)}
    return {
        **rigid,
        **damping,
        "F_cx": rigid["F_kx"] + damping["F_dx"],
        "F_cy": rigid["F_ky"] + damping["F_dy"],
        "M_d": 0.9 * direction + _ringing(t, 1.0),
        "p_max": 1e6 * (12.0 + 2.0 * np.cos(t) + np.abs(_ringing(t, 40.0))),
    }


def _peaks(t: FloatArray, columns: dict[str, FloatArray]) -> dict[str, FloatArray]:
    """Return the peaks after the start and each reversal, read off the columns; some between rows."""
    sizes = {
        "contact_force": np.hypot(columns["F_cx"], columns["F_cy"]),
        "rigid_force": np.hypot(columns["F_kx"], columns["F_ky"]),
        "damping_force": np.hypot(columns["F_dx"], columns["F_dy"]),
        "pressure": columns["p_max"],
        "eccentricity": np.hypot(columns["e_x"], columns["e_y"]),
        "tilt": np.hypot(columns["phi_x"], columns["phi_y"]),
        "drive_moment": np.abs(columns["M_d"]),
        "vane_angle_error": np.abs(columns["theta_v"] - columns["theta_v_ideal"]),
    }
    stretch, early = t // np.pi, np.mod(t, np.pi) <= IMPACT_TIME
    numbers = np.unique(stretch)
    found = {"reversal": numbers, "reversal_time": np.pi * numbers}
    for part, more, inside in (("impact", 1.02, early), ("outside", 1.0, ~early)):
        where = [np.flatnonzero(inside & (stretch == k)) for k in numbers]
        for name, size in sizes.items():
            best = [w[np.argmax(size[w])] if w.size else -1 for w in where]
            found[f"{name}_{part}"] = np.array([more * size[k] if k >= 0 else np.nan for k in best])
            found[f"{name}_{part}_time"] = np.array([t[k] if k >= 0 else np.nan for k in best])
    return found


def _balances(t: FloatArray) -> dict[str, FloatArray]:
    heat = 0.02 * t + 1e-3 * np.sin(2 * t)
    values = {
        "energy_kinetic": 3e-3 * np.sin(t) ** 2,
        "energy_gravity": -0.05 * (1.0 - np.cos(t)),
        "energy_contact": 2e-4 + 1e-5 * np.cos(t),
        "energy_loads": -0.28 * t + 0.02 * np.sin(t),
        "energy_friction": heat,
        "energy_collar_friction": 0.3 * heat,
        "energy_collar_tilt": 1e-5 * t,
        "energy_damping": 6e-5 * t,
        "energy_residual": 1e-4 * t / PERIOD,
        "energy_clearance_inertia": 1e-5 * np.sin(t),
        "energy_clearance_loads": 1e-3 * (1.0 - np.cos(t)) + 3e-4 * t,
        "energy_clearance_contact": 2e-4 * (1.0 - np.cos(t)),
        "energy_clearance_friction": 2e-4 * t,
        "energy_clearance_collar": 1e-5 * t,
        "energy_clearance_damping": 6e-5 * t,
        "energy_clearance_residual": 1e-6 * t / PERIOD,
    }
    return {**values, "energy_drive": 0.3 * t + 0.03 * (1 - np.cos(t))}


def _pressure(theta: FloatArray, z: FloatArray, direction: float, share: float) -> FloatArray:
    """Return an edge-loaded pressure, shape (n_theta, n_z)."""
    tilt_x, tilt_y = 9e-4, 4e-4 * direction
    e_x, e_y = -12e-6 * direction, 8e-6
    gap = CLEARANCE + np.outer(np.cos(theta), e_x - z * tilt_y) + np.outer(np.sin(theta), e_y - z * tilt_x)
    return share * 90e6 * np.exp(-1.4 * np.clip(gap / SURFACE_ROUGHNESS, -1.0, None) ** 1.1 * 1.0)


def _film(t: FloatArray, theta: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return times and fields of the frames of one cycle."""
    times = np.linspace(0.0, min(t[-1], PERIOD), 13) if t.size else np.empty(0)
    film = [_pressure(theta, z, 1.0 if np.sin(s) >= 0.0 else -1.0, 1.0 + 0.2 * np.sin(s)) for s in times]
    return times, np.array(film).reshape(times.size, theta.size, z.size)


def _fields(t: FloatArray) -> tuple[dict[str, FloatArray], dict[str, FloatArray]]:
    """Return coordinates and fields of the six snapshots that were reached."""
    theta = np.linspace(0.0, 2 * np.pi, 96, endpoint=False)
    nodes = np.polynomial.legendre.leggauss(16)[0]
    z = 0.5 * LENGTH * np.concatenate([[-1.0], nodes, [1.0]])
    times = np.array([0.3, 1.55, 2.9, 3.4, 4.7, 6.0])
    times = times[times <= t[-1]] if t.size else times[:0]
    motion = _motion(times)
    direction = np.where(np.sin(times) >= 0.0, 1.0, -1.0)
    pictures = [
        _pressure(theta, z, s, share)
        for s, share in zip(direction, (1.0, 0.8, 1.2, 1.1, 0.7, 0.9), strict=False)
    ]
    pressure = np.array(pictures).reshape(times.size, theta.size, z.size)
    frames, film = _film(t, theta, z)
    coordinates = {
        "snapshot": np.arange(times.size),
        "snapshot_time": times,
        "snapshot_theta_v": motion["theta_v"],
        "snapshot_direction": direction,
        "frame": np.arange(frames.size),
        "frame_time": frames,
        "theta": theta,
        "z": z,
    }
    worn = 1e-12 * (_pressure(theta, z, 1.0, 1.0) + _pressure(theta, z, -1.0, 0.7)) / 90e6
    return coordinates, {
        "pressure": pressure,
        "pressure_cycle": film,
        "wear_depth": worn,
        "partner_wear_depth": 0.2 * worn,
    }


@pytest.fixture(scope="session")
def make_result() -> ResultFactory:
    """Return a maker of results with plausible signals (not the output of any simulation)."""

    def make(end: float = 2 * PERIOD, *, failure: str = "", **attributes: object) -> xr.Dataset:
        t = np.arange(0.0, end, 5e-3)
        coordinates, fields = _fields(t)
        columns = {**_motion(t), **_attitude(t), **_forces(t), **_balances(t)}
        peaks = _peaks(t, columns)
        coordinates |= {name: peaks.pop(name) for name in ("reversal", "reversal_time")}
        known = {**BUSHING, **VSV.variables}
        others = [n for n, v in known.items() if v.dims == ("time",) and n not in columns and n != "time"]
        facts: dict[str, object] = {
            "kind": "vsv",
            "title": "Vane mechanism with a dry, rough trunnion joint",
            "case": 'case = "vsv"\ntitle = "Vane mechanism with a dry, rough trunnion joint"\n',
            "tribodyn_version": "0.0",
            "python_version": "3.11.0",
            "solver": {
                "name": "bdf",
                "steps": 4321,
                "rejected": 12,
                "rhs_evaluations": 9876,
                "wall_time": 8.2,
            },
            "energy_residual": 3.1e-4,
            "clearance_energy_residual": 5.2e-3,
            "warnings": ["the friction coefficient 0.1 is assumed: the paper does not give it"],
            "time_reached": end,
            "failure": failure,
            "clearance": CLEARANCE,
            "joint_length": LENGTH,
            "cycle_period": PERIOD,
            "impact_time": IMPACT_TIME,
            "start": "equilibrium",
            "worn_volume": 4e-17,
            "wear_cycles_reached": 2,  # as if of a campaign, so that every key result is there
            "flash_temperature": 0.003,  # as if with the conductors of heat
            "wear_life_cycles": 3e6,
            "wear_life_factor": 80.0,
            "wear_depth_limit": 5e-6,
            "friction_coefficient": 0.1,
            "contact_law": "rsdc",
            "formulation": "exact",
        }
        return build(
            coordinates={"time": t, **coordinates},
            columns={**columns, **{name: np.zeros_like(t) for name in others}},
            fields={**fields, **peaks},
            attributes={**facts, **attributes},
            variables=VSV.variables,
        )

    return make


@pytest.fixture(scope="session")
def make_campaign(make_result: ResultFactory) -> ResultFactory:
    """Return a maker of results of wear campaigns with ``n_jumps`` stops (not the output of any)."""

    def make(n_jumps: int, **attributes: object) -> xr.Dataset:
        jump = np.arange(n_jumps, dtype=np.float64)
        depth = 1e-7 * (1.0 - np.exp(-jump / 10.0))
        history = {
            "wear_cycles": 1000.0 * jump,
            "wear_jump_cycles": np.where(jump < n_jumps - 1, 1000.0, 0.0),
            "wear_depth_max": depth,
            "wear_volume": 1e-6 * depth,
            "wear_rate": 1e-11 * np.exp(-jump / 10.0),
            "wear_load_change": np.where(jump > 0.0, 0.05, 0.0),
            "wear_pressure_max": 2e8 + 3e7 * np.sin(jump),
            "wear_pressure_mean": 1e7 * np.exp(-jump / 10.0),
            "wear_roughness": np.full(n_jumps, 1.6e-6),
            "wear_force_mean": np.full(n_jumps, 18.0),
            "wear_angle_error_max": np.full(n_jumps, 5e-4),
            "wear_angle_error_rms": 4e-4 + 1e-6 * jump,
            "wear_energy_lost": np.full(n_jumps, 1e-6),
        }
        cycles = history["wear_cycles"][1:]
        reached = int(cycles[-1]) if cycles.size else 0
        facts = {"wear_cycles_reached": reached, "worn_volume": float(1e-6 * depth.max(initial=0.0))}
        result = make_result(PERIOD, **facts, **attributes)
        profile = result["wear_depth"].values
        campaign = build(
            coordinates={"jump": jump, "stage_cycles": cycles},
            columns={},
            fields={**history, "stage_depth": np.ones((cycles.size, 1, 1)) * profile},
            variables=VSV.variables,
        )
        return result.merge(campaign)

    return make


@pytest.fixture
def simulated(monkeypatch: pytest.MonkeyPatch, make_result: Callable[..., xr.Dataset]) -> list[Any]:
    """Replace the simulation in this process; the cases it is given are in the list.

    A clearance of 30 um stops midway, one of 35 um raises an error that we know, one of 40 um one that
    we do not, one of 45 um warns.
    """
    seen: list[Any] = []

    def simulate(case: Any, **_: Any) -> xr.Dataset:
        seen.append(case)
        micrometres = round(case.joint.clearance * 1e6)
        if micrometres == 35:
            raise IntegrationFailure(0.0, "no equilibrium")
        if micrometres == 40:
            raise ZeroDivisionError("surprise")
        failure = "steps became too small" if micrometres == 30 else ""
        peak = micrometres * case.joint.friction_coefficient
        warned = ["odd"] if micrometres == 45 else []
        result = make_result(0.1, failure=failure, case=case.to_toml(), warnings=warned)
        result["contact_force_impact"].values[:] = 1e3 * peak
        # Few variables, because writing all of them takes longer than everything else here.
        return result[["F_cx", "F_cy", "p_max", "contact_force_impact"]]

    monkeypatch.setattr(tribodyn.simulation, "simulate", simulate)
    return seen
