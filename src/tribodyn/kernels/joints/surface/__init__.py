"""Contact over surfaces of any shape, at nodes with positions, normals, areas and gaps of their own.

All clearance joints of a mechanism lie in the same few arrays, told apart by numbers, so that one compiled
function serves every mechanism. A joint has one or more surfaces (a barrel and two end faces), a surface has
rows of nodes. Everything is right-handed and in the frame of the socket, in which the shaft (or ball) of a
joint lies along Z as drawn.

At a node k with the position x_k from the shaft's origin P, the normal n_k from the shaft into the socket
and the gap h0_k as drawn,

    h = h0 − n·(d + φ × x),   δ̇ = −dh/dt = n·(v + φ̇ × x),   s = (v + ω × x) without its part along n,
    f = A (−p n − μ p s/√(s² + u_s²)),

with the displacement d and velocity v of P, the tilt φ and the angular velocity ω. How φ and its rate follow
from the rotation of the shaft, why the moment of the pressure needs that too, and what the gap of a leaning
cylinder has besides, says ``tilt``.
"""
