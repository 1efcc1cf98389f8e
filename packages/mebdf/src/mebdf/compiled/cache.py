"""Storage of compiled kernels: a folder named by all sources of their machine code.

Numba compiles a function again when its own file has changed, but not when a function that it calls has. So
after any change to any kernel, nothing that was compiled before is found: the folder has another name. What
is found was made from these very sources, wherever a copy of them lies.
"""

from __future__ import annotations

import hashlib
import os
import platform
import sys
import tempfile
import warnings
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any, Final, NamedTuple

import llvmlite
import numba as nb
import numpy as np
from llvmlite import binding
from numba.core import caching, codegen

from mebdf.compiled import claims, lean
from mebdf.compiled.private_folder import NotPrivate, locked, mark_used, private_folder, prune

_config: Final[Any] = nb.config  # made from the environment: its names are in no stub
_SWITCHES: Final = ("OPT", "LOOP_VECTORIZE", "SLP_VECTORIZE", "BOUNDSCHECK", "DEBUGINFO_DEFAULT")
"""Settings of numba that change what it compiles."""
_LAYOUT: Final = 2
"""Number of the layout of compiled functions in files."""
_DIGITS: Final = 32
_DIGEST: Final = hashlib.sha256().digest_size


@dataclass(frozen=True)
class Sources:
    """The files of a package that its machine code is made from.

    Attributes
    ----------
    package
        Folder of the package; its name is that of the place where machine code is kept.
    patterns
        Which files, as :meth:`pathlib.Path.glob` takes them, relative to ``package``.
    below
        Sources of other packages whose kernels are compiled into those of this one.
    """

    package: Path
    patterns: tuple[str, ...]
    below: tuple[Sources, ...] = ()

    def files(self) -> Iterator[tuple[str, Path]]:
        """Yield the name, the same in every copy of the packages, and the place of each file.

        Raises
        ------
        FileNotFoundError
            If no file matches a pattern, as where the package is no folder.
        """
        for sources in self.below:
            yield from sources.files()
        for pattern in self.patterns:
            found = sorted(self.package.glob(pattern))
            if not found:
                raise FileNotFoundError(str(self.package / pattern))
            yield from ((self.name_of(path), path) for path in found)

    def name_of(self, path: Path) -> str:
        """Return the name of a file of the package, the same in every copy; of another file its path."""
        if not path.is_relative_to(self.package):
            return str(path)
        return f"{self.package.name}/{path.relative_to(self.package).as_posix()}"


def cached(dispatcher: Any, sources: Sources, kind: str = "") -> Any:
    """Return a compiled function that keeps its machine code in :func:`folder`, if there is one.

    ``kind`` distinguishes what is compiled of the same function with other options.
    """
    function = getattr(dispatcher, "py_func", None)  # None where NUMBA_DISABLE_JIT is set
    if function is not None and _is_file(function.__code__.co_filename) and folder(sources) is not None:
        dispatcher._cache = _KernelCache(function, sources, kind)
    return dispatcher


@cache
def folder(sources: Sources) -> Path | None:
    """Return the folder of machine code made from the sources as they were when this process first asked.

    It is in ``NUMBA_CACHE_DIR`` where that is set, else in the user's folder for caches, else in the one for
    temporary files. None if the sources cannot be read or no place is safe: then nothing is kept.
    """
    with suppress(OSError):
        name = fingerprint(sources)
        for parent in _places(sources.package.name):
            try:
                return _opened(private_folder(parent) / name)
            except NotPrivate as problem:
                warnings.warn(f"Compiled code is not kept there: {problem}.", RuntimeWarning, stacklevel=2)
            except OSError:
                continue
    return None


def fingerprint(sources: Sources) -> str:
    """Return the hash of all that machine code is made from: sources, tools, settings and processor.

    Raises
    ------
    OSError
        If a source is missing or cannot be read.
    """
    digest = hashlib.sha256()
    for name, path in sources.files():
        content = path.read_bytes()
        digest.update(f"{name} {len(content)} ".encode() + content)
    digest.update(repr((*_tools(), *_processor())).encode())
    return digest.hexdigest()[:_DIGITS]


def _tools() -> tuple[object, ...]:
    versions = (sys.implementation.cache_tag, nb.__version__, llvmlite.__version__, np.__version__)
    return (_LAYOUT, *versions, *(getattr(_config, name, None) for name in _SWITCHES))


@cache
def _processor() -> tuple[str, ...]:
    """Return the name and the abilities of the processor that numba compiles for."""
    name = binding.get_host_cpu_name() if _config.CPU_NAME is None else _config.CPU_NAME
    features = codegen.get_host_cpu_features() if _config.CPU_FEATURES is None else _config.CPU_FEATURES
    return platform.machine(), name, features


def _places(package: str) -> Iterator[Path]:
    """Yield possible places of the folder of a package, the best place first."""
    # Not as numba has it, which also reads a file of the working directory that may be anybody's.
    if given := os.environ.get("NUMBA_CACHE_DIR"):
        yield Path(given).absolute() / package
    caches = Path(os.environ.get("XDG_CACHE_HOME", ""))
    if not caches.is_absolute():
        caches = Path(os.path.expanduser("~"), ".cache")
    if caches.is_absolute():
        yield caches / package
    user = os.geteuid() if hasattr(os, "geteuid") else ""
    yield Path(tempfile.gettempdir()) / f"{package}-{user}"


def _opened(place: Path) -> Path:
    """Return a folder for machine code; a new one takes the place of old ones."""
    new = not place.exists()
    mark_used(private_folder(place))
    if new:
        prune(place.parent, "[0-9a-f]" * _DIGITS)
    return place


