"""Tribo-dynamics of mechanisms with dry, rough, worn clearance joints.

>>> import tribodyn as td
>>> case = td.load_case("mine.toml").replace({"joint.clearance": "30 um"})  # doctest: +SKIP
>>> result = td.simulate(case)  # doctest: +SKIP

Names are imported when first used, so that ``import tribodyn`` costs nothing.
"""

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tribodyn import contact, integrate, studies
    from tribodyn.cases.materials import MATERIALS as materials
    from tribodyn.mechanism.analyses.shaft_in_bore import stribeck
    from tribodyn.mechanism.builder.mechanism_builder import Mechanism
    from tribodyn.mechanisms.catalogue import load_case
    from tribodyn.mechanisms.results import read
    from tribodyn.simulation import check, simulate

__all__ = [
    "Mechanism",
    "__version__",
    "check",
    "contact",
    "integrate",
    "load_case",
    "materials",
    "read",
    "simulate",
    "stribeck",
    "studies",
]

_HOME = {
    "Mechanism": "tribodyn.mechanism.builder.mechanism_builder:Mechanism",
    "check": "tribodyn.simulation:check",
    "load_case": "tribodyn.mechanisms.catalogue:load_case",
    "materials": "tribodyn.cases.materials:MATERIALS",
    "read": "tribodyn.mechanisms.results:read",
    "simulate": "tribodyn.simulation:simulate",
    "stribeck": "tribodyn.mechanism.analyses.shaft_in_bore:stribeck",
}
_GIVING_RESULTS = ("read", "simulate")


def __getattr__(name: str) -> Any:
    """Import a public name at its first use."""
    if name == "__version__":
        return importlib.import_module("importlib.metadata").version("tribodyn")
    if name in _HOME:
        module, _, attribute = _HOME[name].partition(":")
        value = getattr(importlib.import_module(module), attribute)
        if name in _GIVING_RESULTS:
            importlib.import_module("tribodyn.accessor")
        globals()[name] = value
        return value
    if name in __all__:
        return importlib.import_module(f"tribodyn.{name}")
    raise AttributeError(f"module 'tribodyn' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
