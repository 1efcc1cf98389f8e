"""Types of sections and chapters of the report."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, TypeAlias

if TYPE_CHECKING:
    import xarray as xr

Payload: TypeAlias = Mapping[str, Any]
"""Data for the script of a figure: texts, numbers, lists, mappings and arrays."""


@dataclass(frozen=True)
class Section:
    """One figure of the page, drawn in the browser from data that travel with it.

    Attributes
    ----------
    name
        Identifier in the page, unique among the sections of a page.
    title
        What it shows.
    caption
        How to read it, in a sentence or two.
    needs
        Names of the variables without which it is left out; the page says that they are its data.
    widget
        Which script draws it: a name in ``widgets`` of ``assets``.
    data
        Returns what the script reads, or nothing where the result does not hold enough to draw.
    still
        Name of the figure in ``figures/`` that stands for it on paper and where scripts do not run.
    """

    name: str
    title: str
    caption: str
    needs: tuple[str, ...]
    widget: str
    data: Callable[[xr.Dataset], Payload | None]
    still: str = ""

    def payload(self, dataset: xr.Dataset) -> Payload | None:
        """Return the data of the script; nothing where the result does not hold it."""
        if any(name not in dataset.variables for name in self.needs):
            return None
        return self.data(dataset)


@dataclass(frozen=True)
class Chapter:
    """Sections under one heading.

    Attributes
    ----------
    name
        Identifier in the page.
    title
        Heading; also its entry in the table of contents.
    lead
        A sentence below the heading.
    sections
        In reading order.
    playback
        Whether the sections follow the time slider, which then stands with them.
    """

    name: str
    title: str
    lead: str
    sections: tuple[Section, ...]
    playback: bool = False


OVER_TIME: Final = (
    "Drag across a plot to zoom. By keyboard: go to a plot with Tab, then +, −, arrows, and 0 for the whole."
)
"""Lead of a chapter of charts."""


def choice(widget: str, label: str, parts: Mapping[str, Payload | None]) -> Payload | None:
    """Return the data of the script ``choice``; nothing where there is nothing to choose.

    Parameters
    ----------
    widget
        Script that draws each of them.
    label
        What is chosen.
    parts
        What that script reads, by name.
    """
    there = {name: part for name, part in parts.items() if part is not None}
    if not there:
        return None
    return {"widget": widget, "label": label, "names": list(there), "parts": list(there.values())}
