"""The library of a package's machine code, made by its build; found where it fits the sources."""

from __future__ import annotations

import ctypes
import hashlib
import json
import os
import platform
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Final

MANIFEST: Final = "manifest.json"
#: Levels of processors for which code is made, the best first, and what the processor must be able to do.
LEVELS: Final = {
    "v3": {"avx2", "bmi1", "bmi2", "f16c", "fma", "abm", "movbe"},
    "baseline": {"cx16", "popcnt", "sse4_1", "sse4_2", "ssse3"},
}
_CPU: Final = Path("/proc/cpuinfo")


class NoMachineCode(ImportError):
    """There is no machine code for this system and none can be made."""


@dataclass(frozen=True)
class Sources:
    """The files of a package that its machine code is made from."""

    package: Path  #: Folder of the package.
    #: Which files, as :meth:`pathlib.Path.glob` takes them, relative to ``package``.
    patterns: tuple[str, ...]
    listing: tuple[str, ...]  #: Packages of which every module is imported to know all entries.
    #: Sources of other packages whose kernels are compiled into those of this one.
    below: tuple[Sources, ...] = ()

    @property
    def folder(self) -> Path:
        """Folder of the library."""
        return self.package / "kernels" / "built"

    def files(self) -> Iterator[tuple[str, Path]]:
        """Yield the name, the same in every copy of the packages, and the place of each file.

        Raises FileNotFoundError if no file matches a pattern, as where the package is no folder.
        """
        for sources in self.below:
            yield from sources.files()
        for pattern in self.patterns:
            found = sorted(self.package.glob(pattern))
            if not found:
                raise FileNotFoundError(str(self.package / pattern))
            yield from (
                (f"{self.package.name}/{path.relative_to(self.package).as_posix()}", path) for path in found
            )


def fingerprint(sources: Sources) -> str:
    """Return the hash of all sources of machine code.

    Raises OSError if a source is missing or cannot be read.
    """
    digest = hashlib.sha256()
    for name, path in sources.files():
        content = path.read_bytes()
        digest.update(f"{name} {len(content)} ".encode() + content)
    return digest.hexdigest()


def system() -> str:
    """Return the name of this operating system and machine."""
    return f"{sys.platform}-{platform.machine()}"


@cache
def level() -> str:
    """Return the level of this processor, or the one that ``TRIBODYN_LEVEL`` names."""
    forced = os.environ.get("TRIBODYN_LEVEL")
    if forced:
        if forced not in LEVELS:
            raise NoMachineCode(f"TRIBODYN_LEVEL is {forced!r}; choose {' or '.join(LEVELS)}")
        return forced
    flags = _flags()
    found = next((name for name, needed in LEVELS.items() if needed <= flags), "baseline")
    if flags and (missing := LEVELS[found] - flags):
        raise NoMachineCode(
            f"this processor lacks {', '.join(sorted(missing))}, which the machine code needs"
        )
    return found


def _flags() -> set[str]:
    """Return the abilities of the processor by the names of the system; none where it names none."""
    try:
        with _CPU.open(encoding="ascii", errors="replace") as lines:
            found = next((line for line in lines if line.startswith("flags")), "")
    except OSError:
        return set()
    return set(found.split())


class Library:
    """A library that was made from the sources as they are.

    Attributes
    ----------
    name
        What results say of it: its level and the beginning of its hash.
    """

    def __init__(self, folder: Path, manifest: dict[str, Any]) -> None:
        chosen = next((name for name in (level(), "baseline") if name in manifest["levels"]), None)
        if chosen is None:
            raise NoMachineCode(f"{folder} holds no code for processors without AVX2; {REMEDY}")
        path = folder / f"{chosen}.so"
        try:
            found = hashlib.sha256(path.read_bytes()).hexdigest()
        except OSError:
            raise NoMachineCode(f"{path}, which {MANIFEST} names, is missing; {REMEDY}") from None
        if found != manifest["levels"][chosen]:
            raise NoMachineCode(f"{path} does not belong to the {MANIFEST} beside it; {REMEDY}")
        self.name = f"{chosen} {found[:16]}"
        self._functions: dict[str, tuple[int, str, str]] = manifest["functions"]
        self._code = ctypes.CDLL(str(path))

    def find(self, name: str, layout: str, suffix: str = "") -> tuple[int, str] | None:
        """Return address and kind of result of a function, if it is there for arguments of a layout."""
        number, known, result = self._functions.get(name, (0, "", ""))
        if known != layout:
            return None
        address = ctypes.cast(getattr(self._code, f"k{number}{suffix}"), ctypes.c_void_p).value
        return address or 0, result


REMEDY: Final = "install the package again, or `make kernels` in a checkout"


@cache
def library(sources: Sources) -> Library | None:
    """Return the library of a package; None where there is none, or where sources were changed since.

    Raises NoMachineCode if what is there is damaged, or made for another system.
    """
    try:
        manifest = json.loads((sources.folder / MANIFEST).read_bytes())
        if manifest["sources"] != fingerprint(sources):
            return None
    except FileNotFoundError:
        return None
    except (OSError, ValueError, KeyError):
        raise NoMachineCode(f"{sources.folder / MANIFEST} cannot be read; {REMEDY}") from None
    if manifest["system"] != system():
        raise NoMachineCode(f"the machine code is for {manifest['system']}, this is {system()}; {REMEDY}")
    return Library(sources.folder, manifest)
