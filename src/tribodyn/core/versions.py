"""Versions of packages and of Python."""

import platform
from functools import cache
from importlib import metadata
from typing import Final

_PACKAGES: Final = ("tribodyn", "numpy", "scipy")


# Looked up in files each time, which takes as long as some of what asks for it.
@cache
def version(package: str) -> str:
    """Return the version of an installed package."""
    return metadata.version(package)


def provenance() -> dict[str, str]:
    """Return the versions of Python and of the packages that made the numbers."""
    versions = {f"{name}_version": version(name) for name in _PACKAGES}
    return versions | {"python_version": platform.python_version()}
