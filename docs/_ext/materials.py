"""Directive ``materials``: the library of materials as a table, a row for each property."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from contact_laws import Table

from tribodyn.cases.materials import MATERIALS, written


class Materials(Table):
    """Name, property, value, what it holds for and where it stands."""

    def lines(self) -> Iterator[str]:
        """Give a row for each property."""
        yield "| material | property | value | holds for | source |"
        yield "|---|---|---|---|---|"
        for name, material in MATERIALS.items():
            first = f"`{name}`: {material.title}"
            for key, known in material.properties.items():
                cells = (first, key.replace("_", " "), written(key, known), known.validity, known.source)
                yield f"| {' | '.join(cells)} |"
                first = ""
            if material.unknown:
                names = ", ".join(name.replace("_", " ") for name in material.unknown)
                yield f"| | not known: {names} | | | |"


def setup(app: Any) -> dict[str, bool]:
    """Register the directive."""
    app.add_directive("materials", Materials)
    return {"parallel_read_safe": True}
