"""Kernels of the oil film: average Reynolds equation on (θ, z), its wrench and the derivatives.

What a mechanism calls, with ``film`` and ``memory`` from ``lubrication.Film(...).data()`` and ``.memory()``:

``film_wrench(film, memory, y, omega, out) -> int``
    Fill ``out`` (5,) with the wrench (F_x, F_y, M_x, M_y, M_z) of the film on the shaft [N, N m].
``film_wrench_and_jacobian(film, memory, y, omega, out, jacobian) -> int``
    The same, and ``jacobian`` (5, 9): derivatives in the eight states and ω.
``film_pressure(film, memory, pressure) -> None``
    Fill ``pressure`` (n_z + 1, n_theta) [Pa] with the field of the last evaluation with this memory.
``film_leakage(film, memory) -> float``
    Volume that leaves both ends per second [m³/s], of the last evaluation with this memory.

Arguments and signs are those of the source paper: y = (e_x, e_y, φ_x, φ_y and their rates), ω
right-handed about Z, M_x right-handed, M_y left-handed, M_z about the shaft axis (fluid friction, which
opposes ω).

Each returns a status, listed in ``kernels.film.data``: ``CONVERGED`` (0), or why there is no answer;
``out`` is then NaN. ``lubrication.explain(status)`` puts it into words.

The memory is a cache (which nodes cavitate, and scratch), not a state: the complementarity problem has one
solution, found exactly, so a result depends on the state alone (to rounding), whatever was evaluated
before. Any call may change it; one memory serves one thread.
"""
