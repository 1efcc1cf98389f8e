import io

import numpy as np
import pytest

from tribodyn.papers.cheng_2022.reduced.figures import FIGURES
from tribodyn.report import figures_of
from tribodyn.views.wear import no_feedback


@pytest.mark.parametrize("n_jumps", [0, 1, 60])
def test_every_figure_of_a_campaign_is_drawn_however_far_it_came(n_jumps, make_campaign):
    result = make_campaign(n_jumps)
    for family in FIGURES.values():
        figure = family.draw(result)
        figure.savefig(io.BytesIO(), format="png", dpi=20)
        assert family.title in [text.get_text() for text in figure.texts]


def test_the_history_has_a_point_a_stop(make_campaign):
    # Depth beside its straight line, and the largest pressure beside the mean.
    for axes in FIGURES["wear_history"].draw(make_campaign(60)).axes:
        assert [line.get_xdata().size for line in axes.lines] == [60, 60]


@pytest.mark.parametrize(("n_jumps", "note"), [(0, "nothing computed"), (1, "nothing varies")])
def test_a_history_without_two_stops_says_so(n_jumps, note, make_campaign):
    for axes in FIGURES["wear_history"].draw(make_campaign(n_jumps)).axes:
        assert note in [text.get_text() for text in axes.texts]


def test_only_campaigns_have_a_history(make_result, make_campaign):
    assert not FIGURES["wear_history"].drawable(make_result(0.1))
    assert figures_of(make_campaign(3))["wear_history"].drawable(make_campaign(3))


def test_the_straight_line_goes_on_at_the_first_rate(make_campaign):
    line = no_feedback(make_campaign(4))
    np.testing.assert_allclose(line, 1e-11 * 1000.0 * np.arange(4))


def test_the_map_says_after_how_many_cycles(make_campaign):
    figure = FIGURES["wear_depth"].draw(make_campaign(5))
    assert any("after 4000 cycles" in axes.get_title(loc="left") for axes in figure.axes)
