"""Keys of cases: documented, read back, of another kind; those of contact."""

import operator
import re
import tomllib
from itertools import chain
from typing import Any

import pytest

import tribodyn as td
from tribodyn.cases import Key, keys_of
from tribodyn.cases.keys import ValueProblem
from tribodyn.cases.tables import as_declared
from tribodyn.cases.write import keys_as_toml
from tribodyn.contact import LAWS
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import built_in, kinds, parse_case

#: Keys of each built-in case; together some five thousand.
KEYS = {name: list(keys_of(entry.model).values()) for name, entry in built_in().items()}


def is_documented(key: Key) -> bool:
    # The source is that of the default: where there is none, it says nothing.
    sourced = key.source or key.path == "case" or key.default is None or key.kind == "text"
    chosen = key.kind != "choice" or key.default is None or key.default in key.choices
    return bool(key.description and key.allowed and sourced and chosen)


def reads_back(key: Key) -> bool:
    written = tomllib.loads(f"key = {key.write(key.default)}")["key"]
    return bool(key.read(written, text=False) == key.default)


@pytest.mark.parametrize("case", KEYS)
def test_every_key_is_documented(case: str) -> None:
    assert KEYS[case]
    assert [key.path for key in KEYS[case] if not is_documented(key)] == []


@pytest.mark.parametrize("case", KEYS)
def test_every_default_reads_back_from_what_is_written(case: str) -> None:
    with_default = [key for key in KEYS[case] if key.default is not None]
    assert with_default
    assert [key.path for key in with_default if not reads_back(key)] == []


@pytest.mark.parametrize(
    ("path", "given", "value"),
    [
        ("solver.rtol", "1e-5", 1e-5),
        ("solver.grid.theta", "48", 48),
        ("contact.tensile_clip", "False", False),
        ("joint.friction", "moment", "moment"),
    ],
)
def test_numbers_and_switches_may_be_typed_as_text_outside_files(path, given, value):
    key = keys_of(built_in()["vsv"].model)[path]
    assert key.read(given, text=True) == value
    if not isinstance(value, str):
        with pytest.raises(ValueProblem):
            key.read(given, text=False)


@pytest.mark.parametrize("wrong", [True, None, [1], {"a": 1}, "x", 10**400, float("nan"), "1_0"])
@pytest.mark.parametrize("path", ["joint.clearance", "solver.rtol", "solver.grid.z"])
def test_values_of_another_kind_are_refused(path: str, wrong: object) -> None:
    for text in (True, False):
        with pytest.raises(ValueProblem):
            keys_of(built_in()["vsv"].model)[path].read(wrong, text=text)


@pytest.mark.parametrize(
    ("path", "number", "spelled"),
    [
        ("surfaces.trunnion.young_modulus", 210e9, "210 GPa"),
        ("surfaces.trunnion.young_modulus", 210, "210 GPa"),
        ("surfaces.trunnion.young_modulus", "210e9", "210 GPa"),
        ("joint.clearance", 3e-5, "30 um"),
        ("joint.clearance", "25", "25 um"),
        ("joint.clearance", 0, "0 um"),
        ("mechanism.lever_length", -0.05, "-50 mm"),
        ("mechanism.gravity", 9.81, "9.81 m/s^2"),
    ],
)
def test_a_number_without_a_unit_is_shown_with_the_one_that_was_meant(path, number, spelled):
    key = keys_of(built_in()["vsv"].model)[path]
    with pytest.raises(ValueProblem, match="unit is missing") as problem:
        key.read(number, text=True)
    assert str(problem.value).endswith(f'= "{spelled}"')


@pytest.mark.parametrize("number", [0, 1e-300, 1e300, "1e400", -7, "1" * 90])
def test_every_quantity_asks_for_its_unit(number: object) -> None:
    for key in chain.from_iterable(KEYS.values()):
        if key.kind == "quantity":
            with pytest.raises(ValueProblem, match="unit is missing"):
                key.read(number, text=True)


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


def _refused(key: Key, line: str) -> str:
    """Return what is wrong with a line of a key, empty if nothing is."""
    try:
        held = key.read(tomllib.loads(line)[key.name], text=False)
    except (tomllib.TOMLDecodeError, ValueProblem) as problem:
        return f"{line}: {problem}"
    compare = {"gt": operator.gt, "ge": operator.ge, "lt": operator.lt, "le": operator.le}
    values = held if isinstance(held, tuple) else (held,)
    inside = all(compare[sign](value, bound) for sign, bound in key.bounds for value in values)
    return "" if inside and (not key.choices or held in key.choices) else line


@pytest.mark.parametrize("kind", ["vsv", "mechanism"])
def test_every_line_that_is_shown_can_be_used_as_it_stands(kind):
    model = kinds()[kind]
    shown = keys_as_toml(model, kind) if kind == "mechanism" else td.load_case(kind).to_toml(comments=True)
    keys, path, wrong = keys_of(model), "", []
    table, line = re.compile(r"(?:# )?\[([\w.]+)\]"), re.compile(r"(?:# )?(\w+ = .*)")
    for text in shown.splitlines():
        if found := table.fullmatch(text):
            path = as_declared(found[1], keys) + "."
        elif (found := line.fullmatch(text)) and not found[1].startswith("case ="):
            wrong.append(_refused(keys[path + found[1].split()[0]], found[1]))
    assert len(wrong) > 100
    assert [words for words in wrong if words] == []
