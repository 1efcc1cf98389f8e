"""With what a result was made."""

from __future__ import annotations

import platform
from typing import Final

from tribodyn.core.versions import version

_PACKAGES: Final = ("tribodyn", "numpy", "scipy", "numba")


def provenance() -> dict[str, str]:
    """Return the versions of Python and of the packages that made the numbers."""
    versions = {f"{name}_version": version(name) for name in _PACKAGES}
    return versions | {"python_version": platform.python_version()}