@cache
def _is_file(path: str) -> bool:
    return os.path.isfile(path)


@cache
def _hash(path: str) -> str:
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


class _Locator(caching._CacheLocator):
    """Tells numba where the machine code of a function is, and which function that is."""

    def __init__(self, sources: Sources, kind: str, function: Any, path: str) -> None:
        self._sources, self._kind = sources, kind
        self._py_file = path  # numba's own messages ask for it
        self._line = function.__code__.co_firstlineno

    def get_cache_path(self) -> str:
        return str(folder(self._sources))

    def ensure_cache_path(self) -> None:
        """Make the folder again if another process, which had not seen it used for long, has removed it."""
        private_folder(Path(self.get_cache_path()))

    def get_source_stamp(self) -> str:
        """Return the hash of the file: functions outside the package are no part of the folder's name."""
        return _hash(self._py_file)

    def get_disambiguator(self) -> str:
        """Return a name that distinguishes functions of one name, the same in every copy of the package."""
        place = self._sources.name_of(Path(self._py_file))
        return f"{hashlib.sha256(place.encode()).hexdigest()[:12]}-{self._line}{self._kind}"


class _Locators(NamedTuple):
    """Makes the locator of a function of a package."""

    sources: Sources
    kind: str

    def from_function(self, function: Any, path: str) -> _Locator:
        return _Locator(self.sources, self.kind, function, path)


class _Implementation(caching.CompileResultCacheImpl):
    def __init__(self, function: Any, sources: Sources, kind: str) -> None:
        locators: Any = [_Locators(sources, kind)]  # numba only asks them for ``from_function``
        self._locator_classes = locators
        super().__init__(function)

    def reduce(self, compiled: Any) -> Any:
        return lean.reduced(compiled)

    def rebuild(self, context: Any, payload: Any) -> Any:
        return lean.rebuilt(context, payload)


def share_work(sources: Sources) -> None:
    """From now on, wait for functions that another process compiles which shares the work, too.

    For processes that do nothing but compile: what they have claimed they hold until they end.
    """
    for each in (*sources.below, sources):
        if (place := folder(each)) is not None:
            claims.share(place)


class DamagedCode(Exception):
    """A file is not what was written."""


class _Files(caching.IndexDataCacheFile):
    """Index and code of a function, each of which ends in a hash of what is before it.

    Numba itself would execute machine code of which a bit has changed.
    """

    def _dump(self, thing: Any) -> bytes:
        content: bytes = super()._dump(thing)
        # What is read ends with the object: it takes no notice of what follows.
        return content + _digest(content)

    def _load_data(self, name: str) -> Any:
        content = memoryview(Path(self._data_path(name)).read_bytes())
        if _digest(content[:-_DIGEST]) != content[-_DIGEST:]:
            raise DamagedCode(name)
        return super()._load_data(name)


def _digest(content: bytes | memoryview) -> bytes:
    return hashlib.sha256(content).digest()


class _KernelCache(caching.FunctionCache):
    """Numba's cache of a function that other processes may fill and remove at the same time."""

    def __init__(self, function: Any, sources: Sources, kind: str) -> None:
        implementation: Any = partial(_Implementation, sources=sources, kind=kind)
        self._function, self._sources, self._impl_class = function, sources, implementation
        _hash(function.__code__.co_filename)

    def __getattr__(self, name: str) -> Any:
        """Find out where its files are, as numba's own would at once: of most functions nobody asks."""
        if "_impl" in vars(self):
            raise AttributeError(name)
        super().__init__(self._function)
        locator, base = self._impl.locator, self._impl.filename_base
        self._cache_file = _Files(self._cache_path, base, locator.get_source_stamp())
        return getattr(self, name)

    def load_overload(self, signature: Any, target: Any) -> Any:
        """Return the compiled function; None where it is not there or damaged, as after a loss of power."""
        lean.use(target)
        found = self._load(signature, target)
        if found is None and (shared := claims.shared.get(self.cache_path)) is not None:
            shared.take(self._claim(signature))
            found = self._load(signature, target)
            if found is not None:
                shared.give_back(self._claim(signature))
        return found

    def _claim(self, signature: Any) -> str:
        """Return the key of a compiled function, in every process."""
        return f"{self._impl.filename_base} {signature}"

    def _load(self, signature: Any, target: Any) -> Any:
        """Load it from the folder; what compilation needs is not imported, as numba would do first."""
        try:
            with self._guard_against_spurious_io_errors():
                return self._load_overload(signature, target)
        except Exception:
            with suppress(OSError), locked(Path(self.cache_path)):
                self.flush()
            return None

    def save_overload(self, signature: Any, compiled: Any) -> None:
        """Keep a compiled function, unless sources have changed since this process read the first of them.

        Index and code are two files: without the lock, two processes that compile a function for other
        arguments could give the code of one the index of the other. A full disk costs the copy, no more.
        """
        place = Path(self.cache_path)
        with suppress(OSError, NotPrivate):
            self._impl.locator.ensure_cache_path()
            with locked(place):
                if fingerprint(self._sources) == place.name:
                    self._save(signature, compiled)
        if (shared := claims.shared.get(self.cache_path)) is not None:
            shared.give_back(self._claim(signature))

    def _save(self, signature: Any, compiled: Any) -> None:
        try:
            super().save_overload(signature, compiled)
        except OSError:
            raise
        except Exception:
            # Another process has kept it for types of a package that this one does not have.
            self.flush()
            super().save_overload(signature, compiled)
