"""Scripts and style sheet of the page, and the policy that lets only them run."""

from __future__ import annotations

import base64
import hashlib
from functools import cache
from importlib.resources import files
from typing import Final

SCRIPTS: Final = (
    "start.js",
    "theme.js",
    "plots.js",
    "clock.js",
    "lines.js",
    "orbit.js",
    "field.js",
    "solid.js",
    "scene.js",
    "run.js",
)
"""Our scripts, in the order in which they run."""


def style() -> str:
    """Return the style sheet."""
    return _text("page.css")


@cache
def scripts() -> tuple[str, ...]:
    """Return the plotting library and our scripts, as they stand in the page."""
    from plotly.offline import get_plotlyjs

    ours = "\n".join(_text(name) for name in SCRIPTS)
    return get_plotlyjs(), f'"use strict";\n(() => {{\n{ours}\n}})();'


def policy(texts: tuple[str, ...]) -> str:
    """Return the content security policy of a page with these scripts: they run, and nothing is fetched."""
    allowed = " ".join(f"'sha256-{_digest(text)}'" for text in texts) or "'none'"
    return (
        f"default-src 'none'; script-src {allowed}; style-src 'unsafe-inline'; img-src data: blob:; "
        "font-src data:; base-uri 'none'; form-action 'none'"
    )


def _digest(text: str) -> str:
    return base64.b64encode(hashlib.sha256(text.encode("utf-8")).digest()).decode("ascii")


def _text(name: str) -> str:
    return files(__name__).joinpath(name).read_text(encoding="utf-8")
