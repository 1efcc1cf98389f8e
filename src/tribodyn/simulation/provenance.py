"""With what a result was made."""

from __future__ import annotations

import platform
from functools import cache
from importlib.metadata import version
from typing import Final

_PACKAGES: Final = ("tribodyn", "numpy", "scipy", "numba")


def provenance() -> dict[str, str]:
    """Return the versions of Python and of the packages that made the numbers."""
    versions = {f"{name}_version": _version(name) for name in _PACKAGES}
    return versions | {"python_version": platform.python_version()}


# Read from files each time: noticeable beside a short run.
_version = cache(version)
