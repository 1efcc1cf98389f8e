"""The list of the mechanisms, and their cases: by built-in name, from a TOML file, from TOML text."""

from __future__ import annotations

import importlib
import os
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Final, Protocol, TypeAlias, cast

from tribodyn.cases import load
from tribodyn.cases.case import Case
from tribodyn.cases.entry import Entry
from tribodyn.cases.load import BuiltIn
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import brief
from tribodyn.mechanisms.base import MechanismDescriptor

FOLDERS: Final = (
    "vsv",
    "general",
    "journal",
)
"""Every mechanism by its folder beside this file, whose ``descriptor.py`` holds its ``MECHANISM``."""


def _described(folder: str) -> MechanismDescriptor:
    return cast(
        MechanismDescriptor, importlib.import_module(f"tribodyn.mechanisms.{folder}.descriptor").MECHANISM
    )


MECHANISMS: Final[dict[str, MechanismDescriptor]] = {
    mechanism.kind: mechanism for mechanism in map(_described, FOLDERS)
}
"""Every mechanism, by the kind of its cases."""


def kinds() -> dict[str, type[Case]]:
    """Return what may stand under ``case =`` in a file."""
    return {kind: mechanism.case for kind, mechanism in MECHANISMS.items()}


def built_in() -> dict[str, BuiltIn]:
    """Return the cases that can be run by name."""
    return {name: case for mechanism in MECHANISMS.values() for name, case in mechanism.built_in.items()}


def load_case(
    case: str | os.PathLike[str],
    changes: Mapping[str, object] = MappingProxyType({}),
    *,
    source: str = "changes",
) -> Case:
    """Return a case by built-in name or from a TOML file.

    Parameters
    ----------
    case
        A built-in name, as ``tribodyn cases`` lists them, or the path of a file.
    changes
        Values by dotted path that take the place of those in the file, as for :meth:`Case.replace`. They may
        give what the file lacks.
    source
        Where the changes come from, for messages.

    Raises
    ------
    InputError
        There is no such case or file, or something in it is wrong.
    """
    try:
        found = load.read_case(case, kinds(), built_in())
    except InputError:
        if not changes:
            raise
        given = {path: Entry(value, source, text=True) for path, value in changes.items()}
        found = load.read_case(case, kinds(), built_in(), given)
    return found.replace(changes, source=source) if changes else found


class Described(Protocol):
    """What describes a case, as :class:`tribodyn.Mechanism` does."""

    def case(self) -> Case:
        """Return the case."""


AnyCase: TypeAlias = Case | Described | str | os.PathLike[str]
"""A case, what describes one, the name of a built-in one, or the path of a file."""


def case_of(given: AnyCase) -> Case:
    """Return the case that a user gave or named.

    Raises
    ------
    InputError
        There is no such case or file, something in it is wrong, or this is no case at all.
    """
    if isinstance(given, Case):
        return given
    if isinstance(given, (str, os.PathLike)):
        return load_case(given)
    described = getattr(given, "case", None)
    if not callable(described):
        words = "a case, a Mechanism, the name of a built-in case, or the path of a case file"
        raise InputError(f"given {brief(repr(given))}; allowed: {words}", key="case")
    return case_of(described())


def parse_case(text: str, source: str, folder: Path | None = None) -> Case:
    """Return the case that a TOML text describes.

    Parameters
    ----------
    text
        Content of a case file.
    source
        Where it comes from, for messages.
    folder
        Where the names of files in it begin; None is the current directory.
    """
    return load.parse(text, source, kinds(), folder, built_in())
