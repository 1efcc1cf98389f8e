"""Scripts and style sheet of the page, and the policy that lets only them run."""

from __future__ import annotations

import base64
import gzip
import hashlib
from dataclasses import dataclass
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
    "linkage.js",
    "choice.js",
    "parallel.js",
    "run.js",
)
"""Our scripts, in the order in which they run."""

_POLICY: Final = (
    "default-src 'none'; script-src {}; style-src 'unsafe-inline'; img-src data: blob:; font-src data:; "
    "base-uri 'none'; form-action 'none'"
)


def style() -> str:
    """Return the style sheet."""
    return _text("page.css")


@dataclass(frozen=True)
class Scripts:
    """What runs in a page.

    Attributes
    ----------
    ours
        Our own scripts as one text.
    library
        The plotting library, compressed, as base64.
    policy
        Content security policy of the page: these two run, and nothing is fetched.
    """

    ours: str
    library: str
    policy: str


NONE: Final = Scripts("", "", _POLICY.format("'none'"))
"""A page without scripts."""


@cache
def scripts() -> Scripts:
    """Return the scripts of a page with live figures."""
    from plotly.offline import get_plotlyjs

    library = get_plotlyjs()
    ours = "\n".join(_text(name) for name in SCRIPTS)
    wrapped = f'"use strict";\n(() => {{\n{ours}\n}})();'
    packed = base64.b64encode(gzip.compress(library.encode("utf-8"), 6, mtime=0)).decode("ascii")
    return Scripts(
        wrapped, packed, _POLICY.format(f"'sha256-{_digest(wrapped)}' 'sha256-{_digest(library)}'")
    )


def _digest(text: str) -> str:
    return base64.b64encode(hashlib.sha256(text.encode("utf-8")).digest()).decode("ascii")


def _text(name: str) -> str:
    return files(__name__).joinpath(name).read_text(encoding="utf-8")
