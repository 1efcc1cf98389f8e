"""Loops and an earthquake of a friction damper with play, from a fit to one loop of each mounting."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.studies.least_squares import FitParameter, fit
from tribodyn.validation.base import Comparison, Curve, Outcome, Plot, rms
from tribodyn.validation.catalogue import ValidationSet

#: Play [mm], stiffness of take-up [kN/mm], friction forces while the rod moves up and down [kN].
PARAMETERS: Final = (
    FitParameter("play", 0.5, 10.0),
    FitParameter("stiffness", 1.0, 20.0),
    FitParameter("plus", 1.0, 30.0),
    FitParameter("minus", 1.0, 30.0),
)
JULY: Final = ("20", "35", "80")  #: Band tensions of July [lb].
FITTED: Final = "loop_0p5Hz_35lb.csv"
#: Loop that is fitted, loop of half the amplitude that is predicted, and its name.
APRIL: Final = (
    ("april_set2_30lb_0p25Hz_1in.csv", "april_set2_30lb_0p25Hz_0p5in.csv", "set 2"),
    ("april_set3_30lb_0p25Hz_1in.csv", "april_set3_30lb_0p5Hz_0p5in.csv", "set 3"),
)
STRONG: Final = "april_set2_36lb_0p25Hz_1in.csv"
EARTHQUAKE: Final = "earthquake_ImperialValleyDBE.csv"
#: Places in the play at the start of the earthquake, over the play.
STARTS: Final = (-0.5, -0.25, 0.0, 0.25, 0.5)
_OUTWARD: Final = (0.2, 0.85)  #: Part of the amplitude over which a plateau is the mean force.


@dataclass(frozen=True)
class DamperRecord:
    """A measured force over displacement; of a loop one cycle, its first row again at the end."""

    #: Shapes (n,) [s], [mm], [kN].
    time: FloatArray
    displacement: FloatArray
    force: FloatArray

    @property
    def energy(self) -> float:
        """Energy of a loop [J]."""
        return float(np.trapezoid(self.force, self.displacement))

    @property
    def amplitude(self) -> float:
        """Half the range of the displacement [mm]."""
        return 0.5 * float(np.ptp(self.displacement))

    @property
    def plateaus(self) -> dict[str, float]:
        """Sizes of the mean forces while the rod moves outward [kN]."""
        place = self.displacement - 0.5 * (self.displacement.max() + self.displacement.min())
        way = np.gradient(self.displacement)
        found = {}
        for name, sign in (("plus", 1.0), ("minus", -1.0)):
            low, high = (end * self.amplitude for end in _OUTWARD)
            there = (sign * place > low) & (sign * place < high) & (sign * way > 0.0)
            found[name] = sign * float(self.force[there].mean())
        return found

    def travel(self, sign: float) -> float:
        """Return the travel after a reversal until the force is half of the next plateau [mm]."""
        half = 0.5 * self.plateaus["minus" if sign > 0.0 else "plus"]
        begin = int(np.argmax(sign * self.displacement[:-1]))
        moved = np.roll(self.displacement[:-1], -begin)
        reached = -sign * np.roll(self.force[:-1], -begin) >= half
        after = int(np.argmax(reached))
        force = -sign * np.roll(self.force[:-1], -begin)[after - 1 : after + 1]
        place = float(np.interp(half, force, moved[after - 1 : after + 1]))
        return sign * (float(moved[0]) - place)

    def overshoot(self, sign: float) -> float:
        """Return the largest force in a direction over its plateau [1]."""
        return float((sign * self.force).max()) / self.plateaus["plus" if sign > 0.0 else "minus"]


def loop(one: ValidationSet, file: str) -> DamperRecord:
    """Return a loop of the set."""
    phase, displacement, force = one.columns(file, "phase_of_cycle", "displacement_mm", "force_kN")
    period = 4.0 if "0p25Hz" in file else 2.0
    closed = (np.append(values, values[0]) for values in (displacement, force))
    return DamperRecord(period * np.append(phase, 1.0), *closed)


def earthquake(one: ValidationSet) -> DamperRecord:
    """Return the record of the earthquake."""
    time, displacement, force = one.columns(EARTHQUAKE, "time_s", "displacement_mm", "force_kN")
    return DamperRecord(time - time[0], displacement, force)


def computed(
    given: Mapping[str, float], record: DamperRecord, *, start: float = 0.0, cyclic: bool = True
) -> DamperRecord:
    """Return the force on the rod over the displacement of a record; of a loop that of the second cycle.

    ``given``: values of :data:`PARAMETERS`; ``record``: its displacement drives the rod; ``start``: place of
    the rod in the play at the start, over the play; ``cyclic``: whether the record is a loop.
    """
    n, period = record.time.size, float(record.time[-1])
    times = np.append(record.time, period + record.time[1:]) if cyclic else record.time
    places = np.append(record.displacement, record.displacement[1:]) if cyclic else record.displacement
    changes = {
        "stops.ahead.position": f"{(0.5 - start) * given['play']} mm",
        "stops.behind.position": f"{(-0.5 - start) * given['play']} mm",
        **{f"stops.{name}.stiffness": f"{given['stiffness']} kN/mm" for name in ("ahead", "behind")},
        "frictions.band.normal_load": f"{0.5 * (given['plus'] + given['minus'])} kN",
        "loads.one_sided.force": f"{-0.5 * (given['plus'] - given['minus'])} kN",
        "drives.actuator.position.times": f"{', '.join(map(repr, times.tolist()))} s",
        "drives.actuator.position.values": f"{', '.join(map(repr, places.tolist()))} mm",
        "run.duration": f"{times[-1]} s",
        "run.output_interval": f"{period / (n - 1)} s",
    }
    run = ValidationSet("friction_damper_backlash").simulated("damper.toml", changes)
    force = np.interp(times[-n:], run["time"].values, run["drive_force"].values[:, 0] * 1e-3)
    return DamperRecord(record.time, record.displacement, force)


@cache
def fitted(one: ValidationSet, file: str) -> dict[str, float]:
    """Return play, stiffness and friction forces fitted to a loop."""
    record = loop(one, file)
    start = {"play": 5.0, "stiffness": 6.0, **record.plateaus}
    found = fit(
        lambda given: computed(given, record).force - record.force,
        PARAMETERS,
        start=start,
        step=1e-3,
        tolerance=1e-4,
    )
    return found.named


def compare(one: ValidationSet) -> Outcome:
    """Return energies, travels and the error of the earthquake."""
    rows = [*_july(one), *_april(one), *earthquake_rows(one)]
    return Outcome(tuple(rows), _plot(one))


def _rectangle(record: DamperRecord) -> float:
    """Return the energy of a loop without play and without take-up [J]."""
    return 2.0 * record.amplitude * sum(record.plateaus.values())


def _july(one: ValidationSet) -> list[Comparison]:
    """Return energies and travels at three tensions, with play and take-up fitted at one of them."""
    rows, given = [], fitted(one, FITTED)
    for tension in JULY:
        record = loop(one, f"loop_0p5Hz_{tension}lb.csv")
        found = computed(given | record.plateaus, record)
        name = f"July, {tension} lb"
        band = one.bands["own"]
        null = _rectangle(record)
        rows.append(Comparison(f"{name}, energy", "J", found.energy, record.energy, null=null, band=band))
        elastic = sum(record.plateaus.values()) / given["stiffness"]
        for way, sign in (("upper", 1.0), ("lower", -1.0)):
            label = f"{name}, travel to half of the plateau after the {way} reversal"
            values = found.travel(sign), record.travel(sign)
            rows.append(Comparison(label, "mm", *values, null=elastic, band=one.bands["travel"]))
        label = f"{name}, largest force over the plateau after the lower reversal"
        note = "The model has no overshoot; neither the closing gap nor friction at rest gives it."
        over = found.overshoot(1.0), record.overshoot(1.0)
        rows.append(Comparison(label, "", *over, null=1.0, note=note))
    return rows


def _april(one: ValidationSet) -> list[Comparison]:
    """Return energies at half the amplitude: with own plateaus, with fitted forces, and without play."""
    rows = []
    for known, file, name in APRIL:
        given, record = fitted(one, known), loop(one, file)
        own, same = computed(given | record.plateaus, record), computed(given, record)
        without = computed(given | {"play": 1e-3}, record)
        null = _rectangle(record)
        for label, found, band in (("own plateaus", own, "own"), ("fitted forces", same, "fitted")):
            label = f"April, {name}, half the amplitude, energy with {label}"
            limits = one.bands[band]
            rows.append(Comparison(label, "J", found.energy, record.energy, null=null, band=limits))
        rows.append(
            Comparison(
                f"April, {name}, half the amplitude, energy without play",
                "% of the measured",
                100.0 * without.energy / record.energy,
                100.0,
                null=100.0 * null / record.energy,
                band=one.bands["without_play"],
            )
        )
    return rows


def earthquake_rows(one: ValidationSet) -> list[Comparison]:
    """Return the error of the force over that without play, and the energy."""
    record, given = earthquake(one), fitted(one, STRONG)
    trials = [computed(given, record, start=start, cyclic=False) for start in STARTS]
    without = computed(given | {"play": 1e-3}, record, cyclic=False)
    errors = [rms(run.force - record.force) for run in (*trials, without)]
    best = int(np.argmin(errors[:-1]))
    error = Comparison(
        "earthquake, error of the force over that without play",
        "",
        errors[best] / errors[-1],
        null=1.0,
        band=one.bands["earthquake"],
        note=f"Root mean square errors {errors[best]:.2f} and {errors[-1]:.2f} kN.",
    )
    energy = Comparison(
        "earthquake, energy", "J", trials[best].energy, record.energy, null=without.energy,
        note="The null model is the same damper without play.",
    )  # fmt: skip
    return [error, energy]


def _plot(one: ValidationSet) -> Plot:
    curves = []
    for tension in JULY:
        record = loop(one, f"loop_0p5Hz_{tension}lb.csv")
        found = computed(fitted(one, FITTED) | record.plateaus, record)
        place = record.displacement
        curves.append(Curve(f"{tension} lb, measured", "measured", place[::4], record.force[::4]))
        curves.append(Curve(f"{tension} lb, computed", "computed", place, found.force))
    return Plot("displacement [mm]", "force [kN]", tuple(curves))
