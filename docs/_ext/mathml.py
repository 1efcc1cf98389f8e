"""Formulas as MathML, made when the manual is built: drawn without a script and without a network."""

from __future__ import annotations

import re
from typing import Any

from docutils import nodes
from latex2mathml.converter import convert

_FUNCTION = re.compile(r"<mi>(?=[a-z]{2,}</mi>)")


def formula(tex: str, display: str = "inline") -> str:
    """Return LaTeX as MathML, in which names of functions can be told from those of variables."""
    return _FUNCTION.sub('<mi class="function">', convert(tex, display=display))


def _inline(self: Any, node: nodes.math) -> None:
    self.body.append(formula(node.astext()))
    raise nodes.SkipNode


def _block(self: Any, node: nodes.math_block) -> None:
    # A formula wider than the page scrolls alone; the keyboard reaches it.
    self.body.append(self.starttag(node, "div", CLASS="math formula", tabindex="0", role="math"))
    self.body.append(formula(node.astext(), "block"))
    self.body.append("</div>\n")
    raise nodes.SkipNode


def setup(app: Any) -> dict[str, bool]:
    """Register the renderer ``mathml``."""
    app.add_html_math_renderer("mathml", inline_renderers=(_inline, None), block_renderers=(_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
