"""The larger and the smaller of two numbers, in the form that loops over four nodes at once understand.

Python's ``max`` and ``min`` choose one of two; to the compiler, a running maximum made of such choices is no
sum that it may split. The processor's own maximum is. NaN stays NaN.
"""

from typing import Any, Final

from mebdf.compiled.kernel import UNCOMPILED, Instruction

_MODULE: Final = "tribodyn.kernels.instructions"
larger: Final[Any] = max if UNCOMPILED else Instruction(max, _MODULE, "larger")
smaller: Final[Any] = min if UNCOMPILED else Instruction(min, _MODULE, "smaller")
