"""Bars of the shares of joints in the error of an output."""

import numpy as np
import pytest

from tribodyn.figures.builds import TOGETHER, Shares, draw_shares

JOINTS = ("small", "large", "against")
SIMULATED = np.array([0.3, 0.9, -0.3])


@pytest.mark.parametrize("causes", [("clearance", "tilt", "friction", "bending"), ()])
def test_bars_are_sorted_and_causes_add_up(causes: tuple[str, ...]) -> None:
    estimate = np.outer(SIMULATED, [0.4, 0.3, 0.2, 0.1])[:, : len(causes)]
    figure = draw_shares(Shares("Shares", "Case", JOINTS, SIMULATED, 0.1, estimate, causes))
    (axes,) = figure.axes
    assert [text.get_text() for text in axes.get_yticklabels()] == ["large", "small", "against", TOGETHER]
    simulated, *parts = axes.containers
    assert [bar.get_width() for bar in simulated] == pytest.approx([90.0, 30.0, -30.0, 10.0])
    assert len(parts) == len(causes)
    if causes:
        ends = [bar.get_x() + bar.get_width() for bar in parts[-1]]
        assert ends == pytest.approx([90.0, 30.0, -30.0])
