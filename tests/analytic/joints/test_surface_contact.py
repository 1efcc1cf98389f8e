"""The statistical law of a generated surface against boundary elements on the same surface.

It runs the script that draws the figure of the manual, on a smaller piece and at two loads.
"""

import importlib.util
import math
import warnings
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

SCRIPT = Path(__file__).parents[3] / "docs" / "plots" / "bem.py"
#: Pressure over modulus and gradient: real areas of 2.5 % and 22 %. At smaller loads a piece of this size has
#: so few high summits that the ratio scatters by 20 % from piece to piece; here by 6 % and by 1 %.
LOADS = np.array([1e-2, 1e-1])


@pytest.fixture(scope="module")
def bem() -> ModuleType:
    pytest.importorskip("ContactMechanics")
    spec = importlib.util.spec_from_file_location("bem", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        spec.loader.exec_module(module)
    module.LOADS = LOADS
    return module


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
@pytest.mark.parametrize(
    "name", ["few wavelengths", pytest.param("many wavelengths", marks=pytest.mark.long)]
)
def test_greenwood_williamson_is_right_while_little_touches(name: str, bem: ModuleType) -> None:
    spectrum = bem.SURFACES[name]
    solution = bem.solve(spectrum, 256, (1, 2))
    law = bem.statistical_law(spectrum)
    ratio = law.stiffness_pressure(solution.separation) / (bem.MODULUS * solution.pressure)
    # The manual's claim is 20 %; the scatter adds to it.
    assert ratio[0] == pytest.approx(1.0, abs=0.25)
    # With a fifth of the area in contact the asperities have merged: the law is too soft.
    assert ratio[1] < 0.75
    # Real area over load at a small load: the theories of Persson and of Bush, Gibson and Thomas say √(8/π)
    # and √(2π). Whole cells of the grid are counted, which adds their border: some 10 %.
    assert math.sqrt(8.0 / math.pi) < solution.area[0] / LOADS[0] < 1.15 * math.sqrt(2.0 * math.pi)


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_summits_do_not_lie_around_the_mean_plane_of_the_surface(bem: ModuleType) -> None:
    """Separations from the mean of the summits, taken for those of the surface, are far too soft."""
    spectrum = bem.SURFACES["few wavelengths"]
    solution = bem.solve(spectrum, 256, (1,))
    softer = bem.statistical_law(spectrum, "asperities").stiffness_pressure(solution.separation)
    assert np.all(softer < 0.2 * bem.MODULUS * solution.pressure)
