"""Analyses of a mechanism beside the integration over time."""

from dataclasses import replace
from functools import partial
from typing import Final

from tribodyn.core.problem import Problem
from tribodyn.mechanism.analyses.kinematics import follow_drives, require_closing, require_motion
from tribodyn.mechanism.analyses.statics import find_equilibria, require_no_film
from tribodyn.mechanism.analyses.vibrations import find_rest, require_freedom
from tribodyn.mechanism.assembly.assembly import Assembly

#: Effects that each analysis leaves out, in words.
NOTES: Final[dict[str, tuple[str, ...]]] = {
    "dynamic": (),
    "static": (
        "static analysis: equilibria at positions along the drives; impacts, vibration and damping are left "
        "out",
    ),
    "rest": (
        "static analysis without a drive: bodies rest where loads and springs balance; friction, which could "
        "hold them beside that position, is left out",
    ),
    "kinematic": (
        "kinematic analysis: all joints are ideal, freedoms that drives leave are at rest, and forces are "
        "those that the motion needs",
    ),
    "vibrations": (
        "vibration analysis: drives and loads are held at each position, bodies are at rest; friction, loads "
        "against the motion and damping of impacts are left out",
    ),
}


def analysed(problem: Problem, assembly: Assembly, analysis: str, turn: float) -> Problem:
    """Return a problem that is solved by an analysis instead of an integration.

    ``analysis``: ``static``, ``kinematic`` or ``vibrations``; ``turn``: when the drives turn back [s];
    infinite where they do not. Raises InputError if the mechanism does not allow this analysis.
    """
    if analysis == "kinematic":
        require_motion(assembly)
        return replace(problem, solved=partial(follow_drives, assembly, problem))
    if analysis == "vibrations":
        require_freedom(assembly)
        return replace(problem, solved=partial(find_rest, assembly, problem))
    require_closing(assembly)
    require_no_film(assembly)
    return replace(problem, solved=partial(find_equilibria, assembly, turn, problem))
