"""What the report shows of the disc."""

from tribodyn.views.charts import Chart, ChartCurve, Panel
from tribodyn.views.common import Overlay, scaled
from tribodyn.views.playback import series
from tribodyn.views.section import OVER_TIME, Chapter

HEIGHT = Chart(
    name="height",
    title="Height of the disc",
    caption="How it falls and bounces.",
    needs=("height",),
    panels=lambda dataset: [Panel("height [µm]", [ChartCurve("height", series(dataset, "height", 1e6))])],
)
CHAPTERS = (Chapter("time", "Over time", OVER_TIME, (HEIGHT.section,)),)
OVERLAYS = (Overlay("height", "Height", (scaled("height", "height [µm]", 1e6),)),)
