"""Start of a mechanism with clearance: its shafts laid against their sockets, with balanced loads.

Bodies move as those of the mechanism whose joints are ideal do at that time, and are displaced within the
clearances until contact gives what that motion asks of the joints, by
:mod:`tribodyn.mechanism.assembly.equilibrium`. Freedoms of the mechanism as a whole are left to themselves.
"""

import math
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.mechanism.assembly.assembly import Assembly
from tribodyn.mechanism.assembly.closing import System
from tribodyn.mechanism.assembly.decompositions import shortest
from tribodyn.mechanism.assembly.equilibrium import JointLoads
from tribodyn.mechanism.assembly.shaft_motions import applied, length
from tribodyn.mechanism.assembly.start_speeds import speeds_of


def initial_state(assembly: Assembly) -> FloatArray | None:
    """Return the state in which the loads on all shafts balance, shape (13 n,); None if none is found.

    Without clearance it is that of the assembly. So it is of joints with an oil film, which carries by motion
    alone: they begin in the middle of their bores. Raises ``Stopped`` if the caller wanted to stop before.
    """
    if not assembly.model.without_films.yields:
        return assembly.state
    ideal = System(assembly.model.counterpart, data=assembly.ideal_data)
    ideal.adopt(assembly.state)
    ideal.close()
    loads = JointLoads(assembly, ideal, speeds_of(assembly.model))
    # Displaced within their clearances, bodies stay where as many constraints are independent.
    loads.ideal.known_rank, loads.real.known_rank = loads.ideal.rank(), loads.real.rank()
    return settled(loads)


_MOST_LOOKS: Final = 20
_NEARS: Final = 0.7  #: Changes in one look over those in the one before that lead to an end by themselves.
#: Looks after which stiffness is found by looking, unless changes fall so: a vanishing force gives little.
_PLAIN_LOOKS: Final = 8
#: Searches in a row without an end before freedoms take part and stiffness is looked for; half of the most.
_PATIENT: Final = 3
_HOPELESS: Final = 1.0  #: Load left, over all loads, with which they are enough: nothing is near.
_MOST_STEPS: Final = 100
_FEWER_STEPS: Final = 40  #: The same where friction may turn less sharply.
_SETTLED: Final = 1.0e-3  #: Change of a gap, over the roughness, that counts as zero.
_BALANCED: Final = 1.0e-6  #: Load over the largest one met on the way that counts as zero.
_LEAST: Final = 1.0  #: Stiffness of springs where there is no contact yet [N/m].
_FLOOR: Final = 1.0e-6  #: The same over the largest stiffness.
#: The same once a search has not ended: beams are that much softer in bending, joints than press fits.
_LOW_FLOOR: Final = 1.0e-10
_STIFFER: Final = 4.0
_SOFTER: Final = 3.0  #: Factors by which springs change.
_BACK: Final = 0.5  #: Share of the load along a step that may have turned against it.
_NEARER: Final = 4.0  #: Factor by which bodies that do not come to rest count as near from look to look.
#: Change of gaps over the roughness after which the possible motions are the same, freedoms aside.
_SAME: Final = 1.0e-2
_FAR: Final = 0.5  #: Part of the largest gap of a joint that a step may not pass.
_SHORT: Final = 0.1  #: Longest step along freedoms, turns [rad] and lengths over the size of the mechanism.
_FINE: Final = 1.0e-4  #: Step along freedoms, in the same units, that counts as the roughness.


def settled(loads: JointLoads, *, change: float = _SETTLED, near: float = 0.0) -> FloatArray | None:
    """Move the bodies from where the search begins to where their loads balance; return the state, or None.

    A change of gaps below ``change`` over the roughness counts as zero; after one below ``near``, which grows
    from look to look, the possible motions are not looked for again.
    """
    soft, quiet, unended, last, nearer = 0.0, False, 0, math.inf, False
    floor = _LOW_FLOOR if near and (loads.bends or loads.blurs) else _FLOOR
    for look in range(_MOST_LOOKS):
        if near and (unended >= _PATIENT or (look >= _PLAIN_LOOKS and not nearer)):
            loads.survey()
        else:
            loads.look()
        if quiet and loads.unbalance() <= _BALANCED:
            return loads.state
        steps, moved, soft = _eased(loads, soft, floor, change) if loads.motions.size else (0, 0.0, soft)
        unended = unended + 1 if math.isinf(moved) else 0
        last, nearer = moved, moved < _NEARS * last
        if unended and (near or loads.bends):
            floor = _LOW_FLOOR
        if loads.waits and unended in (0, _PATIENT):
            loads.waits = False
            continue
        if steps == 0 or (near and moved < _SAME and look == 0 and not loads.carried):
            return loads.state if loads.overlapping() is None else None
        quiet = moved < near and loads.overlapping() is None
        hopeless = near and unended >= _PATIENT and loads.unbalance() > _HOPELESS
        if loads.lost() is not None or hopeless or (near and unended > 2 * _PATIENT):
            return None
        # Where a force passes through zero its shaft lies anywhere, and no look is the last.
        near *= _NEARER
    return None


def _eased(loads: JointLoads, soft: float, floor: float, least: float) -> tuple[int, float, float]:
    """Make steps as by :func:`_newton`; where they do not end, anew as friction turns ever more sharply."""
    kept = ended = loads.kept()
    found, blunt = _newton(loads, soft, floor, least), 0.0
    if not math.isinf(found[1]):
        return found
    for factor in loads.blurs:
        loads.restore(kept, factor)
        sharper = _newton(loads, soft, floor, least)
        kept = loads.kept()
        if not math.isinf(sharper[1]):
            found, ended, blunt, soft = sharper, kept, factor, sharper[2]
    if blunt:  # as it was when they ended last
        loads.restore(ended, blunt)
    return found


def _newton(loads: JointLoads, soft: float, floor: float, least: float) -> tuple[int, float, float]:
    """Make steps until one changes nothing; return their number and changes, and the stiffness of springs.

    Springs under all nodes, of stiffness ``soft`` [N/m] in each joint, hold a step where contact does not.
    They are stiffer after a step that overshoots the place where the loads along it balance, else softer,
    down to ``floor`` of the largest stiffness.
    """
    residual, moved = loads.residual(), 0.0
    most = _FEWER_STEPS if loads.blurs else _MOST_STEPS
    for steps in range(most):
        stiffness, even = loads.stiffness()
        stiffest = float(np.max(np.abs(stiffness)))
        if loads.over_loads:
            # Without any loads what is left to balance is rounding.
            loads.largest = max(loads.largest, loads.rounding(stiffest) / _BALANCED)
        soft = max(soft, floor * stiffest, _LEAST)
        for _ in range(_MOST_STEPS):
            step = shortest(stiffness + soft * even, residual)
            far = loads.turned(step)
            step = step if far <= _SHORT else step * (_SHORT / far)
            change, way = loads.change(step)
            if way < _FAR:
                loads.move(step)
                after = loads.residual()
                if applied(after, step) >= -_BACK * applied(residual, step) or (
                    loads.over_loads and length(after) <= _BALANCED * loads.largest
                ):
                    break
                loads.undo(step)
            soft *= _STIFFER
        else:
            return most, math.inf, soft
        residual, soft, moved = after, soft / _SOFTER, moved + change
        far = min(far, _SHORT)
        if max(change, far / _FINE) < least and length(after) <= _BALANCED * loads.largest:
            return steps, moved, soft
    return most, math.inf, soft
