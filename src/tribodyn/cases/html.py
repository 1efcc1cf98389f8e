"""A case as a table for notebooks: what a user gave stands out, the rest folds away."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from html import escape
from itertools import groupby

from pydantic import BaseModel

from tribodyn.cases.keys import Key
from tribodyn.cases.tables import keys_in, value_at
from tribodyn.cases.write import comment


def to_html(case: BaseModel, title: str, own: Collection[str]) -> str:
    """Return a case as HTML.

    Parameters
    ----------
    case
        The case.
    title
        Its heading.
    own
        What a user gave, by dotted path.
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
