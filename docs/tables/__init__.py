"""Tables on pages of the manual, by name; ``docs/fill.py`` writes them."""

from __future__ import annotations

from typing import Final

from tables import benchmarks, costs, counts, keys, laws, paper, predictions, results, solvers
from tables.markdown import Table

TABLES: Final[dict[str, Table]] = {
    name: table
    for module in (benchmarks, costs, counts, keys, laws, paper, predictions, results, solvers)
    for name, table in module.TABLES.items()
}
