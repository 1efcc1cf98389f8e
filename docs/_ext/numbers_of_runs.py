"""Role ``number``: a number inside a sentence, measured by ``docs/plots/measured.py``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Final

from docutils import nodes

SOURCE: Final = Path(__file__).parents[1] / "_static" / "generated" / "numbers.json"


def number(
    name: str, rawtext: str, text: str, lineno: int, inliner: Any, options: Any = None, content: Any = None
) -> tuple[list[nodes.Node], list[nodes.Node]]:
    """Return the number of this name as text; an unknown name is an error of the build."""
    document = inliner.document
    document.settings.record_dependencies.add(str(SOURCE))
    found = json.loads(SOURCE.read_text(encoding="utf-8")) if SOURCE.is_file() else {}
    if text not in found:
        message = inliner.reporter.error(f"no number {text!r} in {SOURCE.name}", line=lineno)
        return [inliner.problematic(rawtext, rawtext, message)], [message]
    return [nodes.Text(found[text])], []


def setup(app: Any) -> dict[str, bool]:
    """Register the role."""
    app.add_role("number", number)
    return {"parallel_read_safe": True}
