"""Charts over time, described once, drawn by matplotlib for ``figures/`` and in a browser for the report."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import xarray as xr

from tribodyn.views.curves import Panel
from tribodyn.views.lines import over_time
from tribodyn.views.section import Payload, Section


@dataclass(frozen=True)
class Chart:
    """Panels above each other over the simulated time.

    Attributes
    ----------
    name
        File name of its figure, and identifier of its section in the report.
    title
        What it shows.
    caption
        How to read it, in a sentence or two.
    needs
        Names of the variables without which it is left out.
    panels
        Returns what is drawn.
    """

    name: str
    title: str
    caption: str
    needs: tuple[str, ...]
    panels: Callable[[xr.Dataset], Sequence[Panel]]

    @property
    def section(self) -> Section:
        """The chart in the report."""
        return Section(
            name=self.name.replace("_", "-"),
            title=self.title,
            caption=self.caption,
            needs=self.needs,
            widget="lines",
            data=self._payload,
            still=self.name,
        )

    def _payload(self, dataset: xr.Dataset) -> Payload | None:
        return over_time(dataset, self.panels(dataset))
