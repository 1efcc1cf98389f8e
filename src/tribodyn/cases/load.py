"""Reading cases: by built-in name, from a TOML file, from TOML text."""

import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path, PureWindowsPath
from types import MappingProxyType
from typing import Any, Final

from tribodyn.cases.case import Case, beside, build
from tribodyn.cases.fields import Entry
from tribodyn.cases.keys import shown
from tribodyn.cases.tables import is_name
from tribodyn.core import files
from tribodyn.core.errors import MOST_FAULTS, InputError, together
from tribodyn.core.files import read_regular, text_of
from tribodyn.core.quoting import LONGEST, brief, closest, meant


@dataclass(frozen=True)
class BuiltIn:
    """A case that can be run by name."""

    model: type[Case]  #: Its kind.
    summary: str  #: One line for ``tribodyn cases``.
    #: What differs from the defaults of the kind, by dotted path.
    given: Mapping[str, object] = field(default_factory=dict)
    #: Where these values come from, by dotted path, for those whose key does not say it.
    origins: Mapping[str, str] = field(default_factory=dict)


#: Kinds of cases of earlier versions, and what took their places.
_GONE: Final = {
    "journal": "a journal is a mechanism now: `tribodyn new journal-oil` writes one. Of its keys "
    "joint.clearance is joints.bearing.clearance.radial, film.viscosity joints.bearing.film.viscosity, "
    "loads.force_x loads.x.force, journal.speed drives.motor.speed"
}
_FILE: Final = ".toml"  #: Ending of the name of a case file.
_MOST_BASES: Final = 8
_LONGEST_LINE: Final = 200
#: A line whose value is a quantity without quotes, a number with a decimal comma, or a word.
_BARE: Final = re.compile(
    r"\s*([A-Za-z0-9_.-]+)\s*=\s*"
    r"([+-]?[0-9.]+(?:[eE][+-]?[0-9]+)?\s*[A-Za-zµμ°%][^\s\"'#=]*(?: [^\s\"'#=]+)*"
    r"|[+-]?[0-9]+,[0-9]+"
    r"|(?!(?:true|false|inf|nan)\b)[A-Za-z][A-Za-z0-9_./-]*)\s*(?:#.*)?",
    re.ASCII,
)
#: A backslash in double quotes that begins no sign of TOML, or one by its number, as paths seem to.
_BACKSLASH: Final = re.compile(r"\"[^\"]*\\(?![btnfr\"\\])")
_OPEN: Final = re.compile(r"\s*[A-Za-z0-9_.-]+\s*=\s*\"[^\"]+")
_TABLE: Final = re.compile(r"\s*\[\s*([A-Za-z0-9_.\"' -]+?)\s*\]\s*(?:#|$)")
_KEY: Final = re.compile(r"\s*([A-Za-z0-9_.\"' -]+?)\s*=")
_PLACE: Final = re.compile(r"\(at line ([0-9]+), column [0-9]+\)$")
#: Beginnings of what the parser says of a key or table that stands twice.
_TWICE: Final = ("Cannot overwrite", "Cannot declare", "Cannot mutate")

Kinds = Mapping[str, type[Case]]  #: Case models by what stands under ``case =`` in a file.


def read_case(
    case: str | os.PathLike[str],
    kinds: Kinds,
    built_in: Mapping[str, BuiltIn],
    changes: Mapping[str, Entry] = MappingProxyType({}),
) -> Case:
    """Return a case by built-in name or from a TOML file.

    ``case``: one of ``built_in``, or the path of a file; ``kinds``: what a file may hold; ``built_in``: what
    can be had by name; ``changes``: what takes the place of what the file says, before that is checked.
    Raises InputError if there is no such case or file, or something in the file is wrong.
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

    ``text``: content of a case file; ``source``: where it comes from, for messages; ``kinds``: what the text
    may hold; ``folder``: where the names of files in it begin; None is the current directory; ``built_in``:
    cases that it may begin with, by name; ``changes``: as for :func:`read_case`.
    """
    model, given = _of_text(text, source, folder, Known(kinds, built_in))
    return build(model, _changed(model, given, changes), source)


