"""What the table ``[contact]`` makes of laws, damping factors and restitutions."""

from typing import Any

import pytest

import tribodyn as td
from tribodyn.contact import LAWS
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import parse_case


def changed(**changes: object) -> Any:
    return td.load_case("vsv").replace({f"contact.{key}": value for key, value in changes.items()})


def test_only_laws_with_a_restitution_are_damped_by_default() -> None:
    factors = {name: changed(law=name).contact.damping_factor for name in LAWS}
    damped = {name for name, factor in factors.items() if factor != "none"}
    assert damped == {"rsdc"}


@pytest.mark.parametrize("name", LAWS)
def test_a_restitution_damps_any_law(name: str) -> None:
    case = changed(law=name, restitution=0.6)
    law = case.contact.law_of(case.surface_pair)
    assert (law.name, law.damping_factor, law.restitution) == (name, "lankarani-nikravesh", 0.6)


def test_a_factor_without_restitution_is_refused() -> None:
    with pytest.raises(InputError, match="the law ceb has no restitution of its own") as caught:
        changed(law="ceb", damping_factor="flores")
    assert caught.value.key == "contact.restitution"


def test_what_the_surfaces_cannot_have_is_found_before_a_run() -> None:
    with pytest.raises(InputError) as caught:
        changed(law="gw", damping_factor="calibrated", restitution=0.7, design_pressure="1 TPa")
    assert caught.value.key == "contact.design_pressure"
    smooth = {"asperities.density": "0.0001 1/um^2", "contact.separation_from": "surface"}
    with pytest.raises(InputError) as caught:
        td.load_case("vsv").replace(smooth)
    assert caught.value.key == "contact.separation_from"


@pytest.mark.parametrize(
    ("law", "key", "value", "has_effect"),
    [
        ("rsdc", "penalty_stiffness", "7 MPa/um", False),
        ("linear", "penalty_stiffness", "7 MPa/um", True),
        ("linear", "separation_from", "surface", False),
        ("gw", "separation_from", "surface", True),
    ],
)
def test_a_parameter_of_another_law_is_noted(law: str, key: str, value: str, has_effect: bool) -> None:
    notes = changed(**{"law": law, key: value}).remarks().notes
    found = [note for note in notes if f"contact.{key} has no effect with the law {law}" in note]
    assert bool(found) is not has_effect


def test_a_parameter_of_another_law_is_noted_for_a_named_pair_too() -> None:
    text = 'case = "slider-crank"\n[pairs.pins]\ncontact.penalty_stiffness = "7 MPa/um"\n'
    notes = parse_case(text, "test").remarks().notes
    assert any(
        "pairs.pins.contact.penalty_stiffness has no effect with the law rsdc" in note for note in notes
    )
