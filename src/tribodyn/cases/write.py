"""From a case to TOML text, plain or commented, to a table for notebooks, and to its choices."""

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import replace
from html import escape
from itertools import groupby
from textwrap import wrap
from types import MappingProxyType
from typing import Any, TypeAlias

from pydantic import BaseModel

from tribodyn.cases.keys import ANY_NAME, ASSUMED, VALUE, Key, keys_of, toml_string
from tribodyn.cases.parameters import TABLE as PARAMETERS
from tribodyn.cases.tables import as_declared, keys_in, value_at

_COMMENT_COLUMN = 38
_LONGEST_LINE = 120
_ASSUMED = "ASSUMED"


def to_toml(
    case: BaseModel,
    kind: str,
    own: Collection[str],
    idle: Collection[str],
    origins: Mapping[str, str],
    *,
    linked: Mapping[str, Any] = MappingProxyType({}),
    comments: bool,
) -> str:
    """Return a case of some kind as TOML; see :meth:`tribodyn.cases.Case.to_toml`.

    Of the keys that are a user's ``own``, comments say what they would be without. ``idle`` keys are out of
    force; ``origins`` are the sources of values that are neither. Values that are ``linked`` to expressions
    are written as these, with what they are in a comment.
    """
    lines = list(_head(kind)) if comments else []
    tables = {
        table: [
            line
            for key in inside
            for value in [None if key.path in idle else getattr(group, key.name)]
            for line in _lines(value, key, linked.get(key.path), own, origins, comments)
        ]
        for table, inside in groupby(keys_in(case).values(), key=lambda key: key.table)
        if (group := value_at(case, table) if table else case) is not None
    }
    for table, inside in (tables if comments else _shortened(tables)).items():
        if not inside and _is_always_there(case, table):
            continue
        # Names with numbers stand in quotes.
        path = ".".join(f'"{name}"' if {"[", ":"} & {*name} else name for name in table.split("."))
        lines += ["", f"[{path}]", *inside] if table else inside
    if comments:
        declared = keys_of(type(case))
        lines += _not_there(declared, {as_declared(table, declared) for table in tables})
    return "\n".join(lines) + "\n"


def keys_as_toml(model: type[BaseModel], kind: str) -> str:
    """Return every key of a kind of case as commented TOML, with its default or an example."""
    declared = keys_of(model)
    top = (key for key in declared.values() if not key.table and key.name != "case")
    lines = [line for key in top for line in _declared(key)]
    return "\n".join([*_head(kind), f'case = "{kind}"', *lines, *_not_there(declared, ())]) + "\n"


def _declared(key: Key) -> Iterator[str]:
    """Yield a key that a case does not have, commented out, with its default or an example."""
    value = _example(key) if key.default is None else key.write(key.default)
    yield from _commented(f"# {key.name} = {value}", key)


def _shortened(tables: Mapping[str, list[str]]) -> dict[str, list[str]]:
    """Return the lines of tables; one that holds only its ``value`` is a line of the table above it."""
    short: dict[str, list[str]] = {}
    for table, lines in tables.items():
        above, _, name = table.rpartition(".")
        alone = len(lines) == 1 and lines[0].startswith(f"{VALUE} = ")
        if alone and (above in short or above == PARAMETERS):
            short.setdefault(above, []).append(lines[0].replace(VALUE, name, 1))
        else:
            short[table] = lines
    return short


def _is_always_there(case: BaseModel, table: str) -> bool:
    """Whether a table need not be written where it holds no key: the case has it all the same."""
    known = type(case).model_fields.get(table)
    return known is not None and isinstance(known.default, BaseModel)


def _head(kind: str) -> Iterator[str]:
    yield f'# All keys of a "{kind}" case. Copy, edit, then: tribodyn run FILE.toml'
    yield '# Values with a unit are text, "20 um"; others are bare. Keys left out take their defaults.'
    yield f"# {_ASSUMED}: a value without a source."
    yield ""


