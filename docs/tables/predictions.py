"""The register of predictions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from tables.markdown import Lines, Table, head, row
from tribodyn.validation.predictions import register
from tribodyn.validation.report import number


def predictions() -> Lines:
    """Give every entry with its interval, that of the null model, and what would refute it."""
    yield from head(
        "set", "quantity", "value", "interval", "null model", "unit", "refuted by", "entered", "hash"
    )
    for entry in register():
        cells = (f"`{entry['set']}`", entry["name"], number(entry["value"]), _interval(entry, ""))
        known = (entry["unit"], entry.get("refuted_by", ""), f"{entry['date']}", f"`{entry['hash'][:12]}`")
        null = f"{number(entry['null'])} ({_interval(entry, 'null_')})" if "null" in entry else ""
        yield row(*cells, null, *known)


def _interval(entry: Mapping[str, Any], prefix: str) -> str:
    return " to ".join(number(entry[f"{prefix}{end}"]) for end in ("low", "high"))


TABLES: Final[dict[str, Table]] = {"predictions": predictions}
