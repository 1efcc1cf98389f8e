"""Families of :mod:`tribodyn.contact` and the library of materials as tables."""

from __future__ import annotations

from typing import Final

import numpy as np

from tables.markdown import Lines, Table, head, row
from tribodyn.cases.materials import MATERIALS, written
from tribodyn.contact import DAMPING_FACTORS, LAWS

WANTED: Final = (0.3, 0.5, 0.7, 0.9)  #: Coefficients of restitution of the table of damping factors.


def laws() -> Lines:
    """Give name, meaning, range and source of every contact law."""
    yield from head("name", "law", "holds for", "source")
    for name, kind in LAWS.items():
        yield row(f"`{name}`", kind.title, kind.validity, kind.source)


def damping_factors() -> Lines:
    """Give name, source, validity and realised restitution of every damping factor."""
    yield from head("name", "source", "right within 0.05", *(f"returned for {e}" for e in WANTED))
    for name, factor in DAMPING_FACTORS.items():
        realised = (f"{e:.3f}" for e in factor.realised(np.array(WANTED)))
        yield row(f"`{name}`", factor.source, f"from {factor.valid_from:.2f}", *realised)


def materials() -> Lines:
    """Give a row for each property of each material."""
    yield from head("material", "property", "value", "holds for", "source")
    for name, material in MATERIALS.items():
        first = f"`{name}`: {material.title}"
        for key, known in material.properties.items():
            yield row(first, key.replace("_", " "), written(key, known), known.validity, known.source)
            first = ""
        if material.unknown:
            names = ", ".join(name.replace("_", " ") for name in material.unknown)
            yield row("", f"not known: {names}", "", "", "")


#: Tables by name.
TABLES: Final[dict[str, Table]] = {
    "contact-laws": laws,
    "damping-factors": damping_factors,
    "materials": materials,
}
