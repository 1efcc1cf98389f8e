"""State that runs of a wear campaign hand on, and the worn surfaces."""

from dataclasses import dataclass

from tribodyn.core.arrays import FloatArray


@dataclass(frozen=True)
class Carried:
    """State that a run hands on to the next one, which begins at its end in the drive's cycle.

    Attributes
    ----------
    state
        The states, shape (n,).
    entry_velocity
        Memory of contact: δ̇₋ at the nodes [m/s], in the shape of the nodes.
    """

    state: FloatArray
    entry_velocity: FloatArray


@dataclass(frozen=True)
class Worn:
    """The joints that a run is made with.

    Attributes
    ----------
    depth
        Wear depth at the nodes [m], in their shape.
    carried
        Where the run continues from; None for the start of the case.
    """

    depth: FloatArray
    carried: Carried | None = None


@dataclass(frozen=True)
class WearNodes:
    """The nodes of all that wears.

    Attributes
    ----------
    area
        Area that each node stands for [m²], in the shape of the nodes.
    roughness
        The least combined rms roughness σ among them [m].
    n_states
        Length of the state that :class:`Carried` hands on.
    """

    area: FloatArray
    roughness: float
    n_states: int
