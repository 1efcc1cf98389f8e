"""Docstrings of the builder's methods: keys, units, defaults, errors, and an example that runs."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping
from typing import Any, Final

from tribodyn.mechanism.builder.arguments import CASE
from tribodyn.mechanism.builder.methods import METHODS, OF_JOINT, BuilderMethod, Example

_WIDTH: Final = 100
_LINES: Final = textwrap.TextWrapper(_WIDTH, break_long_words=False, break_on_hyphens=False)
BY_NAME: Final = {method.name: method for method in METHODS}


def docstring(method: BuilderMethod) -> str:
    """Return the docstring of a method: what it does, its keys, and an example that runs."""
    named = [f"{name}\n    {meaning[0].upper()}{meaning[1:]}." for name, _, meaning in method.arguments]
    keys = [f"{name}\n{_indented(one.text)}" for name, one in method.keywords.items()]
    parts = (
        method.does,
        _section("Parameters", [*named, *keys]),
        _section("Returns", ["Mechanism\n    The mechanism itself, so that calls can be chained."]),
        _section("Raises", ["InputError\n" + _indented(_refusal(method))]),
        _section("Examples", [*written(method.example, method)]),
    )
    return "\n\n".join(parts) + "\n"


def _refusal(method: BuilderMethod) -> str:
    twice = "The joint is not there." if method.table in OF_JOINT else "The name is given twice."
    return f"{twice} Values are checked by ``case()``, whose message names key, value and what is allowed."


def _section(title: str, lines: list[str]) -> str:
    return "\n".join([title, "-" * len(title), *lines])


def _indented(text: str) -> str:
    return textwrap.indent(_LINES.fill(" ".join(text.split())), "    ")


def written(tables: Example, first: BuilderMethod) -> Iterator[str]:
    """Yield the lines of Python, as a prompt shows them, that make a case, by a method wherever it does."""
    named = {method.table for method in METHODS}
    calls = [_call("", _literals({k: v for k, v in tables.items() if k not in (CASE, *named)}))]
    for method, name, keys in _uses(tables, first):
        ends = iter(keys.get("between", ()))
        own = [
            next(ends) if key == "between" else keys[key] if key else name for _, key, _ in method.arguments
        ]
        filled = {*method.given, *(key for _, key, _ in method.arguments)}
        plain = {key: value for key, value in keys.items() if key not in filled}
        calls.append(_call(f".{method.name}", [*map(_literal, own), *_literals(plain)]))
    yield ">>> import tribodyn as td"
    yield f">>> drawn = td.Mechanism{calls[0]}"
    yield from (f">>> _ = drawn{call}" for call in calls[1:])
    yield ">>> case = drawn.case()"


def _call(method: str, arguments: list[str]) -> str:
    """Return a call, on lines of its own where it is long."""
    line = f"{method}({', '.join(arguments)})"
    if len(line) <= _WIDTH - 12:
        return line
    return f"{method}(\n" + "\n".join(f"...     {argument}," for argument in arguments) + "\n... )"


def _uses(tables: Example, first: BuilderMethod) -> Iterator[tuple[BuilderMethod, str, dict[str, Any]]]:
    """Yield the methods that fill tables, with names and keys; the first one wherever it does."""
    for table, parts in tables.items():
        able = [method for method in (first, *METHODS) if method.table == table]
        for name, keys in parts.items() if able else ():
            own = {key: value for key, value in keys.items() if key not in OF_JOINT}
            yield next(method for method in able if method.given.items() <= keys.items()), name, own
            for below in (below for below in OF_JOINT if below in keys):
                yield BY_NAME[below], name, dict(keys[below])


def _literals(keys: Mapping[str, Any]) -> list[str]:
    return [f"{key}={_literal(value)}" for key, value in keys.items()]


def _literal(value: object) -> str:
    """Return a value as Python spells it, with double quotes."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f'"{key}": {_literal(one)}' for key, one in value.items()) + "}"
    if isinstance(value, list):
        return f"[{', '.join(map(_literal, value))}]"
    return f'"{value}"' if isinstance(value, str) else repr(value)
