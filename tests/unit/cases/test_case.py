import pickle
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import tribodyn as td
from tribodyn.cases import Key, keys_of
from tribodyn.cases.keys import ANY_NAME
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import built_in, kinds, parse_case

CASE = td.load_case("vsv")

# Close to the defaults, so that the mechanism still reaches and the inertias still fit.
NEAR = {"mechanism", "drive"}


def _near(key: Key, scale: float) -> object:
    """Return a value near the default of a key, as a person would write it."""
    if key.kind == "quantity":
        base = float(key.default or 1.0)
        spread = 1e-3 if key.table in NEAR else 0.3
        return key.write(base * (1.0 + spread * scale)).strip('"')
    if key.kind == "number":
        return float(key.default or 1.0) * (1.0 - 0.1 * abs(scale))
    if key.kind == "count":
        return int(key.default or 16) + int(10 * abs(scale))
    return key.default


_WITH_OTHERS = {
    "asperities.short_cutoff",
    "asperities.long_cutoff",
    "contact.loss_coefficient",
    "drive.actuator_arm",
}
SCALES = st.floats(-1.0, 1.0)
# The cut-offs are allowed beside a scan only, the arm beside a stroke.
CHANGEABLE = {
    path: key
    for path, key in keys_of(type(CASE)).items()
    if key.kind in {"quantity", "number", "count"}
    and not path.startswith(("run.", "temperature.", "joint.liner.", "joint.form."))
    and ANY_NAME not in path
    and path not in _WITH_OTHERS
}


@st.composite
def changes(draw: st.DrawFn) -> dict[str, object]:
    paths = draw(st.lists(st.sampled_from(sorted(CHANGEABLE)), max_size=8, unique=True))
    result = {path: _near(CHANGEABLE[path], draw(SCALES)) for path in paths}
    words: dict[str, st.SearchStrategy[Any]] = {
        "mechanism.formulation": st.sampled_from(["exact", "paper", "printed"]),
        "joint.friction": st.sampled_from(["traction", "moment"]),
        "run.start": st.sampled_from(["equilibrium", "centred"]),
        "contact.tensile_clip": st.booleans(),
        "run.duration": st.floats(0.1, 1e3).map(lambda value: f"{value!r} s"),
        "title": st.text(
            st.characters(codec="utf-8", exclude_categories=["Cc", "Zl", "Zp", "Cs"]), max_size=40
        ),
    }
    for path in draw(st.lists(st.sampled_from(sorted(words)), max_size=4, unique=True)):
        result[path] = draw(words[path])
    return result


@given(changes())
@settings(max_examples=60, deadline=None)
def test_case_text_reads_back_to_the_same_case(changed: dict[str, object]) -> None:
    # A campaign needs whole cycles; its keys have tests of their own.
    case = CASE.replace({path: value for path, value in changed.items() if path != "wear.cycles"})
    for comments in (False, True):
        again = parse_case(case.to_toml(comments=comments), "case.toml")
        assert again == case
        assert hash(again) == hash(case)
        assert again.model_dump() == case.model_dump()
        assert again.to_toml() == case.to_toml()


def test_keys_that_need_each_other_read_back() -> None:
    case = CASE.replace(
        {
            "joint.liner.thickness": "1.5 mm",
            "joint.form.chamfer_length": "0.5 mm",
            "joint.form.chamfer_depth": "20 um",
            "temperature.bushing": "300 degC",
            "surfaces.bushing.thermal_expansion": "50e-6 1/K",
            "temperature.properties.temperatures": "20, 400 degC",
            "temperature.properties.hardness": "492, 300 MPa",
            "contact.loss_coefficient": "0.2 s/m",
        }
    )
    assert parse_case(case.to_toml(), "case.toml") == case
    assert parse_case(case.to_toml(), "case.toml").to_toml() == case.to_toml()


@pytest.mark.parametrize("name", built_in())
def test_built_in_cases_load_and_read_back(name: str) -> None:
    case = td.load_case(name)
    assert isinstance(case, built_in()[name].model)
    assert parse_case(case.to_toml(), name) == case
    assert case.kind() in kinds()
    assert case.duration > 0.0


def test_defaults_are_those_of_the_tables() -> None:
    case: Any = CASE
    assert case.surfaces.bushing.hardness == 492e6
    assert case.joint.clearance == 20e-6
    assert case.mechanism.crank_length == 47.7e-3
    assert case.drive.start_angle == pytest.approx(-0.2792526803190927, rel=1e-15)
    assert case.joint.friction == "traction"
    assert case.run.start == "equilibrium"
    assert case.duration == pytest.approx(4 * 3.141592653589793)


def test_formulation_decides_defaults_unless_they_are_given() -> None:
    for own in ("printed", "paper"):
        paper: Any = CASE.replace({"mechanism.formulation": own})
        assert (paper.joint.friction, paper.run.start) == ("moment", "centred")
    mixed: Any = paper.replace({"joint.friction": "traction"})
    assert (mixed.joint.friction, mixed.run.start) == ("traction", "centred")
    back: Any = paper.replace({"mechanism.formulation": "exact"})
    assert back == CASE


