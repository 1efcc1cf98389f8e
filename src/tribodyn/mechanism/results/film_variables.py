"""Variables of oil films in results: none without any, and none of joints without one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from tribodyn.core.arrays import FloatArray
from tribodyn.core.problem import Floats
from tribodyn.kernels.film.data import FilmData
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.mechanism_variables import OIL


def film_columns(couplings: Mapping[str, FloatArray], model: Model) -> dict[str, FloatArray]:
    """Return the observed quantities of films, each of shape (n_t, n_joints) or (n_t, n_joints, 3)."""
    found = {}
    for name in OIL if model.oiled else ():
        if name not in couplings:
            continue
        found[name] = np.full_like(couplings[name][:, : len(model.joints)], np.nan)
        found[name][:, model.oiled] = couplings[name][:, model.oiled]
    return found


def film_peaks(oil: Any, model: Model) -> dict[str, FloatArray]:
    """Return the largest or least values of each film at any step, each of shape (n_joints,).

    ``oil`` are the records of ``kernels/joints/film.py``.
    """
    found = {}
    for name in oil.dtype["peaks"].names if model.oiled else ():
        found[name] = np.full(len(model.joints), np.nan)
        found[name][model.oiled] = np.where(np.isfinite(oil["peaks"][name]), oil["peaks"][name], np.nan)
    return found


def film_coordinates(films: FilmData, model: Model) -> dict[str, ArrayLike]:
    """Return names of the joints with a film and places of its nodes; nothing without films."""
    if not model.oiled:
        return {}
    return {
        "film": [model.joints[number] for number in model.oiled],
        "film_angle": np.sort(_angles(films.wear_node.shape[1])),
        "film_row": np.arange(films.wear_node.shape[2], dtype=np.float64),
        "film_place": np.array(films.z_node),
    }


def film_maps(films: FilmData, pictures: Floats) -> dict[str, Floats]:
    """Return pressure fields of films by name, nothing without films.

    Of a film with a groove the field is zero: its nodes turn with the groove.

    Parameters
    ----------
    films
        What kernels read of all films.
    pictures
        Fields over the nodes of all films [Pa], shape (n_frames, n_nodes).
    """
    n, n_theta, n_z = films.wear_node.shape
    if not films.constants.size:
        return {}
    order = np.argsort(_angles(n_theta))
    maps = pictures.reshape(-1, n, n_z, n_theta).transpose(0, 1, 3, 2)[:, :, order]
    maps[:, films.constants["groove"] == 1] = 0.0
    return {"film_pressure_cycle": maps}


def _angles(n_theta: int) -> FloatArray:
    """Return the angles of a film's nodes [rad]: opposite to the push of their pressure on the shaft."""
    return np.asarray(np.mod(2.0 * np.pi * np.arange(n_theta) / n_theta + np.pi, 2.0 * np.pi))
