"""Draw the film of the README: its mechanism, and one pin in its bore with the clearance magnified.

python docs/plots/moving.py docs/_static/moving.gif
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any, Final

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.patches import Circle, Rectangle
from numpy.typing import NDArray
from PIL import Image

sys.path.insert(0, str(Path(__file__).parent))
from mechanism import README, lines

from tribodyn.figures.style import BLUE, GREY, INK, SMALL, VERMILION
from tribodyn.mechanism.assembly.skeleton import Skeleton
from tribodyn.mechanism.figures.animation import moving

JOINT: Final = "wrist"
CRANK: Final = "crank"
FRAMES: Final = 48
COLOURS: Final = 64
PIN: Final = 0.72  #: Radius of the pin over that of the bore, as shown.
#: Distance of a name from the middle of its rod, to the side and upwards [mm].
BESIDE: Final = np.array([18.0, 11.0])
PAPER: Final = {"facecolor": "white", "edgecolor": "none", "pad": 1.0}
STEEL: Final = "#b7c4d1"
WINDOW: Final = (-70.0, 195.0, -68.0, 68.0)  #: Part of the plane of the mechanism that is shown [mm].


def draw_mechanism(axes: Axes, drawn: Skeleton, position: NDArray[Any], orientation: NDArray[Any]) -> None:
    """Draw rods between the joints, the slider on its rail, and the joints."""
    rods = [drawn.lines(body, position[body], orientation[body])[:, :2] for body in range(2)]
    slider = 1e3 * position[2, :2]
    for y in (-11.0, 11.0):
        axes.plot((45.0, 195.0), (y, y), color=GREY, linewidth=3.0)
    axes.add_patch(Rectangle(slider - (18.0, 9.5), 36.0, 19.0, facecolor=STEEL, edgecolor=INK))
    for rod, name in zip(rods, drawn.bodies, strict=False):
        axes.plot(*rod.T, color=INK, linewidth=9.0, solid_capstyle="round")
        axes.plot(*rod.T, color=STEEL, linewidth=7.0, solid_capstyle="round")
        across = np.array([-1.0, 1.0]) * (rod[1] - rod[0])[::-1] / np.linalg.norm(rod[1] - rod[0])
        side = -1.0 if name == CRANK and across[0] > 0.0 else 1.0  # away from the rod
        place = rod.mean(axis=0) + side * BESIDE * across
        axes.text(*place, name, size=SMALL, ha="center", va="center", bbox=PAPER)
    for point, colour in ((rods[0][0], INK), (rods[0][1], INK), (slider, VERMILION)):
        axes.plot(*point, "o", ms=7, mfc="white", mec=colour, mew=1.6, zorder=4)
    axes.text(*(slider - (0.0, 24.0)), "slider", size=SMALL, ha="center")
    axes.set(xlim=WINDOW[:2], ylim=WINDOW[2:], aspect="equal")
    axes.axis("off")


def draw_bore(axes: Axes, result: xr.Dataset, now: float, until: float) -> None:
    """Draw bore and pin at one time, with the path of the pin and the force on it."""
    joint = result.sel(joint=JOINT)
    scale = (1.0 - PIN) / float(joint["clearance"])
    path = scale * joint["displacement"].sel(time=slice(now, until)).values[:, :2]
    x, y = path[-1]
    force = joint["contact_force"].sel(time=until, method="nearest").values[:2]
    most = float(np.linalg.norm(joint["contact_force"].values[:, :2], axis=1).max())
    axes.add_patch(Circle((0.0, 0.0), 1.16, facecolor=STEEL, edgecolor=INK))
    axes.add_patch(Circle((0.0, 0.0), 1.0, facecolor="white", edgecolor=GREY))
    axes.add_patch(Circle((x, y), PIN, facecolor="white", edgecolor=INK, linewidth=1.6))
    axes.plot(*path.T, color=BLUE, linewidth=0.8)
    axes.annotate(
        "", (x, y) + 0.65 * force / most, (x, y), arrowprops={"arrowstyle": "-|>", "color": VERMILION}
    )
    axes.set(xlim=(-1.25, 1.25), ylim=(-1.5, 1.25), aspect="equal")
    axes.axis("off")
    size = np.hypot(*force)
    words = f"{JOINT} pin, clearance 20 µm magnified\nforce on the pin {size:4.0f} N"
    axes.text(0.0, -1.22, words, ha="center", va="top", size=SMALL + 1, color=INK)


def main() -> None:
    """Run the lines of the README, and write the film."""
    names: dict[str, Any] = {}
    text = "import tribodyn as td\n" + lines(README.read_text(encoding="utf-8"))
    exec(compile(text, "README", "exec"), names)
    result = names["motion"]
    end = float(result["time"][-1])
    times = np.linspace(0.0, end, FRAMES, endpoint=False) + end / FRAMES
    drawn, position, orientation = moving(result, times)
    plt.switch_backend("agg")
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 3.5), dpi=80, width_ratios=(2.0, 1.1))
    figure.subplots_adjust(0.01, 0.01, 0.99, 0.99, 0.02)
    canvas, film = FigureCanvasAgg(figure), []
    for k, time in enumerate(times):
        left.clear()
        right.clear()
        draw_mechanism(left, drawn, position[k], orientation[k])
        draw_bore(right, result, time - 0.3 * end, time)
        canvas.draw()
        film.append(
            Image.fromarray(np.asarray(canvas.buffer_rgba()))
            .convert("RGB")
            .quantize(COLOURS, Image.Quantize.FASTOCTREE)
        )
    film[0].save(sys.argv[1], save_all=True, append_images=film[1:], duration=67, loop=0)


if __name__ == "__main__":
    main()
