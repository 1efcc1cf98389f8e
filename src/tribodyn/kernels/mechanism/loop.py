"""The functions of a mechanism as a problem, and the loop over its steps."""

from typing import Any, Final

from tribodyn.kernels.mebdf.drive import loop
from tribodyn.kernels.mechanism.functions import accept, advance, enter, jac_entries, observe, picture, rhs
from tribodyn.kernels.mechanism.newton import factorise, solve

LOOP: Final = loop(rhs, jac_entries, advance, accept, observe, picture, factorise, solve)
FUNCTIONS: Final[dict[str, Any]] = {
    "rhs": rhs,
    "jac": jac_entries,
    "enter": enter,
    "advance": advance,
    "accept": accept,
    "observe": observe,
    "picture": picture,
}
"""Functions by the names that ``CompiledFunctions`` of ``core/problem.py`` has for them."""
