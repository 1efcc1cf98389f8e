"""Reading cases: by built-in name, from a TOML file, from TOML text."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tribodyn.cases.case import Case, build
from tribodyn.cases.entry import Entry, closest
from tribodyn.cases.keys import shown
from tribodyn.core import toml
from tribodyn.core.errors import InputError
from tribodyn.core.files import read_regular
from tribodyn.core.quoting import LONGEST, brief


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
    """

    model: type[Case]
    summary: str
    given: Mapping[str, object] = field(default_factory=dict)


Kinds = Mapping[str, type[Case]]
"""Case models by what stands under ``case =`` in a file."""


def read_case(case: str | os.PathLike[str], kinds: Kinds, built_in: Mapping[str, BuiltIn]) -> Case:
    """Return a case by built-in name or from a TOML file.

    Parameters
    ----------
    case
        One of ``built_in``, or the path of a file.
    kinds
        What a file may hold.
    built_in
        What can be had by name.

    Raises
    ------
    InputError
        There is no such case or file, or something in the file is wrong.
    """
    if isinstance(case, str) and case in built_in:
        entry = built_in[case]
        source = f"built-in case {case}"
        given = {path: Entry(value, source) for path, value in entry.given.items()}
        return build(entry.model, given, source)
    name = os.fspath(case)
    return parse(_text(name, built_in), name, kinds, Path(name).parent)


def parse(text: str, source: str, kinds: Kinds, folder: Path | None = None) -> Case:
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
    """
    entries = {path: Entry(value, source, folder=folder) for path, value in flat(_tables(text, source))}
    if not entries:
        raise InputError(
            f"the file is empty; `tribodyn show {next(iter(kinds))}` prints a complete one", source=source
        )
    return build(_kind(entries, kinds, source), entries, source)


def _kind(entries: Mapping[str, Entry], kinds: Kinds, source: str) -> type[Case]:
    """Return the kind of case that the key ``case`` names."""
    allowed = ", ".join(kinds)
    if "case" not in entries:
        raise InputError(
            f'this key is missing; write case = "{next(iter(kinds))}" at the top; known: {allowed}',
            key="case",
            source=source,
        )
    name = entries["case"].value
    if not isinstance(name, str) or name not in kinds:
        near = closest(str(name), kinds)
        hint = f'; did you mean "{near}"?' if near else ""
        raise InputError(f"given {shown(name)}; allowed: {allowed}{hint}", key="case", source=source)
    return kinds[name]


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
        raise InputError(f"not valid TOML: {brief(error, 2 * LONGEST)}", source=source) from None


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
