"""Universal joint: a cross whose one axis the first body holds, and the other one the second.

The two axes stay at right angles, z · x' = 0. At an angle β between shafts the second turns unevenly,
tan θ_2 = tan θ_1/cos β.
"""

from typing import ClassVar

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.mechanism.data import DIRECTION
from tribodyn.mechanism.frames import frame
from tribodyn.mechanism.joints.joint_type import AT_POINT, JointType, Row


class Universal(JointType):
    """A cross of two axes."""

    NAME: ClassVar[str] = "universal"
    MEANING: ClassVar[str] = (
        "turns about `axis`, held by the first body, and `second_axis`, held by the second"
    )
    ROWS: ClassVar[tuple[Row, ...]] = (*AT_POINT, (DIRECTION, 2, 0))
    AXIS: ClassVar[str] = "axis"
    SECOND_AXIS: ClassVar[str] = "axis that the second body holds"

    def shaft_axes(self, first: FloatArray, second: FloatArray) -> FloatArray:
        """Return the axes of the second body: x is the axis that it holds."""
        across = frame(second, first)
        return np.column_stack([across[:, 2], -across[:, 1], across[:, 0]])
