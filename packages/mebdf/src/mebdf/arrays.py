"""Type aliases of arrays."""

from typing import Annotated, TypeAlias

import numpy as np
from numpy.typing import NDArray

#: Array of double precision numbers; shape and unit stand in the docstring that uses it.
FloatArray: TypeAlias = NDArray[np.float64]

IntArray: TypeAlias = NDArray[np.int64]  #: Array of integers.

FloatMatrix: TypeAlias = Annotated[FloatArray, 2]
FloatCube: TypeAlias = Annotated[FloatArray, 3]
#: Arrays with two and three dimensions; where compiled code is called, the others have one.
IntMatrix: TypeAlias = Annotated[IntArray, 2]
