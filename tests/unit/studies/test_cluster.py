"""The points of a sweep on a cluster of machines."""

import dask.base
import pytest

from tribodyn.core.errors import InputError
from tribodyn.studies import sweep


def test_a_scheduler_that_does_not_answer_serves_nothing_else_either() -> None:
    """A client that was made the default would compute whatever this process does with Dask later."""
    with pytest.raises(InputError, match="no scheduler answers there"):
        sweep("vsv", {"joint.clearance": ["20 um"]}, scheduler="nonsense")
    assert dask.base.get_scheduler() is None
