"""Pages of the validation sets, one each, from what ``docs/plots/validation.py`` has computed."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

from tribodyn.validation import NAMES

FOLDER: Final = Path("validation", "sets")
PAGE: Final = """```{{include}} ../../_static/generated/validation/{name}.md
:relative-images:
```
"""


def write(source: Path) -> None:
    """Write a page for each set, and remove those of sets that are gone."""
    folder = source / FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.md"):
        if old.stem not in NAMES:
            old.unlink()
    for name in NAMES:
        path, text = folder / f"{name}.md", PAGE.format(name=name)
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


def setup(app: Any) -> dict[str, bool]:
    """Write the pages before they are read."""
    app.connect("builder-inited", lambda app: write(Path(app.srcdir)))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
