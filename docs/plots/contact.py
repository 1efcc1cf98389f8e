"""Draw the figures of the contact page: laws, restitution, and the vane mechanism under every law.

python docs/plots/contact.py OUTPUT_DIRECTORY
"""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr

import tribodyn as td
from tribodyn.contact import DAMPING_FACTORS, LAWS, RSDC, law, tabulate
from tribodyn.contact.bounce import bounce
from tribodyn.core.errors import InputError
from tribodyn.joints import CONTACTS, SURFACE
from tribodyn.papers.cheng_2022.reduced.case import VsvCase

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#8c564b")
STYLES = ("-", "--", "-.", ":")
RESTITUTION = 0.7
REVERSAL = np.pi
DURATION = "4.5 s"


def style(k: int) -> dict[str, object]:
    """Return colour and line style of the k-th curve: other ones for each of 32."""
    again, colour = divmod(k, len(COLOURS))
    return {"color": COLOURS[colour], "linestyle": STYLES[(colour + again) % len(STYLES)]}


def draw_laws(case: VsvCase, target: Path) -> None:
    """Pressure, real contact area and number of contacts over the separation."""
    h_star = np.linspace(-1.0, 4.0, 251)
    figure, panels = plt.subplots(1, 3, figsize=(12, 3.8), layout="constrained")
    for k, name in enumerate(LAWS):
        if name == RSDC.name:
            continue  # its stiffness is that of ke
        chosen = law(name, case)
        curves = (
            chosen.stiffness_pressure(h_star) / 1e6,
            100.0 * chosen.real_area_fraction(h_star),
            chosen.contact_count(h_star) / 1e6,
        )
        for axes, values in zip(panels, curves, strict=True):
            axes.semilogy(h_star, values, label=name, **style(k))
    labels = ("pressure [MPa]", "real contact area [%]", "contacts [1/mm²]")
    for axes, label in zip(panels, labels, strict=True):
        axes.set(xlabel="separation h* = h/σ", ylabel=label)
        axes.grid(alpha=0.3)
    panels[0].set_ylim(1e-3, 1e5)
    panels[0].axhline(case.surfaces.bushing.hardness / 1e6, color="0.5", linewidth=0.8)
    panels[0].text(
        4.0, case.surfaces.bushing.hardness / 1e6, "hardness", va="bottom", ha="right", color="0.4"
    )
    panels[1].axhline(100.0, color="0.5", linewidth=0.8)
    panels[0].legend(fontsize=8)
    figure.savefig(target / "contact_laws.png", dpi=130)


def draw_restitution(case: VsvCase, target: Path) -> None:
    """Restitution realised over the one wanted: a point, and a plate on the surfaces of the case."""
    wanted = np.linspace(0.05, 1.0, 96)
    sparse = np.array([0.1, 0.3, 0.5, 0.7, 0.9])
    figure, panels = plt.subplots(1, 3, figsize=(12.5, 4.1), layout="constrained", sharey=True)
    for k, (name, factor) in enumerate(DAMPING_FACTORS.items()):
        if name == "none":
            continue
        panels[0].plot(wanted, factor.realised(wanted), label=name, **style(k))
        for axes, which in zip(panels[1:], ("ke", "rsdc"), strict=True):
            realised = [plate(case, which, name, e) for e in sparse]
            axes.plot(sparse, realised, marker="o", markersize=4, **style(k))
    titles = ("point: K δⁿ (1 + a v/v₀)", "plate, law ke", "plate, law rsdc with e given")
    for axes, title in zip(panels, titles, strict=True):
        axes.plot([0, 1], [0, 1], color="0.6", linewidth=0.8, zorder=0)
        axes.set(xlabel="restitution wanted", title=title, xlim=(0, 1), ylim=(0, 1))
        axes.grid(alpha=0.3)
    panels[0].set_ylabel("restitution realised")
    panels[0].legend(fontsize=8)
    figure.savefig(target / "contact_restitution.png", dpi=130)


def plate(case: VsvCase, name: str, factor: str, restitution: float) -> float:
    """Return the restitution of the bounce test."""
    chosen = law(name, case, damping_factor=factor, restitution=restitution)
    return bounce(tabulate(chosen)).restitution


