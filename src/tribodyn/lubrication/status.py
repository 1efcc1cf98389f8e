"""Why a film has no answer, in words."""

from __future__ import annotations

from typing import Final

from tribodyn.kernels.film.data import CONVERGED, NO_CONVERGENCE, NO_MEAN_GAP, NOT_STEADY, OUT_OF_RANGE

_REASONS: Final = {
    CONVERGED: "converged",
    NO_CONVERGENCE: "the cavitated part of the film did not settle",
    OUT_OF_RANGE: (
        "the gap closed: somewhere h < −4σ (with smooth surfaces h ≤ 0); the shaft is outside "
        "the bushing, or the load is too high for film and asperities"
    ),
    NOT_STEADY: "jfo is for steady films: the shaft must turn and its centre rest",
    NO_MEAN_GAP: "jfo needs a positive mean gap everywhere; the surfaces are pressed too far into each other",
}


def explain(status: int) -> str:
    """Return the meaning of a status of ``kernels.film``."""
    return _REASONS[status]
