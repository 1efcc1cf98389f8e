"""What the table ``[contact]`` makes of laws, damping factors and restitutions."""

from typing import Any

import tribodyn as td


def changed(**changes: object) -> Any:
    return td.load_case("vsv").replace({f"contact.{key}": value for key, value in changes.items()})


def test_another_law_of_the_same_case_is_not_damped_without_a_restitution() -> None:
    case = changed(law="rsdc")
    other = case.contact.model_copy(update={"law": "ke"})
    assert other.law_of(case.surface_pair).damping_factor == "none"
