"""The functions of the mechanism as a problem, and the loop over its steps."""

from typing import Any, Final

from tribodyn.kernels.mebdf.drive import loop
from tribodyn.kernels.vsv.functions import accept, advance, enter, jac, picture, rhs
from tribodyn.kernels.vsv.observe import observe

LOOP: Final = loop(rhs, jac, advance, accept, observe, picture)
FUNCTIONS: Final[dict[str, Any]] = {
    "rhs": rhs,
    "jac": jac,
    "enter": enter,
    "advance": advance,
    "accept": accept,
    "observe": observe,
    "picture": picture,
}
"""Functions by the names that ``CompiledFunctions`` of ``core/problem.py`` has for them."""
