"""A made-up result of the slider-crank: its ideal motion in closed form, and contact made up."""

import numpy as np
import xarray as xr
from tests.unit.mechanism.slider_crank import parsed

from tribodyn.kernels.mechanism.observe import BODY, COUPLING
from tribodyn.mechanism.mechanism_variables import BODIES, JOINTS, VARIABLES
from tribodyn.results import build

N = 61
SURFACES = ("wrist:barrel", "wrist:upper face")


def _about_z(angle):
    zero = np.zeros_like(angle)
    return np.stack([np.cos(0.5 * angle), zero, zero, np.sin(0.5 * angle)], axis=-1)


def result(failure: str = "") -> xr.Dataset:
    """Return one turn of the crank."""
    case = parsed()
    t = np.linspace(0.0, 0.012, N)
    turn = 2.0 * np.pi * t / 0.012
    swing = -np.arcsin(50.0 / 120.0 * np.sin(turn))
    pin = 0.05 * np.stack([np.cos(turn), np.sin(turn), 0.0 * t], axis=-1)
    along = 0.12 * np.stack([np.cos(swing), np.sin(swing), 0.0 * t], axis=-1)
    zero = 0.0 * turn
    shapes = {"body": (N, 3), "joint": (N, 4)}
    sizes = {quantity.name: quantity.size for quantity in (*BODY, *COUPLING)}
    columns = {
        name: np.zeros(shapes[part] if sizes[name] == 1 else (*shapes[part], sizes[name]))
        for part, table in (("body", BODIES), ("joint", JOINTS))
        for name in table
    }
    columns["position"] = np.stack([0.0 * pin, pin + 0.5 * along, pin + along], axis=1)
    columns["orientation"] = np.stack([_about_z(turn), _about_z(swing), _about_z(zero)], axis=1)
    columns["velocity"] = np.gradient(columns["position"], t, axis=0)
    columns["joint_angle"][:, 0] = turn
    columns["displacement"][:, 2, 0] = 22e-6 * np.cos(turn)
    columns["displacement"][:, 2, 1] = 21e-6 * np.sin(turn)
    columns["relative_velocity"] = np.gradient(columns["displacement"], t, axis=0)
    columns["reaction_force"][:, :, 0] = np.outer(np.cos(turn), [900.0, 2000.0, 2700.0, 40.0])
    columns["reaction_force"][:, :, 1] = np.outer(np.sin(turn), [300.0, 500.0, 0.0, 0.0])
    columns["drive_moment"][:, 0] = 100.0 * np.sin(2.0 * turn)
    columns["pressure_max"][:, 2] = 4e7 * np.cos(turn) ** 2
    columns |= {name: np.full((N, 4), np.nan) for name in ("film_pressure_max", "film_thickness_min")}
    columns["film_force"] = np.full((N, 4, 3), np.nan)
    columns["film_force"][:, 2] = columns["reaction_force"][:, 2]
    columns["film_pressure_max"][:, 2] = 2e7 * np.cos(turn) ** 2
    columns["film_thickness_min"][:, 2] = 3e-6
    theta = 2.0 * np.pi * np.arange(12) / 12
    barrel = 4e7 * np.clip(np.cos(theta[None] - turn[:, None]), 0.0, None)
    pressure = np.zeros((N, 2, 4, 12))
    pressure[:, 0] = barrel[:, None] * np.array([1.0, 0.8, 0.8, 1.0])[:, None]
    energy = {name: 0.1 * np.sin(turn) for name in ("energy_kinetic", "energy_in")}
    rest = ("energy_gravity", "energy_stored", "energy_friction", "energy_damping", "energy_residual", "gap")
    return build(
        variables=VARIABLES,
        coordinates={
            "time": t,
            "body": list(case.bodies),
            "joint": list(case.joints),
            "surface": list(SURFACES),
            "axis": ["x", "y", "z"],
            "entry": ["w", "x", "y", "z"],
            "output": ["slider"],
            "output_unit": ["m"],
            "cause": ["clearance", "tilt", "friction"],
            "frame": np.arange(float(N)),
            "frame_time": t,
            "row": np.arange(4.0),
            "column": np.arange(12.0),
            "row_place": np.array([[-0.01, -0.005, 0.005, 0.01], [0.0095, 0.011, 0.013, 0.014]]),
            "column_angle": np.array([theta, theta]),
            "film": ["wrist"],
            "film_angle": theta,
            "film_row": np.arange(3.0),
            "film_place": np.array([[-0.01, 0.0, 0.01]]),
        },
        columns={
            **columns,
            **energy,
            **{name: zero for name in rest},
            "output_error": 2e-5 * np.cos(turn)[:, None],
            "error_estimate": 1e-5 * np.cos(turn)[:, None, None, None] * np.ones((1, 4, 3)),
        },
        fields={
            "clearance": np.array([np.nan, np.nan, 20e-6, np.nan]),
            "pressure_cycle": pressure,
            "film_pressure_cycle": barrel[:, None, :, None] * np.array([0.0, 1.0, 0.0]),
            "pressure_peak": np.array([4e7, np.nan]),
            "film_pressure_peak": np.array([np.nan, np.nan, 2e7, np.nan]),
            "wear_depth": 1e-9 * pressure.max(axis=0) / 4e7,
        },
        attributes={
            "title": case.title,
            "kind": case.kind(),
            "case": case.to_toml(),
            "solver": {"name": "mebdf", "steps": 10.0, "rhs_evaluations": 20.0, "wall_time": 1.0},
            "energy_residual": 1e-6,
            "cycle_period": 0.012,
            "worn_volume": 1e-15,
            "warnings": [],
            "failure": failure,
        },
    )
