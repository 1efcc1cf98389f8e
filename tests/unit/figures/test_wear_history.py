import io

import pytest

from tribodyn.papers.cheng_2022.reduced.figures import FIGURES


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