@dataclass(frozen=True)
class Known:
    """Allowed values of the key ``case`` of a file."""

    kinds: Kinds  #: Kinds of cases.
    built_in: Mapping[str, BuiltIn]  #: Cases by name.
    #: Files that began with one another, the first one first; empty where no file may be named, because the
    #: text comes from elsewhere.
    begun_from: tuple[str, ...] = ()

    @property
    def names(self) -> list[str]:
        """Allowed values of the key, files aside."""
        return list(dict.fromkeys([*self.kinds, *self.built_in]))


def _of_file(name: str, known: Known) -> tuple[type[Case], dict[str, Entry]]:
    """Return the kind of case and the entries of a file, and of those that it begins with."""
    known = replace(known, begun_from=(*known.begun_from, name))
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
    if isinstance(name, str) and name.endswith(_FILE) and known.begun_from:
        return _base(name, entries["case"], known)
    if isinstance(name, str) and name in known.kinds:
        return known.kinds[name], {"case": entries["case"]}
    if isinstance(name, str) and name in known.built_in:
        return known.built_in[name].model, _given(name, known.built_in[name])
    if str(name) in _GONE:
        raise InputError(_GONE[str(name)], key="case", source=source)
    or_file = ", or another case file" if known.begun_from else ""
    allowed = f"{', '.join(known.names)}{or_file}{meant(str(name), known.names)}"
    raise InputError(f"given {shown(name)}; allowed: {allowed}", key="case", source=source)


def _likeliest(paths: Iterable[str], kinds: Kinds) -> str:
    """Return the kind of case that has most of the tables and keys at the top of a file."""
    given = {path.partition(".")[0] for path in paths}
    return max(kinds, key=lambda kind: len(given & kinds[kind].model_fields.keys()))


def _base(name: str, entry: Entry, known: Known) -> tuple[type[Case], dict[str, Entry]]:
    """Return the values of the case file that another one begins with."""
    path = os.fspath((entry.folder or Path()) / name)
    if path in known.begun_from:
        raise InputError(
            f"given {shown(name)}: this file begins with itself", key="case", source=entry.source
        )
    if len(known.begun_from) > _MOST_BASES:
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
        return _decoded(read_regular(Path(name), files.LARGEST), name)
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
        text = text_of(content)
    except ValueError as error:
        raise InputError(_other_program(source) or str(error), source=source) from None
    if "\0" in text:
        words = _other_program(source) or "this is a binary file, not TOML text"
        raise InputError(words, source=source)
    return text


#: Kinds of files of other programs, by the endings of their names.
_PROGRAMS: Final = {
    "a robot description (URDF)": ".urdf .xacro",
    "a MuJoCo model (MJCF)": ".mjcf",
    "a Gazebo model (SDF)": ".sdf .world",
    "a CAD file": ".step .stp .iges .igs .x_t .sldprt .sldasm .catpart .ipt .dxf",
    "a surface mesh": ".stl .obj .ply",
    "a model of Adams": ".adm .cmd .bin",
    "a Simulink model": ".slx .mdl",
    "a Modelica model": ".mo",
    "a functional mock-up unit": ".fmu",
    "a Python program": ".py .ipynb",
    "a Matlab program": ".m .mat",
    "a table of numbers": ".csv .xlsx .dat",
    "a result of tribodyn or another NetCDF file": ".nc .h5",
    "a JSON or YAML file": ".json .yaml .yml",
}
#: Kinds of XML files by their first element.
_ROOTS: Final = {
    "robot": "a robot description (URDF)",
    "mujoco": "a MuJoCo model (MJCF)",
    "sdf": "a Gazebo model (SDF)",
}


_LONGEST_PROLOGUE: Final = 2000
#: The first element of an XML file, behind declarations and comments.
_XML: Final = re.compile(r"\s*<(?>[?!][^>]*>[^<>]*<)*\s*([A-Za-z]\w*)?")


def _other_program(source: str, text: str = "") -> str:
    """Return the message on a file of another program; empty where it may be meant as a case file."""
    ending = os.path.splitext(source)[1].lower()
    kind = next((kind for kind, endings in _PROGRAMS.items() if ending in endings.split()), "")
    if not kind and (root := _XML.match(text[:_LONGEST_PROLOGUE])):
        kind = _ROOTS.get(root[1] or "", "an XML file")
    words = "tribodyn reads case files in TOML: `tribodyn new` lists templates and writes one to begin with"
    return f"this is {kind}; {words}" if kind else ""


