"""Motion of shafts in their bores between the rows of a result."""

from dataclasses import dataclass

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.core.splines import Cubics
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.views.playback import LINE_ERROR, dense_times, in_playback


@dataclass(frozen=True)
class Shafts:
    """Shafts of the joints of a result.

    Attributes
    ----------
    dataset
        The result.
    case
        Its case; without one the motion is that of straight lines between rows.
    """

    dataset: xr.Dataset
    case: MechanismCase | None

    def path(self, joint: int) -> FloatArray:
        """Return places in the bore over the playback, which straight lines may join [m], shape (n, 3)."""
        inside = in_playback(self.dataset)
        time, values = self.dataset["time"].values[inside], self._displacement(joint)[inside]
        if time.size < 2 or not self._has_rates:
            return values
        rates = self._rates(joint)[inside]
        room = LINE_ERROR * float(self.dataset["clearance"].values[joint])
        return Cubics(time, values, rates)(dense_times(time, values[:, :2], rates[:, :2], room))

    def at(self, joint: int, times: FloatArray) -> FloatArray:
        """Return the places at other times [s] in the axes of the joint [m], shape (n, 3)."""
        time, values = self.dataset["time"].values, self._displacement(joint)
        if self._has_rates:
            return Cubics(time, values, self._rates(joint))(times)
        return np.stack([np.interp(times, time, column) for column in values.T], axis=-1)

    def _displacement(self, joint: int) -> FloatArray:
        return np.asarray(self.dataset["displacement"].values[:, joint])

    @property
    def _has_rates(self) -> bool:
        """Whether velocities are the rates of displacements: analyses without dynamics have others."""
        dynamic = self.case is not None and self.case.run.analysis == "dynamic"
        return dynamic and "relative_velocity" in self.dataset and self.dataset.sizes["time"] > 1

    def _rates(self, joint: int) -> FloatArray:
        """Return the velocity of the shaft [m/s], shape (n_t, 3): results hold that of the second body."""
        assert self.case is not None
        sign = list(self.case.joints.values())[joint].sign
        return np.asarray(sign * self.dataset["relative_velocity"].values[:, joint])
