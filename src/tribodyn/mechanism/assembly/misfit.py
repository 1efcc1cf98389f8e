"""A mechanism whose ideal joints do not fit: how much of the clearances it needs to be put together.

Where the joints cannot all close, the bodies are placed where ideal joints and drives close and where the
joints with clearance miss by the least share of what each allows, by Gauss and Newton.
"""

import math
from collections.abc import Mapping
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.joints.clearances import Clearance
from tribodyn.kernels import dense
from tribodyn.kernels.mechanism.data import DIRECTION, POINT
from tribodyn.mechanism.assembly.closing import System
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.shapes import SHAPES

#: Share of its clearance from which on a joint surely seizes: shares add up squared here, and of two poses
#: the one in which the largest is least may be better by about as much.
MOST: Final = 1.5
_HARD: Final = 1.0e-4  #: Weight of what allows nothing, as a part of the least that a joint allows.
_NOTHING: Final = 0.01  #: Share that is not worth a word.
_MOST_STEPS: Final = 60
_SMALL: Final = 1.0e-7  #: Change of a step, in units of the size or in radians, that ends the iteration.


class Misfit:
    """The ideal counterpart of a mechanism, closed as far as its clearances allow.

    Attributes
    ----------
    system
        The counterpart, whose bodies are moved.
    shares
        The largest share of its clearance that each joint has needed so far, by its name.
    """

    def __init__(self, model: Model, system: System) -> None:
        self.system, self.shares = system, dict[str, float]()
        self._joints = dict(zip(model.real, model.clearances, strict=True))
        shapes = {name: joint.shape for name, joint in model.case.joints.items() if joint.real is not None}
        allowed = {k: _allowed(shapes[name], model.clearances[name]) for k, name in self._joints.items()}
        self._allowed = np.array([self._of_row(k, m, allowed) for k, m in system.rows])

    def _of_row(self, k: int, m: int, allowed: Mapping[int, tuple[float, float, float]]) -> float:
        """Return by how much a row may miss, ways in units of the size; 0 for not at all."""
        record = self.system.parts.couplings[k]
        if k not in allowed:
            return 0.0
        across, along, tilt = allowed[k]
        if record.row_kind[m] == DIRECTION:
            return tilt
        way = along if record.row_axis[m] == 2 else across
        return way / self.system.size if record.row_kind[m] == POINT else 0.0

    @property
    def possible(self) -> bool:
        """Whether any joint has clearance."""
        return bool(self._joints)

    @property
    def weights(self) -> FloatArray:
        """One over what the joint of each row allows, ways in units of the size, shape (n_rows,)."""
        hard = _HARD * min(self._allowed[self._allowed > 0.0], default=1.0)
        return np.asarray(1.0 / np.where(self._allowed > 0.0, self._allowed, hard), np.float64)

    def close(self) -> bool:
        """Move the bodies to where the joints miss least; return whether the clearances take that."""
        weights = self.weights
        for _ in range(_MOST_STEPS):
            change = self._change(weights)
            self.system.step(change)
            if np.max(np.abs(change) / self._units, initial=0.0) < _SMALL:
                break
        shares = self._needed()
        self.shares = {name: max(share, self.shares.get(name, 0.0)) for name, share in shares.items()}
        return max(shares.values(), default=math.inf) <= MOST

    @property
    def _units(self) -> FloatArray:
        return np.array(np.tile(np.repeat([self.system.size, 1.0], 3), self.system.n), np.float64)

    def _residuals(self) -> FloatArray:
        """Return the misfit of each row, translations in units of the size, shape (n_rows,)."""
        return np.asarray(self.system.entries("residual") / self.system.row_units, np.float64)

    def _change(self, weight: FloatArray) -> FloatArray:
        """Return the step to where weighted rows miss least, shape (6 n,)."""
        rows = self.system.matrix() * self._units / self.system.row_units[:, None]
        asked = -weight * self._residuals()
        found = dense.lstsq(weight[:, None] * rows, asked, rcond=1e-13)
        change: FloatArray = np.multiply(found, self._units)
        return change

    def _needed(self) -> dict[str, float]:
        """Return the share of its clearance that each joint needs here; of ideal ones all or none."""
        missed, found = self._residuals(), dict[str, float]()
        for k, name in self._joints.items():
            parts = {"across": 0.0, "along": 0.0, "tilt": 0.0}
            for i, (coupling, m) in enumerate(self.system.rows):
                if coupling == k and self._allowed[i] > 0.0:
                    record = self.system.parts.couplings[k]
                    along = "along" if record.row_axis[m] == 2 else "across"
                    part = "tilt" if record.row_kind[m] == DIRECTION else along
                    parts[part] = math.hypot(parts[part], missed[i] / self._allowed[i])
            found[name] = max(parts["across"], parts["along"]) + parts["tilt"]
        hard = np.abs(missed[self._allowed == 0.0])
        if np.max(hard, initial=0.0) > _HARD * min(self._allowed[self._allowed > 0.0], default=0.0):
            return dict.fromkeys(found, math.inf)
        return found


def _allowed(shape: str, clearance: Clearance) -> tuple[float, float, float]:
    """Return the play of a shaft across and along its axis [m], and its tilt [rad].

    What surfaces give way until their contact law ends is part of it.
    """
    give = -clearance.table.h_first * clearance.roughness
    across, along, length = SHAPES[shape].room(clearance.shape)
    return across + give, along + give, 2.0 * (across + give) / length if length > 0.0 else math.inf


def described(shares: Mapping[str, float]) -> str:
    """Return in words which joints have to take how much."""
    needed = {name: share for name, share in shares.items() if share > _NOTHING}
    return ", ".join(f"{name} {100.0 * share:.2g} %" for name, share in needed.items())
