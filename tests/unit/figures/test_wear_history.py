from __future__ import annotations

import io

import numpy as np
import pytest

from tribodyn.mechanisms.vsv.figures import FIGURES
from tribodyn.report import figures_of
from tribodyn.views.depth import no_feedback


@pytest.mark.parametrize("n_jumps", [0, 1, 2, 60])
def test_every_figure_of_a_campaign_is_drawn_however_far_it_came(n_jumps, make_campaign):
    result = make_campaign(n_jumps)
    for family in FIGURES.values():
        family.draw(result).savefig(io.BytesIO(), format="png", dpi=20)


def test_only_campaigns_have_a_history(make_result, make_campaign):
    assert not FIGURES["wear_history"].drawable(make_result(0.1))
    assert figures_of(make_campaign(3))["wear_history"].drawable(make_campaign(3))


def test_the_straight_line_goes_on_at_the_first_rate(make_campaign):
    line = no_feedback(make_campaign(4))
    np.testing.assert_allclose(line, 1e-11 * 1000.0 * np.arange(4))


def test_the_map_says_after_how_many_cycles(make_campaign):
    figure = FIGURES["wear_depth"].draw(make_campaign(5))
    assert any("after 4000 cycles" in axes.get_title(loc="left") for axes in figure.axes)
