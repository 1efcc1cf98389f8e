"""The register of predictions."""

from __future__ import annotations

from typing import Final

from tables.markdown import Table
from tribodyn.validation.predictions import register
from tribodyn.validation.report import predictions_table

TABLES: Final[dict[str, Table]] = {"predictions": lambda: predictions_table(register())}
