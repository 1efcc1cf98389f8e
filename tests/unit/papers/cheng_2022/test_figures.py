from __future__ import annotations

import numpy as np
import pytest

from tribodyn.papers.cheng_2022.figures import FIGURES, Runs


def test_a_figure_leaves_the_runs_that_claims_are_judged_on():
    runs = Runs()
    run = runs.vsv("paper", 20e-6)
    of_the_run = run["pressure"].values.copy()
    drawn = FIGURES["fig15"].data(runs, "paper")
    assert np.array_equal(run["pressure"].values, of_the_run)
    # The figure shows static equilibrium, which is another field.
    assert not np.allclose(drawn["pressure"].values, of_the_run, rtol=0.01)


def test_shared_runs_cannot_be_changed():
    run = Runs().run("journal-dry", {"run.duration": "0.1 ms"})
    with pytest.raises(ValueError, match="read-only"):
        run["e_x"].values[0] = 1.0
