"""Check that a mechanism can follow its drives through the cycle, before it runs.

Bodies follow the drives step by step, each time by the shortest displacement. In a run, forces decide on the
degrees of freedom that drives leave; so with such freedoms several paths are tried before a mechanism is
refused.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from tribodyn.core.remembered import Remembered, digest
from tribodyn.kernels.mechanism.data import ANGLE
from tribodyn.mechanism.assembly.assembly import Assembly
from tribodyn.mechanism.assembly.closing import CLOSES, System
from tribodyn.mechanism.assembly.misfit import Misfit, described
from tribodyn.mechanism.assembly.parts_by_number import ModelError

_TURN: Final = 0.1  #: Largest change of a drive in one step, in radians or units of the size.
_FEWEST: Final = 50  #: Least number of steps of a run.
#: Largest number of steps, some eight turns; what comes later has come before, or a run finds it.
_MOST: Final = 500
_PARTS: Final = 8  #: Parts of a step that bodies are led through where they cannot make it at once.
_CORRECTIONS: Final = 20  #: Steps of Newton's method in which bodies that are near must close.
_WAYS: Final = 4  #: Largest number of branches that are tried where freedoms are left.

#: Digests of the last mechanisms that could follow their drives, with their start and duration.
_passed: Final[Remembered[None]] = Remembered(32)

#: Moves the bodies to where the joints close at the system's time; returns whether they do.
Close = Callable[[], bool]


@dataclass(frozen=True)
class Passage:
    """Result of following the drives through a cycle."""

    finding: ModelError | None = None  #: What forbids a run, if anything does.
    time: float = 0.0  #: When [s].
    warning: str = ""  #: Which clearances must take a misfit of the ideal joints; empty for none.


def drive_through(assembly: Assembly, duration: float) -> Passage:
    """Follow the drives through their cycle with ideal joints; where those forbid it, with clearances.

    At most some eight turns of a run of ``duration`` [s] are looked at.
    """
    if not assembly.model.has_loops:
        return Passage()
    ideal = assembly.model.counterpart
    stuck: tuple[float, ModelError] | None = (
        (0.0, assembly.findings_if_ideal[0]) if assembly.findings_if_ideal else None
    )
    if stuck is None:
        system = placed(System(ideal, data=assembly.ideal_data), assembly)
        stuck = _stuck_anew(system, assembly.ideal_rank, duration)
    if stuck is None:
        return Passage()
    time, finding = stuck
    misfit = Misfit(assembly.model, placed(System(ideal), assembly))
    if misfit.possible and _led(misfit.system, duration, misfit.close) is None:
        needed = described(misfit.shares) or "none to speak of"
        warning = f"clearances must take a misfit, for with ideal joints {finding.text}; share of clearance "
        return Passage(warning=f"{warning}needed: {needed}")
    return Passage(finding, time)


def placed(system: System, assembly: Assembly) -> System:
    """Put the bodies of a system where they are at the start, or next to it where joints deviate."""
    system.adopt(assembly.state)
    if assembly.model.in_place is not assembly.model:
        system.close()
    return system


def _stuck_anew(system: System, rank: int, duration: float) -> tuple[float, ModelError] | None:
    """Return the same as :func:`_stuck`; mechanisms that were not stuck are not led through again.

    Cases that differ in clearances, surfaces or loads have the same ideal joints and drives.
    """
    bodies, angles = system.position()
    here = digest(system.data, bodies.r, bodies.p, angles, rank, duration)
    if here in _passed:
        return None
    found = _stuck(system, rank, duration)
    if found is None:
        _passed.add(here, None)
    return found


def _stuck(system: System, rank: int, duration: float) -> tuple[float, ModelError] | None:
    """Return the time at which joints no longer close on any branch, with the finding, or None."""
    if not system.drive_rows():
        return None
    system.set_rank(rank)
    start, found = system.position(), None
    chance = np.random.default_rng(1)
    for way in range(_WAYS if 6 * system.n > rank else 1):
        system.restore(start)

        def close(wander: bool = way > 0) -> bool:
            return closes(system) and (not wander or _wanders(system, chance))

        time = _led(system, duration, close)
        if time is None:
            return None
        found = found or (time, _finding(system, time))
    return found


def closes(system: System) -> bool:
    """Close all joints, by the compiled solution or else thoroughly."""
    kept = system.position()
    if system.close_fast() <= CLOSES:
        return True
    system.restore(kept)
    return system.close(_CORRECTIONS) <= CLOSES


def _wanders(system: System, chance: np.random.Generator) -> bool:
    """Go elsewhere in the freedoms that are left, as far as joints close there."""
    kept = system.position()
    if not system.wander(chance) or system.gap() > CLOSES:
        system.restore(kept)
    return True


def _led(system: System, duration: float, close: Close) -> float | None:
    """Lead the bodies through the drives' motion; return when they cannot follow, None if they can."""
    system.t, kinks = 0.0, system.data.signals.kinks
    for _ in range(_MOST):
        begin = system.t
        later = kinks[kinks > begin]
        step = min(duration / _FEWEST, system.time_to_move(_TURN))
        end = float(min(begin + step, duration, *later[:1]))
        if not _reached(system, begin, end, close):
            return end
        if end >= duration:
            break
    return None


def lead(system: System, time: float, close: Close) -> bool:
    """Lead the bodies from where the system's time is to another one [s]; return whether joints close."""
    while system.t != time:
        begin, step = system.t, system.time_to_move(_TURN)
        end = time if abs(time - begin) <= step else begin + math.copysign(step, time - begin)
        if not _reached(system, begin, end, close):
            return False
    return True


def _reached(system: System, begin: float, end: float, close: Close) -> bool:
    """Lead the bodies from one time to another, at once or else in parts."""
    kept = system.position()
    system.at(end)
    if close():
        return True
    system.restore(kept)
    closed = False
    for part in range(1, _PARTS + 1):
        system.at(begin + (end - begin) * part / _PARTS)
        closed = close()
    return closed


def _finding(system: System, time: float) -> ModelError:
    """Return the joint that does not close at a time, and the positions of the drives then."""
    system.close()
    finding = system.open_joint()
    return ModelError(finding.key, f"at t = {time:.4g} s, with {where_drives_are(system)}, {finding.text}")


def where_drives_are(system: System) -> str:
    """Return the positions of the drives at the time of a system, in words."""
    return " and ".join(_where(system, *row) for row in system.drive_rows())


def _where(system: System, coupling: int, row: int, name: str) -> str:
    """Return the position of a drive in words."""
    value = float(system.now.couplings[coupling].prescribed[row, 0])
    value *= system.model.joint(coupling).sign
    if system.parts.couplings[coupling].row_kind[row] == ANGLE:
        return f"drive {name} at {math.degrees(math.remainder(value, 2.0 * math.pi)):.4g}°"
    return f"drive {name} at {1e3 * value:.4g} mm"