def _reasons(text: str, error: ValueError) -> Iterator[str]:
    """Yield the reasons why a text is no TOML: of the line where the parser stops, and of further ones.

    Only these lines are looked at: others may look alike and be sound, as in a text of several lines.
    """
    lines, reported = text.splitlines(), False
    for _ in range(MOST_FAULTS):
        said = str(error)
        found = _PLACE.search(said)
        number = min(int(found[1]), len(lines)) if found else 0
        twice = _defined_twice(lines[:number]) if said.startswith(_TWICE) else ""
        hint = _hint(lines[number - 1]) if number else ""
        if twice or hint:
            yield twice or f"line {number}: {hint}"
        elif not reported:
            yield files.in_braces(said) or brief(said, 2 * LONGEST)
        if not hint:
            return
        reported, lines[number - 1] = True, ""
        try:
            files.parse("\n".join(lines))
        except ValueError as further:
            error = further
        else:
            return


def _no_such_file(name: str, built_in: Mapping[str, BuiltIn]) -> str:
    stem = PureWindowsPath(name).stem
    folder = Path(name).parent
    beside_it = [str(folder / file.name) for file in folder.glob("*.toml")] if folder.is_dir() else []
    own = next((file for file in beside_it if Path(file).stem == stem), None) or closest(
        name, beside_it, cutoff=0.7
    )
    near = own or (stem if stem in built_in else closest(name, built_in))
    hint = f"; did you mean {near}?" if near else ""
    return f"there is no such file, and no built-in case of this name (built in: {', '.join(built_in)}){hint}"


def _tables(text: str, source: str) -> dict[str, Any]:
    try:
        return files.parse(text)
    except ValueError as error:
        if other := _other_program(source, text):
            raise InputError(other, source=source) from None
        reasons = [*_reasons(text, error)]
        raise together([InputError(f"not valid TOML: {why}", source=source) for why in reasons]) from None


def _hint(line: str) -> str:
    """Return the missing part of a line that is no TOML, quotes or a decimal point; empty otherwise."""
    match = _BARE.fullmatch(line[:_LONGEST_LINE])
    if match is not None:
        return _with_quotes(*match.groups())
    if _BACKSLASH.search(line[:_LONGEST_LINE]):
        return "in double quotes a backslash begins a special sign; write /, or single quotes around the text"
    return 'this text does not end; a second " is missing' if _OPEN.fullmatch(line[:_LONGEST_LINE]) else ""


def _defined_twice(lines: Sequence[str]) -> str:
    """Return that the last key or table of some lines stands before, too, with both places; empty if not."""
    table, places = "", []
    for number, line in enumerate(lines, 1):
        if found := _TABLE.match(line[:_LONGEST_LINE]):
            table = "".join(found[1].split())
            places.append((f"[{table}]", number))
        elif found := _KEY.match(line[:_LONGEST_LINE]):
            places.append((".".join(filter(None, (table, "".join(found[1].split())))), number))
    if not places:
        return ""
    name, last = places[-1]
    first = next(number for other, number in places if other == name)
    return f"{name} stands twice, in line {first} and in line {last}; leave out one" if first < last else ""


def _with_quotes(key: str, value: str) -> str:
    """Suggest the right spelling of a value that lacks its quotes or its decimal point."""
    if re.fullmatch(r"[+-]?\d+,\d+", value):
        return f"decimals stand behind a point: {key} = {value.replace(',', '.')}"
    kind = "a quantity" if value[0] in "+-.0123456789" else "a name"
    return f'{kind} is text: {key} = "{value}"'


def flat(tables: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, object]]:
    """Walk nested tables as (dotted path, value)."""
    for name, value in tables.items():
        path = prefix + (name if is_name(name) else shown(name))  # so that dots inside do not mislead
        if isinstance(value, dict) and value:
            yield from flat(value, f"{path}.")
        else:
            yield path, value
