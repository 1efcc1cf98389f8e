"""From a case to TOML text, plain or commented."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from textwrap import wrap

from tribodyn.cases.base import Case
from tribodyn.cases.keys import ASSUMED, Key, keys_of

_COMMENT_COLUMN = 38
_LONGEST_LINE = 120
_ASSUMED = "ASSUMED"


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
    yield '# Values with a unit are text, "20 um"; others are bare. Keys left out take their defaults.'
    yield f"# {_ASSUMED}: the paper does not give this value."
    yield ""


def _lines(case: Case, key: Key, comments: bool) -> Iterator[str]:
    value = case.at(key.path)
    line = f"# {key.name} = {_example(key)}" if value is None else f"{key.name} = {key.write(value)}"
    if not comments:
        yield from [] if value is None else [line]
        return
    together = f"{line:<{_COMMENT_COLUMN}}  # {comment(key)}"
    if len(together) <= _LONGEST_LINE:
        yield together
    else:
        yield from wrap(
            f"{comment(key)}:",
            _LONGEST_LINE,
            initial_indent="# ",
            subsequent_indent="#   ",
            break_on_hyphens=False,
        )
        yield line


def _example(key: Key) -> str:
    """Return a value for a key that is not in force, where its alternative is."""
    return f'"{key.example}"' if key.unit or key.kind in ("file", "choice") else key.example


def comment(key: Key) -> str:
    """Return what a key means, where its default comes from and what it may hold, on one line."""
    source = _ASSUMED if key.source == ASSUMED else key.source
    bounds = " | ".join(key.choices) if len(key.choices) > 1 else key.limits
    return "; ".join(part for part in (key.description, bounds, source) if part)
