"""Reading cases: by built-in name, from a TOML file, from TOML text."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import islice
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

from tribodyn.cases.case import Case, beside, build
from tribodyn.cases.entry import Entry
from tribodyn.cases.keys import shown
from tribodyn.core import toml
from tribodyn.core.errors import MOST_FAULTS, InputError, together
from tribodyn.core.files import read_regular
from tribodyn.core.quoting import LONGEST, brief, closest, meant


@dataclass(frozen=True)
class BuiltIn:
    """A case that can be run by name.

    Attributes
    ----------
    model
        Its kind.
    summary
        One line for ``tribodyn cases``.
    given
        What differs from the defaults of the kind, by dotted path.
    origins
        Where these values come from, by dotted path, for those whose key does not say it.
    """

    model: type[Case]
    summary: str
    given: Mapping[str, object] = field(default_factory=dict)
    origins: Mapping[str, str] = field(default_factory=dict)


_FILE: Final = ".toml"
"""Ending of the name of a case file."""
_MOST_BASES: Final = 8
_LONGEST_LINE: Final = 200
_BARE: Final = re.compile(
    r"\s*([A-Za-z0-9_.-]+)\s*=\s*"
    r"([+-]?[0-9.]+(?:[eE][+-]?[0-9]+)?\s*[A-Za-zµμ°%][^\s\"'#=]*(?: [^\s\"'#=]+)*"
    r"|[+-]?[0-9]+,[0-9]+"
    r"|(?!(?:true|false|inf|nan)\b)[A-Za-z][A-Za-z0-9_./-]*)\s*(?:#.*)?",
    re.ASCII,
)
"""A line whose value is a quantity without quotes, a number with a decimal comma, or a word."""
_OPEN: Final = re.compile(r"\s*[A-Za-z0-9_.-]+\s*=\s*\"[^\"]+")

Kinds = Mapping[str, type[Case]]
"""Case models by what stands under ``case =`` in a file."""


def read_case(
    case: str | os.PathLike[str],
    kinds: Kinds,
    built_in: Mapping[str, BuiltIn],
    changes: Mapping[str, Entry] = MappingProxyType({}),
) -> Case:
    """Return a case by built-in name or from a TOML file.

    Parameters
    ----------
    case
        One of ``built_in``, or the path of a file.
    kinds
        What a file may hold.
    built_in
        What can be had by name.
    changes
        What takes the place of what the file says, before that is checked.

    Raises
    ------
    InputError
        There is no such case or file, or something in the file is wrong.
    """
    if isinstance(case, str) and not case.endswith(_FILE) and case in built_in:
        model, given = built_in[case].model, _given(case, built_in[case])
        return build(model, _changed(model, given, changes), f"built-in case {case}")
    name = os.fspath(case)
    model, given = _of_file(name, Known(kinds, built_in))
    return build(model, _changed(model, given, changes), name)


def parse(
    text: str,
    source: str,
    kinds: Kinds,
    folder: Path | None = None,
    built_in: Mapping[str, BuiltIn] = MappingProxyType({}),
    changes: Mapping[str, Entry] = MappingProxyType({}),
) -> Case:
    """Return the case that a TOML text describes.

    Parameters
    ----------
    text
        Content of a case file.
    source
        Where it comes from, for messages.
    kinds
        What the text may hold.
    folder
        Where the names of files in it begin; None is the current directory.
    built_in
        Cases that it may begin with, by name.
    changes
        As for :func:`read_case`.
    """
    model, given = _of_text(text, source, folder, Known(kinds, built_in))
    return build(model, _changed(model, given, changes), source)


@dataclass(frozen=True)
class Known:
    """Allowed values of the key ``case`` of a file.

    Attributes
    ----------
    kinds
        Kinds of cases.
    built_in
        Cases by name.
    files
        Files that began with one another, the first one first; empty where no file may be named, because the
        text comes from elsewhere.
    """

    kinds: Kinds
    built_in: Mapping[str, BuiltIn]
    files: tuple[str, ...] = ()

    @property
    def names(self) -> list[str]:
        """Allowed values of the key, files aside."""
        return list(dict.fromkeys([*self.kinds, *self.built_in]))


def _of_file(name: str, known: Known) -> tuple[type[Case], dict[str, Entry]]:
    """Return the kind of case and the entries of a file, and of those that it begins with."""
    known = replace(known, files=(*known.files, name))
    return _of_text(_text(name, known.built_in), name, Path(name).parent, known)


def _of_text(
    text: str, source: str, folder: Path | None, known: Known
) -> tuple[type[Case], dict[str, Entry]]:
    """Return the kind of case and the entries of a text, and of what it begins with."""
    entries = {path: Entry(value, source, folder=folder) for path, value in flat(_tables(text, source))}
    if not entries:
        raise InputError(
            f"the file is empty; `tribodyn show {next(iter(known.kinds))}` prints a complete one",
            source=source,
        )
    model, given = _begun(entries, known, source)
    del entries["case"]
    return model, beside(model, given, entries)


def _changed(model: type[Case], entries: dict[str, Entry], changes: Mapping[str, Entry]) -> dict[str, Entry]:
    return beside(model, entries, changes) if changes else entries


def _begun(entries: Mapping[str, Entry], known: Known, source: str) -> tuple[type[Case], dict[str, Entry]]:
    """Return the kind of case that the key ``case`` names, and what a built-in case or a file gives."""
    if "case" not in entries:
        first = _likeliest(entries, known.kinds)
        words = f'this key is missing; write case = "{first}" at the top; known: {", ".join(known.names)}'
        raise InputError(words, key="case", source=source)
    name = entries["case"].value
    if isinstance(name, str) and name.endswith(_FILE) and known.files:
        return _base(name, entries["case"], known)
    if isinstance(name, str) and name in known.kinds:
        return known.kinds[name], {"case": entries["case"]}
    if isinstance(name, str) and name in known.built_in:
        return known.built_in[name].model, _given(name, known.built_in[name])
    files = ", or another case file" if known.files else ""
    allowed = f"{', '.join(known.names)}{files}{meant(str(name), known.names)}"
    raise InputError(f"given {shown(name)}; allowed: {allowed}", key="case", source=source)


def _likeliest(paths: Iterable[str], kinds: Kinds) -> str:
    """Return the kind of case that has most of the tables and keys at the top of a file."""
    given = {path.partition(".")[0] for path in paths}
    return max(kinds, key=lambda kind: len(given & kinds[kind].model_fields.keys()))


def _base(name: str, entry: Entry, known: Known) -> tuple[type[Case], dict[str, Entry]]:
    """Return the values of the case file that another one begins with."""
    path = os.fspath((entry.folder or Path()) / name)
    if path in known.files:
        raise InputError(
            f"given {shown(name)}: this file begins with itself", key="case", source=entry.source
        )
    if len(known.files) > _MOST_BASES:
        words = f"given {shown(name)}: more than {_MOST_BASES} files begin with one another"
        raise InputError(words, key="case", source=entry.source)
    return _of_file(path, known)


def _given(name: str, case: BuiltIn) -> dict[str, Entry]:
    """Return the values of a built-in case."""
    values = {"case": case.model.kind(), **case.given}
    return {
        path: Entry(value, f"built-in case {name}", built_in=True, origin=case.origins.get(path, ""))
        for path, value in values.items()
    }


def _text(name: str, built_in: Mapping[str, BuiltIn]) -> str:
    """Read a file as UTF-8 text."""
    try:
        return _decoded(read_regular(Path(name), toml.LARGEST), name)
    except FileNotFoundError:
        raise InputError(_no_such_file(name, built_in), source=name) from None
    except IsADirectoryError:
        reason = "this is a directory; a TOML file or a built-in case is needed"
        raise InputError(reason, source=name) from None
    except OSError as error:
        raise InputError(f"the file cannot be read: {error.strerror}", source=name) from None


def _decoded(content: bytes, source: str) -> str:
    """Return the text of a file, refusing what cannot be TOML."""
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"the file is not UTF-8 text (byte {error.start})", source=source) from None
    if "\0" in text:
        raise InputError("this is a binary file, not TOML text", source=source)
    return text


def _no_such_file(name: str, built_in: Mapping[str, BuiltIn]) -> str:
    near = closest(name, built_in)
    hint = f"; did you mean {near}?" if near else ""
    return f"there is no such file, and no built-in case of this name (built in: {', '.join(built_in)}){hint}"


def _tables(text: str, source: str) -> dict[str, Any]:
    try:
        return toml.parse(text)
    except ValueError as error:
        reasons = list(islice(_hints(text), MOST_FAULTS)) or [brief(error, 2 * LONGEST)]
        raise together([InputError(f"not valid TOML: {why}", source=source) for why in reasons]) from None


def _hints(text: str) -> Iterator[str]:
    """Say of a text that is no TOML which of its lines lack quotes or a decimal point."""
    for number, line in enumerate(text.splitlines(), 1):
        match = _BARE.fullmatch(line[:_LONGEST_LINE])
        if match is not None:
            yield f"line {number}: {_with_quotes(*match.groups())}"
        elif _OPEN.fullmatch(line[:_LONGEST_LINE]):
            yield f'line {number}: this text does not end; a second " is missing'


def _with_quotes(key: str, value: str) -> str:
    """Suggest the right spelling of a value that lacks its quotes or its decimal point."""
    if re.fullmatch(r"[+-]?\d+,\d+", value):
        return f"decimals stand behind a point: {key} = {value.replace(',', '.')}"
    kind = "a quantity" if value[0] in "+-.0123456789" else "a name"
    return f'{kind} is text: {key} = "{value}"'


def flat(tables: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, object]]:
    """Walk nested tables as (dotted path, value)."""
    for name, value in tables.items():
        path = prefix + _key_text(name)
        if isinstance(value, dict) and value:
            yield from flat(value, f"{path}.")
        else:
            yield path, value


def _key_text(name: str) -> str:
    """Return a key as it stands in a file; quoted unless plain, so that dots inside do not mislead."""
    return name if re.fullmatch("[A-Za-z0-9_-]+", name) else shown(name)
