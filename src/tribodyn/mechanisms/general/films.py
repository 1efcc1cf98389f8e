"""What results hold of oil films: nothing without any, and nothing of joints without one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.mechanisms.general.model import Model
from tribodyn.mechanisms.general.variables import OIL


def film_columns(couplings: Mapping[str, FloatArray], model: Model) -> dict[str, FloatArray]:
    """Return what is observed of films, each of shape (n_t, n_joints) or (n_t, n_joints, 3)."""
    found = {}
    for name in OIL if model.oiled else ():
        found[name] = np.full_like(couplings[name][:, : len(model.joints)], np.nan)
        found[name][:, model.oiled] = couplings[name][:, model.oiled]
    return found


def film_peaks(oil: Any, model: Model) -> dict[str, FloatArray]:
    """Return what was largest or least of each film at any step, each of shape (n_joints,).

    ``oil`` are the records of ``kernels/joints/film.py``.
    """
    found = {}
    for name in oil.dtype["peaks"].names if model.oiled else ():
        found[name] = np.full(len(model.joints), np.nan)
        found[name][model.oiled] = np.where(np.isfinite(oil["peaks"][name]), oil["peaks"][name], np.nan)
    return found
