"""Tables of counts from the stored benchmarks."""

from __future__ import annotations

from typing import Final

from tables.benchmarks import SOURCE
from tables.markdown import Found, Lines, head, row, stored

#: Variants of the mechanism by their names in the store, as the page calls them.
VARIANTS: Final = {
    "as it is": "default",
    "no clip": "total pressure may be tensile: no cut-off",
    "entry velocity v_min, for ever": "entry velocity $v_{min}$ everywhere and always",
    "no memory: |approach| of the moment": "no memory: the approach speed at each instant",
    "no moment of the collar": "no moment of the collar",
    "air force switched over 10 times the angle": "air force switched over 10 times the angle",
    "traction developed at 100 times the slip": "traction developed at 100 times the slip",
    "friction as a moment": "friction as a moment",
    "no clip, v_min, no collar, wide switches": "no cut-off, $v_{min}$, no collar, wide switches",
}


def kinks(found: Found) -> Lines:
    """Give the steps of the vane mechanism with one thing changed at a time."""
    yield from head("", "steps", "evaluations", "steps in 50 ms after reversals", "later than 100 ms")
    for name, title in VARIANTS.items():
        counts = (found["kinks"][name][what] for what in ("steps", "evaluations", "steps to 50 ms", "later"))
        yield row(title, *(f"{count:.0f}" for count in counts))


def machines(found: Found) -> Lines:
    """Give how the runs of random machines ended."""
    kinds = [found["random_machines"][name] for name in ("MECHANISM", "UNDAMPED", "DRY")]
    yield from head("", "mechanisms", "without damping", "dry journals")
    yield row("simulated", *(str(kind["machines"]) for kind in kinds))
    for title, name in (
        ("reached their end, all energy residuals below 1 %", "sound"),
        ("reached their end and warned that energy is missed", "warned"),
        ("of these below 1 % once the advice was followed", "closed at once"),
        ("of these below 1 % once it was followed twice", "closed at the second time"),
        ("of these not below 1 % after that", "not closed"),
        ("stopped, with the reason", "stopped"),
    ):
        yield row(title, *(str(kind[name]) for kind in kinds))
    for title, name, scale, unit in (
        ("residual of the whole system", "energy_residual", 100.0, "%"),
        ("residual of the clearance motion", "clearance_energy_residual", 100.0, "%"),
        ("computing time of a run", "seconds", 1.0, "s"),
    ):
        yield row(
            f"{title}: median, 99 %, largest", *(_quantiles(kind.get(name), scale, unit) for kind in kinds)
        )


def bulk(found: Found) -> Lines:
    """Give how elastic bodies change random machines."""
    kinds = [found["random_machines"]["bulk"][name] for name in ("MECHANISM", "ELASTIC", "LOSSY")]
    yield from head("", "by default", '`"conformal"`', "as lossy as asperities")
    for name in ("machines", "stopped with rigid bodies", "stopped with elastic bodies", "sound with both"):
        yield row(name.replace("elastic", "these"), *(str(kind[name]) for kind in kinds))
    for title, name in (
        ("mean contact force", "contact_force_mean_N"),
        ("sustained contact force", "contact_force_sustained_N"),
        ("peak contact force", "contact_force_max_N"),
        ("rms error of the vane angle", "error_rms_deg_vane"),
    ):
        changes = [kind[name] for kind in kinds]
        yield row(f"{title}: within 1 %", *(str(one["within 1 %"]) for one in changes))
        ends = ([100.0 * one[end] for end in ("median", "95 %")] for one in changes)
        yield row(
            f"{title}: median of its change, 95 %", *(f"{change(low)}, {change(high)}" for low, high in ends)
        )


def change(percent: float) -> str:
    """Return a change with two digits and its sign, never as a power of ten."""
    return f"{float(f'{percent:.2g}'):+g} %"


#: How a run ends that is stopped before its first position.
STOPPED: Final = "refused: stopped before anything was computed; nothing was saved"
HELD: Final = "along a freedom that no joint, drive or spring holds"


def statics(found: Found) -> Lines:
    """Give how static analyses of random machines ended, and how far they are from dynamic runs."""
    measured = found["static_machines"]
    ended = measured["static"]
    ratio = measured["static over dynamic"]
    yield from head("", "mechanisms")
    yield row("drawn", str(measured["machines"]))
    yield row("of these with no clearance", str(ended["no clearance"]))
    for title, name in (
        ("complete static analysis", "complete"),
        ("refused: a freedom that nothing holds", HELD),
        ("refused: a shaft outside its bore", "out of its bore"),
        ("refused: no rest in ideal joints either", "with ideal joints, too, no position at rest was found"),
        ("refused: a search without an end", "did not converge"),
        ("stopped by the benchmark after 2 s of processor time", "interrupted"),
        ("stopped before the first position", STOPPED),
    ):
        yield row(title, str(ended.get(name, 0)))
    yield row("compared with a dynamic run", str(measured["compared"]))
    for part in (1, 5, 20, 50):
        yield row(f"rms errors within {part} % of each other", str(measured[f"within {part} %"]))
    yield row("static over dynamic rms error: median", f"{ratio['median']:.3f}")
    yield row("static over dynamic rms error: largest", f"{ratio['largest']:.1f}")


def loops(found: Found) -> Lines:
    """Give how comparisons of static loops with slow runs ended, and how far they are from each other."""
    measured = found["static_loops"]
    ended = measured["ended"]
    stopped = sum(ended.get(f"static: {words}", 0) for words in ("interrupted", STOPPED))
    yield from head("", "mechanisms")
    yield row("drawn", str(measured["machines"]))
    yield row("of these with no clearance", str(ended["no clearance"]))
    yield row("statics stopped by the benchmark after 60 s of processor time", str(stopped))
    for title, name in (
        ("statics refused: a freedom that nothing holds", f"static: {HELD}"),
        ("statics refused: a shaft outside its bore", "static: out of its bore"),
        ("statics refused: a search without an end", "static: did not converge"),
        ("no slow run within 60 s", "no slow run"),
        ("bodies begin elsewhere along a freedom that friction holds", "elsewhere along a freedom"),
        ("slow runs differ among themselves", "slow runs differ"),
        ("moments of inertia change the loop", "inertia decides"),
        ("compared", "complete"),
    ):
        yield row(title, str(ended.get(name, 0)))
    yield row("widths within 2 % of their mean", str(measured["within 2 %"]))
    yield row("difference of widths: median", f"{100 * measured['difference']['median']:.2g} %")
    yield row("difference of widths: largest", f"{100 * measured['difference']['largest']:.2g} %")


def _quantiles(values: dict[str, float] | None, scale: float, unit: str) -> str:
    if values is None:
        return "–"
    return ", ".join(f"{scale * values[name]:.1g} {unit}" for name in ("median", "99 %", "largest"))


#: Tables by name.
TABLES: Final = {
    "kinks": stored(SOURCE, kinks),
    "random": stored(SOURCE, machines),
    "bulk": stored(SOURCE, bulk),
    "statics": stored(SOURCE, statics),
    "loops": stored(SOURCE, loops),
}
