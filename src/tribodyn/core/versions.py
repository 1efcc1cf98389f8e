"""Versions of packages and of Python."""

import platform
from collections.abc import Iterable, Iterator
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


def unexpected(error: BaseException) -> str:
    """Return words for an error that nobody foresaw, or for packages with versions that are too old."""
    fault = f"internal error, please report it: {type(error).__name__}: {error}"
    return "; ".join(_not_as_declared(metadata.requires("tribodyn") or ())) or fault


def _not_as_declared(requirements: Iterable[str]) -> Iterator[str]:
    """Yield a sentence for each package that is not installed as required."""
    from packaging.requirements import Requirement  # where something failed, and nowhere else

    for needed in map(Requirement, requirements):
        if needed.marker is None or needed.marker.evaluate({"extra": ""}):
            installed = next((each.version for each in metadata.distributions(name=needed.name)), None)
            if installed is None or not needed.specifier.contains(installed, prereleases=True):
                there = f"{needed.name} {installed}" if installed else f"no {needed.name}"
                yield f'{there} is installed, tribodyn needs "{needed}"; install that one'
