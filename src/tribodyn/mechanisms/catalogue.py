"""The list of the mechanisms, and their cases: by built-in name, from a TOML file, from TOML text.

Mechanisms of this package are folders; packages above it, and other installed packages, register theirs by
entry points.
"""

import importlib
import os
import warnings
from collections.abc import Iterator, Mapping
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from itertools import chain
from pathlib import Path
from types import MappingProxyType
from typing import Final, Protocol, TypeAlias, cast

from tribodyn.cases import load
from tribodyn.cases.case import Case
from tribodyn.cases.fields import Entry
from tribodyn.cases.load import BuiltIn
from tribodyn.core import files
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given, brief, meant
from tribodyn.mechanisms.mechanism_protocol import MechanismDescriptor

#: Packages whose ``descriptor.py`` holds their ``MECHANISM``, by the kind of its cases.
FOLDERS: Final = {"mechanism": "tribodyn.mechanism"}
_GROUP: Final = "tribodyn.mechanisms"


@cache
def _described(kind: str) -> MechanismDescriptor:
    """Return a mechanism of this package."""
    descriptor = importlib.import_module(f"{FOLDERS[kind]}.descriptor")
    return cast(MechanismDescriptor, descriptor.MECHANISM)


@cache
def _entries() -> tuple[EntryPoint, ...]:
    """Return the entry points ``tribodyn.mechanisms``."""
    return tuple(entry_points(group=_GROUP))


@cache
def _registered(entry: EntryPoint) -> MechanismDescriptor | None:
    """Return the mechanism of an entry point; None, with a warning, where it is not usable.

    One that cannot be imported, is no mechanism or takes the name of another must not keep a user from the
    others.
    """
    try:
        mechanism = entry.load()
        if not isinstance(mechanism, MechanismDescriptor):
            raise TypeError("it is no MechanismDescriptor")
        before = (_registered(other) for other in _entries()[: _entries().index(entry)])
        if mechanism.kind in FOLDERS or mechanism.kind in {other.kind for other in before if other}:
            raise ValueError(f"there is a mechanism {mechanism.kind!r} already")
    except Exception as error:
        warnings.warn(f"the mechanism {entry.value} was left out: {error}", stacklevel=2)
        return None
    return mechanism


class _Mechanisms(Mapping[str, MechanismDescriptor]):
    """Every mechanism by the kind of its cases; one is imported when it is first used.

    Those registered by entry points come first. The name of an entry point need not be the kind: then all
    entry points are loaded to find it.
    """

    def __getitem__(self, kind: str) -> MechanismDescriptor:
        if kind in FOLDERS:
            return _described(kind)
        for entry in sorted(_entries(), key=lambda entry: entry.name != kind):
            mechanism = _registered(entry)
            if mechanism is not None and mechanism.kind == kind:
                return mechanism
        raise KeyError(kind)

    def __iter__(self) -> Iterator[str]:
        for mechanism in map(_registered, _entries()):
            if mechanism is not None:
                yield mechanism.kind
        yield from FOLDERS

    def __len__(self) -> int:
        return sum(1 for _ in self)


class _Kinds(Mapping[str, "type[Case]"]):
    """Case models by their kinds, see :func:`kinds`."""

    def __getitem__(self, kind: str) -> type[Case]:
        return MECHANISMS[kind].case

    def __iter__(self) -> Iterator[str]:
        return iter(MECHANISMS)

    def __len__(self) -> int:
        return len(MECHANISMS)


class _BuiltIn(Mapping[str, BuiltIn]):
    """Built-in cases by name, see :func:`built_in`; the mechanisms after that of a case are not imported."""

    def __getitem__(self, name: str) -> BuiltIn:
        for mechanism in MECHANISMS.values():
            if name in mechanism.built_in:
                return mechanism.built_in[name]
        raise KeyError(name)

    def __iter__(self) -> Iterator[str]:
        return chain.from_iterable(mechanism.built_in for mechanism in MECHANISMS.values())

    def __len__(self) -> int:
        return sum(len(mechanism.built_in) for mechanism in MECHANISMS.values())


#: Every mechanism, by the kind of its cases: those registered by entry points, and our own.
MECHANISMS: Final[Mapping[str, MechanismDescriptor]] = _Mechanisms()


def kinds() -> Mapping[str, type[Case]]:
    """Return the allowed values of ``case =`` in a file."""
    return _Kinds()


def built_in() -> Mapping[str, BuiltIn]:
    """Return the cases that can be run by name."""
    return _BuiltIn()


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

    Returns
    -------
    Case
        Checked; its values are in SI units.

    Raises
    ------
    InputError
        There is no such case or file, or something in it is wrong.

    Examples
    --------
    >>> import tribodyn as td
    >>> case = td.load_case("slider-crank", {"joints.wrist.clearance.radial": "30 um"})
    >>> case.joints["wrist"].clearance.radial
    3e-05
    """
    try:
        found = load.read_case(case, kinds(), built_in())
    except InputError:
        _refuse_template(case)
        if not changes:
            raise
        given = {path: Entry(value, source, text=True) for path, value in changes.items()}
        found = load.read_case(case, kinds(), built_in(), given)
    return found.replace(changes, source=source) if changes else found


def _refuse_template(case: str | os.PathLike[str]) -> None:
    """Refuse the name of a template in the place of a case."""
    if any(case in mechanism.templates for mechanism in MECHANISMS.values()):
        words = f"this is a template; write its case file with `tribodyn new {case}`, then run {case}.toml"
        raise InputError(words, source=os.fspath(case))


def templates() -> dict[str, str]:
    """Return the titles of the case files that ``tribodyn new`` writes, by name."""
    own = {name: text for mechanism in MECHANISMS.values() for name, text in mechanism.templates.items()}
    titles = {name: str(files.parse(text)["title"]) for name, text in own.items()}
    return {**titles, **{name: case.summary for name, case in built_in().items() if name not in own}}


def template(name: str) -> str:
    """Return the text of a case file that ``tribodyn new`` writes.

    Raises InputError if there is no such template.
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
    """Description of a case, such as :class:`tribodyn.Mechanism`."""

    def case(self) -> Case:
        """Return the case."""


#: A case, what describes one, the name of a built-in one, or the path of a file.
AnyCase: TypeAlias = Case | Described | str | os.PathLike[str]


def case_of(given: AnyCase) -> Case:
    """Return the case that a user gave or named.

    Raises InputError if there is no such case or file, something in it is wrong, or this is no case at all.
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

    ``text``: content of a case file; ``source``: where it comes from, for messages; ``folder``: where the
    names of files in it begin; None is the current directory.
    """
    return load.parse(text, source, kinds(), folder, built_in())
