"""The list of the mechanisms, and their cases: by built-in name, from a TOML file, from TOML text.

Mechanisms of this package are folders; packages above it, and other installed packages, register theirs by
entry points.
"""

from __future__ import annotations

import importlib
import os
import warnings
from collections.abc import Collection, Iterator, Mapping
from importlib.metadata import entry_points
from pathlib import Path
from types import MappingProxyType
from typing import Final, Protocol, TypeAlias, cast

from tribodyn.cases import load
from tribodyn.cases.case import Case
from tribodyn.cases.entry import Entry
from tribodyn.cases.load import BuiltIn
from tribodyn.core import toml
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given, brief, meant
from tribodyn.mechanisms.base import MechanismDescriptor

FOLDERS: Final = (
    "general",
    "journal",
)
"""Mechanisms by their folders beside this file, whose ``descriptor.py`` holds their ``MECHANISM``."""
_GROUP: Final = "tribodyn.mechanisms"


def _described(folder: str) -> MechanismDescriptor:
    return cast(
        MechanismDescriptor, importlib.import_module(f"tribodyn.mechanisms.{folder}.descriptor").MECHANISM
    )


def _registered(taken: Collection[str]) -> Iterator[MechanismDescriptor]:
    """Yield the mechanisms under the entry points ``tribodyn.mechanisms``.

    One that cannot be imported, is no mechanism or takes the name of another is left out with a warning: it
    must not keep a user from the others.
    """
    kinds = set(taken)
    for entry in entry_points(group=_GROUP):
        try:
            mechanism = entry.load()
            if not isinstance(mechanism, MechanismDescriptor):
                raise TypeError("it is no MechanismDescriptor")
            if mechanism.kind in kinds:
                raise ValueError(f"there is a mechanism {mechanism.kind!r} already")
        except Exception as error:
            warnings.warn(f"the mechanism {entry.value} was left out: {error}", stacklevel=2)
            continue
        kinds.add(mechanism.kind)
        yield mechanism


def _all() -> Iterator[MechanismDescriptor]:
    ours = [_described(folder) for folder in FOLDERS]
    yield from _registered([mechanism.kind for mechanism in ours])
    yield from ours


MECHANISMS: Final[dict[str, MechanismDescriptor]] = {mechanism.kind: mechanism for mechanism in _all()}
"""Every mechanism, by the kind of its cases: those registered by entry points, and our own."""


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


def templates() -> dict[str, str]:
    """Return the titles of the case files that ``tribodyn new`` writes, by name."""
    own = {name: text for mechanism in MECHANISMS.values() for name, text in mechanism.templates.items()}
    titles = {name: str(toml.parse(text)["title"]) for name, text in own.items()}
    return {**titles, **{name: case.summary for name, case in built_in().items() if name not in own}}


def template(name: str) -> str:
    """Return the text of a case file that ``tribodyn new`` writes.

    Raises
    ------
    InputError
        There is no such template.
    """
    for mechanism in MECHANISMS.values():
        if name in mechanism.templates:
            return mechanism.templates[name]
    if name in built_in():
        return load_case(name).to_toml(comments=True)
    known = templates()
    words = f"{as_given(name)}; allowed: {', '.join(known)}{meant(name, known)}"
    raise InputError(words, key="TEMPLATE")


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
