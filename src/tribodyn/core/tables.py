"""Tables that objects fill once and kernels read."""

from typing import NamedTuple

from tribodyn.core.arrays import FloatArray, FloatMatrix


class ContactTable(NamedTuple):
    """A contact law tabulated over the separation h* = h/σ on ``n`` equal intervals.

    Between two nodes each quantity is the cubic Hermite polynomial of the node values and slopes.

    Attributes
    ----------
    h_first, h_last
        First and last node, h* [1].
    inverse_step
        Reciprocal of the distance between nodes [1].
    nodes
        Shape (n + 1, 4), C-contiguous [Pa]: stiffness pressure P_k, step·dP_k/dh*, damping pressure
        coefficient C with its onset smoothing, step·dC/dh*.
    energy
        Stored energy per area divided by σ, W_k(h*) = ∫_h*^h_last P_k dh*, shape (n + 1,) [Pa]: the exact
        integral of the interpolated P_k.
    cubics
        The polynomials as kernels evaluate them: eight coefficients [Pa] for each interval, P_k and then C
        in rising powers of the distance from its lower node in steps, shape (8 (n + 2),). The first eight
        continue below the table linearly, in the distance from one step below the first node; the last
        eight are zero and stand for everything above.
    """

    h_first: float
    h_last: float
    inverse_step: float
    nodes: FloatMatrix
    energy: FloatArray
    cubics: FloatArray