def test_duration_takes_the_place_of_cycles_and_back() -> None:
    short = parse_case(CASE.to_toml(), "case.toml").replace({"run.duration": "3 s"})
    assert short.at("run.cycles") is None
    assert short.duration == 3.0
    assert short.replace({"run.cycles": 2}) == CASE


def test_cases_are_frozen() -> None:
    case: Any = CASE
    with pytest.raises(TypeError, match="replace"):
        case.title = "other"
    with pytest.raises(TypeError, match="replace"):
        case.joint.clearance = 1.0
    with pytest.raises(TypeError, match="replace"):
        del case.joint


def test_crank_range_covers_the_swing_of_a_whole_cycle_only_if_it_is_run() -> None:
    low, high = CASE.crank.crank_range(CASE.duration)  # type: ignore[attr-defined]
    assert high - low == pytest.approx(0.6981317007977318)
    short = CASE.replace({"run.duration": "0.1 s", "drive.speed_amplitude": "200 deg/s"})
    assert short.crank.crank_range(short.duration)[1] < 0.0  # type: ignore[attr-defined]


def test_the_crank_may_set_out_backwards_but_must_move() -> None:
    back = CASE.replace({"drive.speed_amplitude": "-20 deg/s", "drive.start_angle": "24 deg"})
    assert back.crank.crank_range(7.0) == pytest.approx(CASE.crank.crank_range(7.0))  # type: ignore[attr-defined]
    with pytest.raises(InputError, match="must move") as caught:
        CASE.replace({"drive.speed_amplitude": "0 deg/s"})
    assert caught.value.key == "drive.speed_amplitude"


@pytest.mark.parametrize("name", ["friction_coefficient", "minimum_entry_velocity", "onset_separation"])
def test_assumed_values_are_flagged(name: str) -> None:
    lines = CASE.to_toml(comments=True).splitlines()
    at = next(i for i, line in enumerate(lines) if line.startswith(name))
    # A comment that is too long for its line stands above it.
    assert "ASSUMED" in lines[at] + lines[at - 1] * lines[at - 1].startswith("#")


def test_a_campaign_needs_whole_cycles_and_a_pressure() -> None:
    assert CASE.campaign_cycles == 0
    assert CASE.replace({"wear.cycles": 400}).campaign_cycles == 400
    for changes, message in (
        ({"run.cycles": 1.5}, "a whole number of cycles"),
        ({"run.duration": "9 s"}, "a whole number of cycles"),
        ({"joint.contact": "point-johnson"}, "no pressure that could wear"),
    ):
        with pytest.raises(InputError, match=message):
            CASE.replace({"wear.cycles": 400, **changes})


def test_a_file_may_begin_with_a_built_in_case() -> None:
    case = parse_case('case = "journal-oil"\n[run]\nduration = "1 ms"\n', "mine.toml")
    assert case == td.load_case("journal-oil").replace({"run.duration": "1 ms"})


def test_inertias_of_rods_follow_their_mass_and_length() -> None:
    case: Any = CASE.replace({"mechanism.vane_mass": "0.5 kg", "mechanism.crank_length": "50 mm"})
    assert case.mechanism.vane_inertia == pytest.approx(0.5 * 0.16**2 / 3.0)
    assert case.mechanism.crank_inertia == pytest.approx(0.82 * 0.05**2 / 3.0)
    assert case.mechanism.drag_link_inertia == CASE.at("mechanism.drag_link_inertia")
    given = {"mechanism.vane_mass": "0.5 kg", "mechanism.vane_inertia": "5e-3 kg m^2"}
    assert CASE.replace(given).at("mechanism.vane_inertia") == 5e-3


def test_all_faults_are_told_at_once() -> None:
    wrong = '[joint]\nclearence = 1\nradius = "6 kg"\n[run]\ncycles = -1\n[contact]\nlaw = "hertz"\n'
    with pytest.raises(InputError) as caught:
        parse_case(f'case = "vsv"\n{wrong}', "mine.toml")
    keys = {fault.key for fault in caught.value.faults}
    assert keys == {"joint.clearence", "joint.radius", "run.cycles", "contact.law"}
    again = pickle.loads(pickle.dumps(caught.value))
    assert str(again) == str(caught.value)
    assert len(again.faults) == 4


@pytest.mark.parametrize("name", built_in())
def test_models_alone_give_the_same_defaults_as_loading(name: str) -> None:
    entry = built_in()[name]
    if not entry.given:
        assert entry.model() == td.load_case(name)  # type: ignore[call-arg]


def test_a_resolved_file_keeps_what_it_says() -> None:
    written = CASE.to_toml().replace('formulation = "exact"', 'formulation = "paper"')
    case: Any = parse_case(written, "case.toml")
    assert (case.joint.friction, case.run.start) == ("traction", "equilibrium")


def test_a_value_of_ones_own_is_never_called_assumed() -> None:
    shown = CASE.replace({"joint.friction_coefficient": 0.2}).to_toml(comments=True)
    (line,) = (line for line in shown.splitlines() if line.startswith("friction_coefficient"))
    assert line.endswith("default 0.1, ASSUMED")
    assert "friction_coefficient = 0.2" in line
