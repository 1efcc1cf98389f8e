"""Directives ``contact-laws`` and ``damping-factors``: the families of :mod:`tribodyn.contact` as tables."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList

from tribodyn.contact import DAMPING_FACTORS, LAWS

WANTED = (0.3, 0.5, 0.7, 0.9)


class Table(Directive):
    """A table without arguments."""

    def lines(self) -> Iterator[str]:
        """Give the Markdown of the table."""
        raise NotImplementedError

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        container = nodes.container()
        text = StringList(list(self.lines()), source=self.name)
        self.state.nested_parse(text, self.content_offset, container)
        return container.children


class ContactLaws(Table):
    """One row for each law."""

    def lines(self) -> Iterator[str]:
        """Give name, meaning, range and source of every law."""
        yield "| name | law | holds for | source |"
        yield "|---|---|---|---|"
        for name, kind in LAWS.items():
            yield f"| `{name}` | {kind.title} | {kind.validity} | {kind.source} |"


class DampingFactors(Table):
    """One row for each factor."""

    def lines(self) -> Iterator[str]:
        """Give name, source, validity and what comes back of every factor."""
        yield (
            "| name | source | right within 0.05 | " + " | ".join(f"returned for {e}" for e in WANTED) + " |"
        )
        yield "|---|---|---|" + "---|" * len(WANTED)
        for name, factor in DAMPING_FACTORS.items():
            realised = " | ".join(f"{e:.3f}" for e in factor.realised(np.array(WANTED)))
            yield f"| `{name}` | {factor.source} | from {factor.valid_from:.2f} | {realised} |"


def setup(app: Any) -> dict[str, bool]:
    """Register the directives."""
    app.add_directive("contact-laws", ContactLaws)
    app.add_directive("damping-factors", DampingFactors)
    return {"parallel_read_safe": True}