def _lines(
    value: Any, key: Key, expression: Any, own: Collection[str], origins: Mapping[str, str], comments: bool
) -> Iterator[str]:
    if value is None and not comments:
        return
    if value is not None and expression is not None and (written := _as_toml(expression)) != key.write(value):
        key = replace(key, description=f"{key.write(value)}; {key.description}")
        line = f"{key.name} = {written}"
        if not comments:
            line = f"{line}  # {key.write(value)}"
    else:
        line = f"# {key.name} = {_example(key)}" if value is None else f"{key.name} = {key.write(value)}"
    if not comments:
        yield line
    else:
        has_origin = key.path in origins
        changed = not has_origin and key.default is not None and value != key.default
        sourced = replace(key, source=origins[key.path]) if has_origin else key
        yield from _commented(line, sourced, own=changed or key.path in own)


def _as_toml(expression: Any) -> str:
    """Return an expression, or a list of them, as a file has it."""
    if isinstance(expression, list | tuple):
        return f"[{', '.join(map(_as_toml, expression))}]"
    return toml_string(expression) if isinstance(expression, str) else repr(expression)


def _not_there(declared: Mapping[str, Key], tables: Collection[str]) -> Iterator[str]:
    """Yield, commented out, tables that may be left out or have names of their own, where there is none."""
    for table, own in groupby(declared.values(), key=lambda key: key.table):
        if table and table not in tables:
            yield from ("", f"# [{table.replace(ANY_NAME, 'NAME')}]")
            for key in own:
                yield from _declared(key)


def _commented(line: str, key: Key, *, own: bool = False) -> Iterator[str]:
    """Yield a line with what its key means after it, or before it where that is too long."""
    together = f"{line:<{_COMMENT_COLUMN}}  # {comment(key, own=own)}"
    if len(together) <= _LONGEST_LINE:
        yield together
    else:
        yield from wrap(
            f"{comment(key, own=own)}:",
            _LONGEST_LINE,
            initial_indent="# ",
            subsequent_indent="#   ",
            break_on_hyphens=False,
        )
        yield line


def _example(key: Key) -> str:
    """Return a value for a key that is not in force, where its alternative is."""
    quoted = key.kind in ("quantity", "file", "choice", "name")
    return f'"{key.example}"' if quoted else key.example


def comment(key: Key, *, own: bool = False) -> str:
    """Return meaning, allowed values and source of a key, on one line.

    A value of a user's ``own`` does not come from there.
    """
    source = _ASSUMED if key.source == ASSUMED else key.source
    if own:
        source = (
            "" if key.default in (None, "") else f"default {key.write(key.default)}, {source}".rstrip(", ")
        )
    bounds = " | ".join(key.choices) if len(key.choices) > 1 else key.limits
    return "; ".join(part for part in (key.description, bounds, source) if part)


def to_html(case: BaseModel, title: str, own: Collection[str]) -> str:
    """Return a case as HTML.

    ``own``: what a user gave, by dotted path.
    """
    keys = [key for key in keys_in(case).values() if value_at(case, key.path) is not None]
    given = [key for key in keys if key.path in own]
    parts = [f"<strong>{escape(title)}</strong>", *_table(case, given, own)]
    for table, inside in groupby(keys, key=lambda key: key.table):
        if table:
            parts += [
                f"<details><summary>{escape(table)}</summary>",
                *_table(case, inside, own),
                "</details>",
            ]
    return "\n".join(parts)


def _table(case: BaseModel, keys: Iterable[Key], own: Collection[str]) -> Iterator[str]:
    yield "<table>"
    for key in keys:
        value = key.write(value_at(case, key.path)).strip('"')
        cells = (key.path, value, comment(key, own=key.path in own))
        yield f"<tr>{''.join(f'<td style=text-align:left>{escape(cell)}</td>' for cell in cells)}</tr>"
    yield "</table>"


Choices: TypeAlias = frozenset[tuple[str, object]]


def choices_of(case: BaseModel) -> Choices:
    """Return the choices of a case but for its title. Cases that agree in them have the same equations."""
    return frozenset(_choices(case.model_dump(exclude={"title", "results"})))


def _choices(settings: Mapping[str, Any], path: str = "") -> Iterator[tuple[str, object]]:
    """Yield settings below a path."""
    for name, value in settings.items():
        if isinstance(value, Mapping):
            yield from _choices(value, f"{path}{name}.")
        elif value is None or isinstance(value, str | bool):
            yield f"{path}{name}", value
