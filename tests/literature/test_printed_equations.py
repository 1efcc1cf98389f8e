"""Formulation ``printed`` is Eq. 46 with its printed entries, ``paper`` what the table of mended ones has."""

import numpy as np
import pytest
from tests.literature.elimination import MENDED, equations, instant

from tribodyn.papers.cheng_2022.reduced.problem import vsv_data, vsv_memory

TIMES = (0.3, 1.4, 3.5, 5.0)
#: In contact, on the move, with both tilts.
STATE = np.array([9e-6, -17.9e-6, 4e-4, -3e-4, 1e-3, -2e-3, 0.2, -0.3])
EQUAL = 1e-10
#: Without contact, tilted so far that sines and tangents differ.
TIPPED = np.array([3e-6, -5e-6, 0.03, -0.05, 1e-3, -2e-3, 2.0, -3.0])


def at(make_vsv, formulation, t, state, clearance):
    """Return an instant of the mechanism and the work arrays of its kernels."""
    vsv = make_vsv(formulation, clearance)
    data = vsv_data(vsv)
    memory = vsv_memory(data)
    return instant(vsv, data, memory, t, state), memory.scratch


@pytest.fixture(params=["contact", "tipped"])
def moment(request, make_vsv):
    state, clearance = (STATE, 20e-6) if request.param == "contact" else (TIPPED, 2e-3)
    return lambda formulation, t: at(make_vsv, formulation, t, state, clearance)


ORDER = [1, 3, 4, 2]  #: Rows 1 to 4 of Eq. 46 in the order of the kernels, whose signs are opposite.


@pytest.mark.parametrize("t", TIMES)
def test_printed_is_the_elimination_with_the_printed_entries(moment, t):
    now, scratch = moment("printed", t)
    a, b = equations(now, mended=())
    # The kernels have the collar's moment in the load, as Eq. 46 has it in B.
    for k, row in enumerate(ORDER):
        assert np.abs(a[k] + scratch.mass[row]).max() < EQUAL * np.abs(a[k]).max()
        assert b[k] == pytest.approx(-scratch.load[row], rel=EQUAL, abs=EQUAL * np.abs(b).max())
    np.testing.assert_allclose(scratch.acceleration, np.linalg.solve(a, b), rtol=EQUAL)


@pytest.mark.parametrize("t", TIMES)
def test_paper_is_the_elimination_with_every_entry_of_the_table_mended(moment, t):
    now, scratch = moment("paper", t)
    found = np.linalg.solve(*equations(now))
    np.testing.assert_allclose(scratch.acceleration, found, rtol=0.0, atol=EQUAL * np.abs(found).max())


@pytest.mark.parametrize("name", MENDED)
def test_every_entry_of_the_table_changes_the_equations(make_vsv, name):
    now, _ = at(make_vsv, "paper", TIMES[0], TIPPED, 2e-3)
    right, without = equations(now), equations(now, mended=set(MENDED) - {name})
    rows = [np.abs(one - two).max() / np.abs(two).max() for one, two in zip(without, right, strict=True)]
    # Rounding is 1e-15; the least is M_2zi of the light drag link.
    assert max(rows) > 1e-8
