"""Threads of the linear algebra, and settings of other packages in the working directory.

The working directory may hold files of strangers. With ``.numba_config.yaml`` numba takes machine code from
any folder, with ``matplotlibrc`` Matplotlib runs any program, and netCDF's files name servers and passwords.
Scripts and notebooks that import this package are left as they are: there the directory is the user's own.
"""

import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import chdir, contextmanager, nullcontext
from functools import lru_cache
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from types import ModuleType
from typing import Final

from threadpoolctl import ThreadpoolController


@contextmanager
def one_thread() -> Iterator[None]:
    """Have matrices factorised by one thread within the block.

    Matrices of mechanisms are small. Several threads gain nothing there; beside other work they wait for each
    other and take many times as long, and how many there are decides the last digits of sums.
    """
    with _libraries(len(sys.modules)).limit(limits=1, user_api="blas"):
        yield


@lru_cache(maxsize=1)
def _libraries(_modules: int) -> ThreadpoolController:
    """Return the libraries of this process. The search takes milliseconds; only imports add libraries."""
    return ThreadpoolController()


#: Modules that read settings when they are imported, and the file that they look for.
_FILES: Final = {"numba.core.config": ".numba_config.yaml", "matplotlib": "matplotlibrc"}


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
