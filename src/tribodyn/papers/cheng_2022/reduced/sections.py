"""Sections of the vane's report: its chapters and charts, and the overlays of a comparison."""

import tomllib
from string import ascii_lowercase
from typing import Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.cases.load import parse
from tribodyn.cases.units import UnitProblem, to_si
from tribodyn.core.errors import InputError
from tribodyn.papers.cheng_2022.reduced.case import VsvCase
from tribodyn.papers.cheng_2022.reduced.checks import CLEARANCE, WHOLE
from tribodyn.views import common
from tribodyn.views.bushing_sections import CONTACT_FORCE, ORBIT, PRESSURE, TILT
from tribodyn.views.charts import Chart, ChartCurve, ChartMarks, Panel
from tribodyn.views.common import Overlay, OverlayQuantity, scaled
from tribodyn.views.encode import packed
from tribodyn.views.energy_balance import balance_chart
from tribodyn.views.playback import at_frames, direction, magnification, playback_times, series
from tribodyn.views.section import OVER_TIME, Chapter, Payload, Section
from tribodyn.views.wear import WEAR_HISTORY, WEAR_MAP, WEAR_STAGES

MM: Final = 1e3


def case_of(dataset: xr.Dataset) -> VsvCase | None:
    """Return the case of a result; nothing where its text is not (or no longer) one of this mechanism."""
    try:
        case = parse(str(dataset.attrs.get("case", "")), "case of the result", {VsvCase.kind(): VsvCase})
    except InputError:
        return None
    return case if isinstance(case, VsvCase) else None


def crank_pivot(case: VsvCase) -> FloatArray:
    """Return the crank pivot A [mm], shape (3,)."""
    m = case.mechanism
    reach, gamma = m.pivot_distance, m.pivot_angle
    return MM * np.array([reach * np.cos(gamma), m.lever_length, reach * np.sin(gamma)])


def crank_tip(case: VsvCase, theta_a: FloatArray) -> FloatArray:
    """Return S1 = A + l_1 (−sin θ_a, 0, cos θ_a) [mm], shape (n, 3)."""
    arm = np.stack([-np.sin(theta_a), np.zeros_like(theta_a), np.cos(theta_a)], axis=1)
    return crank_pivot(case) + MM * case.mechanism.crank_length * arm


def ring_points(case: VsvCase, theta_b: float, h_1: float, angles: FloatArray) -> FloatArray:
    """Return points of the ring at angles from its pin [rad], in mm, shape (n, 3)."""
    m = case.mechanism
    beta = angles - theta_b
    height = np.full_like(beta, m.lever_length + h_1)
    return MM * np.stack([m.ring_radius * np.sin(beta), height, m.ring_radius * np.cos(beta)], axis=1)


def data(dataset: xr.Dataset) -> Payload | None:
    """Return points [mm], angles [rad] and the attitude of the trunnion [mm, rad] at the frames."""
    case = case_of(dataset)
    if case is None or playback_times(dataset).size < 2:
        return None
    joint = case.joint
    return {
        "size": {
            "ring_radius": case.mechanism.ring_radius * MM,
            "lever": case.mechanism.lever_length * MM,
            "vane": case.mechanism.vane_length * MM,
            "ring_angle": case.mechanism.ring_angle,
            "radius": joint.radius * MM,
            "length": joint.length * MM,
            "collar": joint.collar_radius * MM,
            "clearance": dataset.attrs["clearance"] * MM,
        },
        "magnification": magnification(joint.radius / dataset.attrs["clearance"]),
        "pivot": [float(value) for value in crank_pivot(case)],
        "crank_tip": packed(crank_tip(case, at_frames(dataset, "theta_a"))),
        **{name: packed(at_frames(dataset, name)) for name in ("theta_b", "theta_v", "phi_x", "phi_y")},
        **{name: packed(at_frames(dataset, name, MM)) for name in ("h_1", "e_x", "e_y")},
    }


SECTION: Final = Section(
    name="mechanism",
    title="The mechanism",
    caption=(
        "The crank pushes the drag link, which turns the unison ring; its pin swings the lever and with it "
        "the vane, whose trunnion turns in the bushing. Drag to turn it, or use the arrow keys."
    ),
    needs=("theta_a", "theta_b", "theta_v", "h_1", "e_x", "e_y", "phi_x", "phi_y"),
    widget="scene",
    data=data,
    still="mechanism",
)


DEG: Final = 180.0 / np.pi


def error(dataset: xr.Dataset) -> FloatArray:
    """Return actual minus ideal vane angle [°], shape (n_t,)."""
    return series(dataset, "theta_v", DEG) - series(dataset, "theta_v_ideal", DEG)


def errors(dataset: xr.Dataset) -> list[Panel]:
    """Return the errors of angle [°] and speed [°/s]."""
    speed = series(dataset, "omega_v", DEG) - series(dataset, "omega_v_ideal", DEG)
    return [
        Panel("angle error [°]", [ChartCurve("angle error", error(dataset))]),
        Panel("speed error [°/s]", [ChartCurve("speed error", speed)], smooth=True),
    ]


