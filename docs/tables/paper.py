"""Tables of the source paper's claims, from the kept ensemble."""

from __future__ import annotations

from typing import Final

from tables.markdown import Lines, Table, head, row
from tribodyn.papers.cheng_2022.claims import CLAIMS, as_markdown, kept_rows, summary
from tribodyn.papers.cheng_2022.claims.base import VERDICTS


def counts() -> Lines:
    """Give how many rows and sentences have which verdict."""
    yield from summary.as_markdown(summary.summarise(kept_rows(CLAIMS))).splitlines()


def claims() -> Lines:
    """Give every row with its finding and verdict."""
    yield from as_markdown(kept_rows(CLAIMS)).splitlines()


def sentences() -> Lines:
    """Give how many sentences have which verdict."""
    found = summary.summarise(kept_rows(CLAIMS))["by_sentence"]
    yield from head("sentences of the source paper", *(f"`{name}`" for name in found))
    for verdict in VERDICTS:
        yield row(verdict, *(str(counted[verdict]) for counted in found.values()))


#: Tables by name.
TABLES: Final[dict[str, Table]] = {
    "verdicts": counts,
    "claims of the paper": claims,
    "sentences of the paper": sentences,
}
