"""The bounce test, and quadrature over heights of asperities."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from tribodyn.contact import DAMPING_FACTORS, LAWS, RSDC, SurfacePair, law, tabulate
from tribodyn.contact.bounce import bounce
from tribodyn.contact.contact_law import asperity_integral, density, exceedance
from tribodyn.contact.linear import LinearContact
from tribodyn.core.errors import InputError
from tribodyn.kernels.lookup import stored_energy

ASKED = (0.1, 0.5, 0.9, 0.99)
POINT_LIKE = ("hunt-crossley", "lankarani-nikravesh", "gonthier", "flores", "hu-guo")


@pytest.mark.parametrize("name", LAWS)
def test_without_damping_all_comes_back(table_1_pair: SurfacePair, name: str) -> None:
    made = bounce(tabulate(law(name, table_1_pair, damping_factor="none", restitution=0.5)))
    # The tolerance of the integration is 1e-9; the peak is read at its steps.
    assert made.restitution == pytest.approx(1.0, abs=1e-7)
    assert made.peak_pressure == pytest.approx(50e6, rel=1e-3)


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize(
    "wanted", [*ASKED[::2], *(pytest.param(wanted, marks=pytest.mark.long) for wanted in ASKED[1::2])]
)
def test_calibrated_returns_what_is_asked(table_1_pair: SurfacePair, name: str, wanted: float) -> None:
    table = tabulate(law(name, table_1_pair, damping_factor="calibrated", restitution=wanted))
    # 1e-3 is asked for; the root is solved to 1e-7.
    assert bounce(table).restitution == pytest.approx(wanted, abs=1e-6)


def test_calibrated_takes_the_restitution_of_the_paper_when_none_is_given(table_1_pair: SurfacePair) -> None:
    found = RSDC(table_1_pair, "calibrated")
    wanted = found.meant_restitution(np.array([found.design_separation()]))[0]
    assert bounce(tabulate(found)).restitution == pytest.approx(wanted, abs=1e-6)
    assert wanted == pytest.approx(0.70, abs=0.01)


@pytest.mark.parametrize("factor", POINT_LIKE)
@pytest.mark.parametrize("wanted", ASKED)
def test_a_deep_impact_is_that_of_a_point(table_1_pair: SurfacePair, factor: str, wanted: float) -> None:
    found = law("gw", table_1_pair, damping_factor=factor, restitution=wanted)
    expected = DAMPING_FACTORS[factor].realised(np.array(wanted))
    # Damping in proportion to stiffness rebounds alike whatever the stiffness; what differs is the unit of h*
    # below the onset where damping grows, with a share of the energy that falls with the depth.
    errors = [
        abs(bounce(tabulate(found), design_pressure=p).restitution - expected) for p in (5e6, 50e6, 500e6)
    ]
    assert errors[2] < errors[1] < errors[0] or max(errors) < 1e-4
    # At 50 MPa that share is 1 %, and a restitution of 0.1 is the root of as much.
    assert errors[1] < 0.02


def test_kelvin_and_voigt_on_the_linear_law(table_1_pair: SurfacePair) -> None:
    for wanted in ASKED:
        found = LinearContact(table_1_pair, "kelvin-voigt", restitution=wanted, design_pressure=250e6)
        made = bounce(tabulate(found), design_pressure=250e6, clip=False)
        # Published for a contact that ends at δ = 0. The corner of the law is a tenth of σ, the depth 3 σ.
        assert made.restitution == pytest.approx(wanted, abs=6e-3)
        # Dry contact ends where the force does.
        assert bounce(tabulate(found), design_pressure=250e6).restitution >= made.restitution - 1e-7


def test_energy_lost_is_the_damping_heat(table_1_pair: SurfacePair) -> None:
    table = tabulate(RSDC(table_1_pair))
    undamped = bounce(table, scale=0.0)
    damped = bounce(table)
    energy = stored_energy(table, undamped.deepest) - stored_energy(table, 4.0)
    stored = stored_energy(table, damped.deepest) - stored_energy(table, 4.0)
    assert damped.restitution**2 * energy < stored < energy


@pytest.mark.parametrize("pressure", [0.0, 1e12])
def test_an_impact_beyond_the_table_is_refused(table_1_pair: SurfacePair, pressure: float) -> None:
    with pytest.raises(InputError) as caught:
        bounce(tabulate(RSDC(table_1_pair)), design_pressure=pressure)
    assert caught.value.key == "contact.design_pressure"


def test_an_impact_above_the_onset_is_refused(table_1_pair: SurfacePair) -> None:
    with pytest.raises(InputError, match="above the onset"):
        bounce(tabulate(RSDC(table_1_pair)), design_pressure=1e3)


@pytest.mark.parametrize("weight", [density, exceedance])
@pytest.mark.parametrize(
    ("power", "lower", "upper"),
    [
        (1.5, 0.0, 0.017),
        (1.425, 0.017, 0.1),
        (1.263, 0.1, 1.9),
        (1.0, 1.9, math.inf),
        (1.5, 0.0, math.inf),
        (1.263, 6e-7, 1.1e-5),
        (1.263, 3.0, 55.0),
    ],
)
def test_agrees_with_adaptive_quadrature(weight, power, lower, upper):
    h_star = np.linspace(-4.0, 8.0, 13)

    def reference(h: float) -> float:
        # Beyond 15 standard deviations the integrand is below 1e-48.
        top = min(upper, 15.0 - min(h, 0.0))
        return float(
            quad(lambda s: s**power * weight(h + s), lower, top, epsabs=0, epsrel=1e-12, limit=400)[0]
        )

    expected = np.array([reference(h) for h in h_star])
    # 1e-6 is asked for; both quadratures are good to some 1e-12 and the larger number holds them there.
    np.testing.assert_allclose(
        asperity_integral(h_star, power, lower, upper, weight), expected, rtol=1e-10, atol=1e-300
    )
