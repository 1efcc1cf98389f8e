"""Content of the vane mechanism's report: its chapters, and the overlays of a comparison."""

from typing import Final

from tribodyn.papers.cheng_2022.reduced.checks import CLEARANCE, WHOLE
from tribodyn.papers.cheng_2022.reduced.sections import mechanism, vane_error
from tribodyn.papers.cheng_2022.reduced.sections.motion import MOTION, WARMING
from tribodyn.views import common
from tribodyn.views.bushing_sections import CONTACT_FORCE, ORBIT, PRESSURE, TILT
from tribodyn.views.common import Overlay, OverlayQuantity, scaled
from tribodyn.views.energy_balance import balance_chart
from tribodyn.views.section import OVER_TIME, Chapter
from tribodyn.views.wear import WEAR_HISTORY, WEAR_MAP, WEAR_STAGES

_WHOLE: Final = balance_chart(
    WHOLE,
    name="energy",
    title="Energy balance of the whole mechanism",
    caption=(
        "What all bodies, the drive and the loads took in, stored and turned into heat since the start. The "
        "residual is what the sum misses: an error of the integration would show there."
    ),
)
_CLEARANCE: Final = balance_chart(
    CLEARANCE,
    name="clearance_energy",
    title="Energy balance of the motion in the clearance",
    caption=(
        "The same for the small motion of the trunnion alone, where an error in the contact heat cannot hide "
        "behind the work of the drive. Steps are the impacts after reversals."
    ),
)

#: In reading order, of the report and of ``figures/``.
CHARTS: Final = (vane_error.ERROR, vane_error.LOOP, CONTACT_FORCE, TILT, MOTION, WARMING, _WHOLE, _CLEARANCE)
#: Chapters in reading order.
CHAPTERS: Final = (
    Chapter(
        "playback",
        "One cycle",
        "Everything in this part shows the same moment. Move the slider, or press play.",
        (mechanism.SECTION, ORBIT.section, PRESSURE),
        playback=True,
    ),
    Chapter("time", "Over time", OVER_TIME, tuple(chart.section for chart in CHARTS)),
    Chapter("worn", "Wear", "What is worn off the bushing.", (WEAR_MAP, WEAR_HISTORY.section, WEAR_STAGES)),
)

#: Overlays of a comparison of runs.
OVERLAYS: Final = (
    Overlay(
        "error",
        "Vane-angle error",
        (OverlayQuantity("angle error [°]", ("theta_v", "theta_v_ideal"), vane_error.error),),
    ),
    *common.BUSHING,
    Overlay("drive", "Drive moment", (scaled("M_d", "drive moment [N m]", 1.0),)),
)
