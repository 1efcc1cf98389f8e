"""From a case to TOML text, plain or commented."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

from tribodyn.cases.base import Case
from tribodyn.cases.keys import ASSUMED, Key, keys_of

_COMMENT_COLUMN = 36


def to_toml(case: Case, *, comments: bool) -> str:
    """Return `case` as TOML; see :meth:`Case.to_toml`."""
    lines = list(_head(case)) if comments else []
    for table, keys in groupby(keys_of(type(case)).values(), key=lambda key: key.table):
        if table:
            lines += ["", f"[{table}]"]
        lines += [line for key in keys for line in _lines(case, key, comments)]
    return "\n".join(lines) + "\n"


def _head(case: Case) -> Iterator[str]:
    yield f'# All keys of a "{case.kind()}" case. Copy, edit, then: tribodyn run FILE.toml'
    yield '# A value with a unit is text, "20 um"; one without is a bare number. Keys left out take their defaults.'
    yield ""


def _lines(case: Case, key: Key, comments: bool) -> Iterator[str]:
    value = case.at(key.path)
    if value is None:
        if comments:
            yield _commented(f'# {key.name} = "{key.example}"' if key.example else f"# {key.name} =", key)
        return
    line = f"{key.name} = {key.write(value)}"
    yield _commented(line, key) if comments else line


def _commented(line: str, key: Key) -> str:
    return f"{line:<{_COMMENT_COLUMN}}  # {comment(key)}"


def comment(key: Key) -> str:
    """Return what a key means, where its default comes from and what it may hold, on one line."""
    source = "ASSUMED, not in the paper" if key.source == ASSUMED else key.source
    bounds = " | ".join(key.choices) if len(key.choices) > 1 else key.limits
    return "; ".join(part for part in (key.description, bounds, source) if part)
