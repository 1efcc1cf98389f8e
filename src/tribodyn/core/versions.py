"""Versions of packages."""

from __future__ import annotations

from functools import cache
from importlib import metadata


# Looked up in files each time, which takes as long as some of what asks for it.
@cache
def version(package: str) -> str:
    """Return the version of an installed package."""
    return metadata.version(package)
