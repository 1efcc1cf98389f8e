"""Content of a mechanism's report: its chapters, and the overlays of a comparison."""

from typing import Final

import numpy as np

from tribodyn.mechanism.results.joint_readings import offset, sizes
from tribodyn.mechanism.sections import mechanism
from tribodyn.mechanism.sections.charts import CHARTS, ENERGY
from tribodyn.mechanism.sections.copies import COPIES
from tribodyn.mechanism.sections.joints import FILM_PRESSURE, HODOGRAPHS, ORBITS, PRESSURE, REACTIONS, WEAR
from tribodyn.views.common import Overlay, OverlayQuantity
from tribodyn.views.section import OVER_TIME, Chapter
from tribodyn.views.wear import WEAR_HISTORY

#: Chapters in reading order.
CHAPTERS: Final = (
    Chapter(
        "playback",
        "One cycle",
        "Everything in this part shows the same moment. Move the slider, or press play.",
        (mechanism.SECTION, ORBITS.section, PRESSURE.section, FILM_PRESSURE.section),
        playback=True,
    ),
    Chapter(
        "time",
        "Over time",
        OVER_TIME,
        (*(chart.section for chart in CHARTS), COPIES, REACTIONS, HODOGRAPHS, ENERGY.section),
    ),
    Chapter("worn", "Wear", "What is worn off the joints.", (WEAR.section, WEAR_HISTORY.section)),
)

#: Overlays of a comparison of runs.
OVERLAYS: Final = (
    Overlay(
        "force",
        "Forces in the joints",
        (
            OverlayQuantity(
                "largest of all joints [N]",
                ("reaction_force",),
                lambda d: sizes(d, "reaction_force").max(axis=1),
            ),
        ),
    ),
    Overlay(
        "offset",
        "Offset in the joints",
        (
            OverlayQuantity(
                "largest of all joints [µm]",
                ("displacement", "clearance"),
                lambda d: 1e6 * np.nan_to_num(offset(d)).max(axis=1),
            ),
        ),
    ),
    Overlay(
        "drive",
        "Drive",
        (
            OverlayQuantity(
                "moment [N m]", ("drive_moment",), lambda d: d["drive_moment"].values.sum(axis=1)
            ),
            OverlayQuantity("force [N]", ("drive_force",), lambda d: d["drive_force"].values.sum(axis=1)),
        ),
    ),
)
