from __future__ import annotations

import numba

from tribodyn.cli.progress import announced_compilation


def test_compilation_is_announced_once_and_only_when_it_happens() -> None:
    @numba.njit
    def double(x: float) -> float:
        return 2.0 * x

    @numba.njit
    def triple(x: float) -> float:
        return 3.0 * x

    lines: list[str] = []
    with announced_compilation(lines.append):
        double(1.0)
        triple(1.0)
    assert len(lines) == 1
    assert "compiling" in lines[0]
    with announced_compilation(lines.append):
        double(1.0)
    assert len(lines) == 1
