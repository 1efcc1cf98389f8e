"""Lines of Markdown tables, and tables of what is stored in files."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, Final

STATIC: Final = Path(__file__).parents[1] / "_static"
BAR: Final = "\\|"  #: A bar inside a cell.

Found = dict[str, Any]
Lines = Iterator[str]
Table = Callable[[], Lines]


def head(*cells: str) -> Lines:
    """Give the first two lines of a table."""
    yield row(*cells)
    yield f"|{'---|' * len(cells)}"


def row(*cells: str) -> str:
    """Return a line of a table."""
    return f"| {' | '.join(cells)} |"


def seconds(time: float) -> str:
    """Return a time with two digits, as a person writes it."""
    return f"{time:.0f} s" if time >= 10.0 else f"{time:.2g} s"


def stored(source: Path, lines: Callable[[Found], Lines]) -> Table:
    """Return a table that is made from a file of stored measurements."""
    return lambda: lines(json.loads(source.read_text(encoding="utf-8")))
