"""Files of validation results: a page and a plot for each set, and all numbers as JSON."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from tribodyn.validation.plot import save_plot
from tribodyn.validation.report import Judged, as_json, as_page


def save(all_judged: Sequence[Judged], folder: Path) -> None:
    """Write ``NAME.md`` and ``NAME.png`` of each set, and ``validation.json`` with all numbers."""
    for one in all_judged:
        (folder / f"{one.set.name}.md").write_text(as_page(one), encoding="utf-8")
        if one.outcome.plot is not None:
            save_plot(one.outcome.plot, one.set.title, folder / f"{one.set.name}.png")
    document = json.dumps([as_json(one) for one in all_judged], indent=2, ensure_ascii=False)
    (folder / "validation.json").write_text(document + "\n", encoding="utf-8")
