"""Type aliases of arrays."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

FloatArray: TypeAlias = NDArray[np.float64]
"""Array of double precision numbers; shape and unit stand in the docstring that uses it."""

IntArray: TypeAlias = NDArray[np.int64]
"""Array of integers."""
