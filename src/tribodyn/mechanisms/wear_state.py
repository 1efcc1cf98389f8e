"""State that runs of a wear campaign hand on, and the worn surfaces."""

from dataclasses import dataclass

from tribodyn.core.arrays import FloatArray


@dataclass(frozen=True)
class Carried:
    """State that a run hands on to the next one, which begins at its end in the drive's cycle."""

    state: FloatArray  #: The states, shape (n,).
    entry_velocity: FloatArray  #: Memory of contact: δ̇₋ at the nodes [m/s], in the shape of the nodes.


@dataclass(frozen=True)
class Worn:
    """The joints that a run is made with."""

    depth: FloatArray  #: Wear depth at the nodes [m], in their shape.
    carried: Carried | None = None  #: Where the run continues from; None for the start of the case.


@dataclass(frozen=True)
class WearNodes:
    """The nodes of all that wears."""

    area: FloatArray  #: Area that each node stands for [m²], in the shape of the nodes.
    roughness: float  #: The least combined rms roughness σ among them [m].
    n_states: int  #: Length of the state that :class:`Carried` hands on.
