"""Scripts and style sheet of the page, and the policy that lets only them in."""

import base64
import hashlib
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Final

#: Scripts that draw, in the order in which they run: the same in every page.
SCRIPTS: Final = (
    "start.js",
    "theme.js",
    "plots.js",
    "axes.js",
    "clock.js",
    "lines.js",
    "hover.js",
    "orbit.js",
    "field.js",
    "solid.js",
    "camera.js",
    "stage.js",
    "scene.js",
    "joints.js",
    "linkage.js",
    "choice.js",
)
OF_REPORT: Final = ("parallel.js", "run.js")  #: Scripts of reports alone.

_POLICY: Final = (
    "default-src 'none'; script-src {}; style-src {}; img-src data:; base-uri 'none'; form-action 'none'"
)


@dataclass(frozen=True)
class Inside:
    """Content of a page."""

    script: str  #: Our scripts as one text; empty on a page without live figures.
    style: str  #: The style sheet.
    policy: str  #: Content security policy of the page: these two are let in, and nothing is fetched.


@cache
def inside(live: bool) -> Inside:
    """Return the content of a report, with live figures or without."""
    script, style = joined((*SCRIPTS, *OF_REPORT)) if live else "", text("page.css")
    return Inside(script, style, _POLICY.format(_named(script) if live else "'none'", _named(style)))


def joined(names: Iterable[str]) -> str:
    """Return scripts of this folder as one that leaves no names behind."""
    ours = "\n".join(text(name) for name in names)
    return f'"use strict";\n(() => {{\n{ours}\n}})();'


def text(name: str) -> str:
    """Return a file of this folder."""
    return files(__name__).joinpath(name).read_text(encoding="utf-8")


def _named(content: str) -> str:
    """Return a text's name in a policy: its hash."""
    return f"'sha256-{base64.b64encode(hashlib.sha256(content.encode('utf-8')).digest()).decode('ascii')}'"