def run(changes: dict[str, object]) -> xr.Dataset | None:
    """Simulate the built-in case with some changes; None if its loads are more than the contact can carry."""
    case = td.load_case("vsv").replace({"run.duration": DURATION, **changes})
    try:
        return td.simulate(case)
    except InputError as problem:
        print(f"{changes}: {problem}")
        return None


def draw_mechanism(results: dict[str, xr.Dataset], target: Path, name: str, *, pressure: bool) -> None:
    """Path of the trunnion's upper end, vane-angle error, force after the reversal, and peak pressure."""
    figure, panels = plt.subplots(1, 4 if pressure else 3, figsize=(16 if pressure else 12.5, 4.0))
    figure.set_layout_engine("constrained")
    for k, (label, result) in enumerate(results.items()):
        half = 0.5 * result.attrs["joint_length"]
        x = 1e6 * (result["e_x"] - half * np.tan(result["phi_y"]))
        y = 1e6 * (result["e_y"] - half * np.tan(result["phi_x"]))
        time = result["time"]
        error = np.rad2deg(result["theta_v"] - result["theta_v_ideal"])
        force = np.hypot(result["F_cx"], result["F_cy"])
        near = (time > REVERSAL - 0.002) & (time < REVERSAL + 0.015)
        panels[0].plot(x, y, linewidth=0.8, **style(k))
        panels[1].plot(time, error, linewidth=1.0, label=label, **style(k))
        panels[2].plot(1e3 * (time[near] - REVERSAL), force[near], linewidth=0.9, **style(k))
        if pressure:
            panels[3].semilogy(time, result["p_max"] / 1e6, linewidth=1.0, **style(k))
    clearance = 1e6 * next(iter(results.values())).attrs["clearance"]
    panels[0].add_patch(plt.Circle((0, 0), clearance, fill=False, color="0.5"))
    reach = 1.2 * clearance
    panels[0].set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal")
    panels[0].set(xlabel="X of the upper end [µm]", ylabel="Y of the upper end [µm]")
    panels[1].set(xlabel="time [s]", ylabel="vane-angle error [°]")
    panels[2].set(xlabel="time after the reversal [ms]", ylabel="contact force [N]")
    panels[1].legend(fontsize=8)
    if pressure:
        panels[3].set(xlabel="time [s]", ylabel="peak pressure [MPa]")
    for axes in panels:
        axes.grid(alpha=0.3)
    figure.savefig(target / name, dpi=130)


def tell(label: str, result: xr.Dataset) -> None:
    """Print the numbers that the page quotes."""
    time = result["time"]
    smooth = result.isel(time=((time > 0.2) & (time < REVERSAL - 0.05)).values)
    error = np.rad2deg(float(abs(smooth["theta_v"] - smooth["theta_v_ideal"]).max()))
    force = float(np.hypot(smooth["F_cx"], smooth["F_cy"]).mean())
    pressure = float(smooth["p_max"].mean()) / 1e6
    print(
        f"{label}: error {error:.5f} deg, mean force {force:.2f} N, "
        f"peak force {float(result['contact_force_impact'].max()):.1f} N, "
        f"pressure {pressure:.1f} MPa, at most {float(result['pressure_impact'].max()) / 1e6:.1f} MPa, "
        f"least separation {result.attrs['separation_least'] / result.attrs['roughness']:.2f} sigma"
    )


def main() -> None:
    """Draw all figures."""
    target = Path(sys.argv[1])
    target.mkdir(parents=True, exist_ok=True)
    plt.switch_backend("agg")
    case = td.load_case("vsv")
    assert isinstance(case, VsvCase)
    draw_laws(case, target)
    draw_restitution(case, target)
    damped = {"contact.damping_factor": "calibrated", "contact.restitution": RESTITUTION}
    under_laws = {name: run({"contact.law": name, **damped}) for name in LAWS}
    under_contacts = {name: run({"joint.contact": name}) for name in CONTACTS if name != SURFACE}
    results = {SURFACE: run({}), **under_contacts}
    for file, members in (("contact_vsv_laws.png", under_laws), ("contact_vsv_point.png", results)):
        done = {label: result for label, result in members.items() if result is not None}
        draw_mechanism(done, target, file, pressure=members is under_laws)
        for label, result in done.items():
            tell(label, result)


if __name__ == "__main__":
    main()
