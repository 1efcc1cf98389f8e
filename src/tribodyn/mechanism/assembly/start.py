"""Start of a mechanism with clearance: its shafts laid against their sockets, with balanced loads.

Bodies move as those of the mechanism whose joints are ideal do at that time, and are displaced within the
clearances until contact gives what that motion asks of the joints, by
:mod:`tribodyn.mechanism.assembly.equilibrium`. Freedoms of the mechanism as a whole are left to themselves.
"""

from __future__ import annotations

from tribodyn.core.arrays import FloatArray
from tribodyn.mechanism.assembly.assembly import Assembly
from tribodyn.mechanism.assembly.closing import System
from tribodyn.mechanism.assembly.equilibrium import JointLoads
from tribodyn.mechanism.assembly.settling import settled
from tribodyn.mechanism.assembly.start_speeds import speeds_of


def initial_state(assembly: Assembly) -> FloatArray | None:
    """Return the state in which the loads on all shafts balance, shape (13 n,); None if none is found.

    Without clearance it is that of the assembly. So it is of joints with an oil film, which carries by motion
    alone: they begin in the middle of their bores.

    Raises
    ------
    Stopped
        If the caller wanted to stop before the end of the search.
    """
    if not assembly.model.without_films.clearances:
        return assembly.state
    ideal = System(assembly.model.counterpart, data=assembly.ideal_data)
    ideal.adopt(assembly.state)
    ideal.close()
    loads = JointLoads(assembly, ideal, speeds_of(assembly.model))
    # Displaced within their clearances, bodies stay where as many constraints are independent.
    loads.ideal.known_rank, loads.real.known_rank = loads.ideal.rank(), loads.real.rank()
    return settled(loads)
