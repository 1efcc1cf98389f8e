"""Other packages: their versions, and their settings in the working directory, which commands ignore."""

import os
import platform
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import chdir, nullcontext
from functools import cache
from importlib import metadata
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from types import ModuleType
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


_FILES: Final = {"numba.core.config": ".numba_config.yaml", "matplotlib": "matplotlibrc"}
"""Modules that read settings when they are imported, and the file that they look for."""


class _Loader(SourceFileLoader):
    """Executes a module with another working directory where its file lies in this one."""

    def exec_module(self, module: ModuleType) -> None:
        """Execute the module."""
        # Only then: other threads have the same working directory.
        with chdir(os.sep) if os.path.lexists(_FILES[self.name]) else nullcontext():
            super().exec_module(module)
        if self.name == "numba.core.config":
            # It looks again each time that it compiles.
            vars(module)["_config_fname"] = os.devnull


class _Finder:
    """Finds these modules for :class:`_Loader`."""

    @staticmethod
    def find_spec(name: str, path: Sequence[str] | None, _: ModuleType | None = None) -> ModuleSpec | None:
        """Return the loader of a module; None for all others."""
        found = PathFinder.find_spec(name, path) if name in _FILES else None
        if found is not None and isinstance(found.loader, SourceFileLoader):
            found.loader = _Loader(found.loader.name, found.loader.path)
            return found
        return None


def ignore_settings() -> None:
    """Ignore settings of other packages in the working directory, from now on, in this process."""
    os.environ["NCRCENV_IGNORE"] = "1"
    if _Finder not in sys.meta_path:
        sys.meta_path.insert(0, _Finder)
