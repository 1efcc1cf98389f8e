"""Configuration of the manual (Sphinx)."""

from __future__ import annotations

import re
import sys
from importlib.metadata import version as installed_version
from pathlib import Path
from types import GenericAlias
from typing import Any

import numba

# Compiled functions hide their signature; as plain Python they show it. Here only: tutorials compile.
numba.config.DISABLE_JIT = 1

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

project = "tribodyn"
author = "The tribodyn developers"
copyright = f"2026, {author}"
release = version = installed_version("tribodyn")

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx_design",
    "numpydoc",
    "mathml",
    "reference",
    "validation_pages",
]
exclude_patterns = ["_build"]

myst_enable_extensions = ["amsmath", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
myst_dmath_double_inline = True

nb_execution_mode = "auto"
nb_execution_raise_on_error = True
nb_execution_timeout = 600

autodoc_typehints = "none"  # the signature shows them, the docstring says what they mean
autodoc_member_order = "bysource"
numpydoc_show_class_members = False
numpydoc_class_members_toctree = False

html_theme = "furo"
html_title = f"tribodyn {release}"
html_static_path = ["_static"]
html_css_files = ["manual.css"]
html_math_renderer = "mathml"


LITERAL_OR_BAR = re.compile(r"(``.*?``)|\|")


def _skip_member(app: Any, what: str, name: str, member: Any, skip: bool, options: Any) -> bool | None:
    """Leave out type aliases."""
    return True if isinstance(member, GenericAlias) else None


def _bars_are_magnitudes(app: Any, what: str, name: str, member: Any, options: Any, lines: list[str]) -> None:
    """Escape ``|u|``: reStructuredText would take it for a substitution."""
    lines[:] = [LITERAL_OR_BAR.sub(lambda found: found[1] or r"\|", line) for line in lines]


def setup(app: Any) -> None:
    """Register the hooks."""
    app.connect("autodoc-skip-member", _skip_member)
    app.connect("autodoc-process-docstring", _bars_are_magnitudes)
