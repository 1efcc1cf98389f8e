"""What else holds."""

import numpy as np

from tribodyn.views.bushing import unloaded_middle


def test_no_load_at_all_shortens_nothing(make_result):
    result = make_result(0.1)
    assert unloaded_middle(result, np.zeros((96, 18))) == 0.0