def branches(dataset: xr.Dataset) -> list[Panel]:
    """Return the angle error [°], the two directions apart."""
    off, sense = error(dataset), direction(dataset)
    forward = ChartCurve("forward, angle growing", np.where(sense > 0.0, off, np.nan), "blue")
    back = ChartCurve("reverse, angle falling", np.where(sense < 0.0, off, np.nan), "vermilion", "dash")
    return [Panel("angle error [°]", [forward, back])]


ERROR: Final = Chart(
    name="vane_error",
    title="Vane-angle error caused by the clearance",
    caption="Actual minus ideal: how far, and how unsteadily, clearance lets the vane stray from the drive.",
    needs=("theta_v", "theta_v_ideal", "omega_v", "omega_v_ideal"),
    panels=errors,
)
LOOP: Final = Chart(
    name="backlash",
    title="Vane-angle error over the vane position",
    caption=(
        "The distance between the forward and the reverse branch is the backlash that a controller would see."
    ),
    needs=("theta_v", "theta_v_ideal", "omega_v_ideal"),
    panels=branches,
    abscissa=lambda dataset: ("ideal vane angle [°]", series(dataset, "theta_v_ideal", DEG)),
)


def motions(dataset: xr.Dataset) -> list[Panel]:
    """Return angles [°], speeds [°/s] and drive moment [N m]."""
    return [
        Panel("angle [°]", [*_pair(dataset, "theta"), *_switch(dataset)], marks=_snapshots(dataset)),
        Panel("speed [°/s]", _pair(dataset, "omega")),
        Panel("drive moment\non the crank [N m]", [ChartCurve("drive moment", series(dataset, "M_d"))]),
    ]


def _pair(dataset: xr.Dataset, symbol: str) -> list[ChartCurve]:
    return [
        ChartCurve("vane", series(dataset, f"{symbol}_v", DEG), "blue"),
        ChartCurve("crank", series(dataset, f"{symbol}_a", DEG), "vermilion", "dash"),
    ]


def _switch(dataset: xr.Dataset) -> list[ChartCurve]:
    """Return the vane angle at which the air force changes its sign, where the motion passes it."""
    vane = series(dataset, "theta_v")
    try:
        loads = tomllib.loads(str(dataset.attrs["case"]))["loads"]
        angle = to_si(str(loads["switch_angle"]), "rad")
        acts = to_si(str(loads["air_force_x"]), "N") != 0.0
    except (KeyError, UnitProblem, tomllib.TOMLDecodeError):
        return []
    if not (acts and np.nanmin(vane) < angle < np.nanmax(vane)):
        return []
    return [ChartCurve("air force changes sign", np.full(vane.shape, angle * DEG), "grey", "dot", 1.0)]


def _snapshots(dataset: xr.Dataset) -> ChartMarks | None:
    """Return the times of the pressure snapshots, with the letters of that figure."""
    if "snapshot_time" not in dataset:
        return None
    times, angles = series(dataset, "snapshot_time"), series(dataset, "snapshot_theta_v", DEG)
    return ChartMarks(times, angles, tuple(ascii_lowercase[: times.size]))


MOTION: Final = Chart(
    name="motion",
    title="Drive and vane motion",
    caption=(
        "Where the crank drives the vane, how fast, and the moment this takes. "
        "Letters mark the positions of the pressure snapshots, the dotted line the vane angle at which the "
        "air force along X changes its sign."
    ),
    needs=("theta_a", "theta_v", "omega_a", "omega_v", "omega_v_ideal", "M_d"),
    panels=motions,
)


def _clearance(dataset: xr.Dataset) -> list[Panel]:
    """Return the radial clearance [µm]."""
    return [
        Panel("clearance [µm]", [ChartCurve("radial clearance", series(dataset, "radial_clearance", 1e6))])
    ]


WARMING: Final = Chart(
    name="clearance",
    title="Clearance over time",
    caption="Radial clearance at the temperatures of trunnion, bushing and casing.",
    needs=("radial_clearance",),
    panels=_clearance,
)


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
CHARTS: Final = (ERROR, LOOP, CONTACT_FORCE, TILT, MOTION, WARMING, _WHOLE, _CLEARANCE)
#: Chapters in reading order.
CHAPTERS: Final = (
    Chapter(
        "playback",
        "One cycle",
        "Everything in this part shows the same moment. Move the slider, or press play.",
        (SECTION, ORBIT.section, PRESSURE),
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
        (OverlayQuantity("angle error [°]", ("theta_v", "theta_v_ideal"), error),),
    ),
    *common.BUSHING,
    Overlay("drive", "Drive moment", (scaled("M_d", "drive moment [N m]", 1.0),)),
)
