import pytest

from tribodyn.cases.keys import keys_of
from tribodyn.cli.main import COMMANDS
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import SYNONYMS
from tribodyn.mechanism.elements import ELEMENTS
from tribodyn.mechanism.joints import JOINTS
from tribodyn.mechanisms.catalogue import kinds, load_case, parse_case

BODY = '[bodies.rod]\nmass = "1 kg"\ncentre = "0, 0, 0 mm"\ninertia = "1e-4, 1e-4, 1e-4 kg m^2"\n'
JOINT = '[joints.pivot]\nbetween = ["ground", "rod"]\npoint = "0, 0, 0 mm"\naxis = [0, 0, 1]\n'


def test_every_meaning_is_a_word_of_ours() -> None:
    keys = keys_of(kinds()["mechanism"])
    names = {part for path in keys for part in path.split(".")}
    ours = {*JOINTS, *COMMANDS, *names, *(kind.METHOD for kind in ELEMENTS), "drive", "load", "ground"}
    assert {word for meant in SYNONYMS.values() for word in meant} <= ours


@pytest.mark.parametrize(
    ("lines", "hint"),
    [
        (f'{BODY}{JOINT}type = "hinge"\n', 'did you mean "revolute"?'),
        (f'{BODY}{JOINT}type = "slider"\n', 'did you mean "prismatic"?'),
        (f'{BODY}{JOINT}type = "Ball"\n', 'did you mean "spherical"?'),
        (f'{BODY}{JOINT}type = "revolute"\nlimits = "0, 90 deg"\n', r"write a table \[stops.NAME\]"),
        (f'{BODY}{JOINT}type = "revolute"\nlocation = "0, 0, 0 mm"\n', "joints.pivot.point"),
        (f'{BODY}{JOINT}type = "revolute"\n[drives.motor]\njoint = "pivot"\nrpm = 3\n', "drives.motor.speed"),
        (BODY.replace("centre", "com"), "bodies.rod.centre"),
        (f'{BODY}{JOINT.replace("ground", "world")}type = "revolute"\n', 'did you mean "ground"?'),
        (BODY.replace("1 kg", "1,5 kg"), "a decimal point, not a comma"),
        (BODY.replace("1 kg", "1 KG"), "unknown unit 'KG', write 'kg'"),
        (f"{BODY}diameter = 3\n", "bodies.rod.radius"),
        (f'{BODY}material = "steel"\n', "bodies.rod.density"),
        (f'{BODY}[gravity]\nz = "-9.81 m/s^2"\n', r"gravity is a value, not a table; write gravity = \["),
        (f"g = 9.81\n{BODY}", "valid one is gravity"),
        (f"{BODY}{JOINT}[joints.pivot.limits]\nlower = 0\n", r"write a table \[stops.NAME\]"),
        (f'{BODY}{JOINT}[joints.pivot.clearance]\nclearance = "20 um"\n', "joints.pivot.clearance.radial"),
        (
            f'{BODY}{JOINT}[joints.pivot.clearance]\ndiametral = "40 um"\n',
            "clearance.radial, half of this value",
        ),
        (f'{BODY}[wear]\nrate = "1e-6 mm^3/(N m)"\n', "wear.specific_wear_rate"),
        (f'{BODY}[surfaces.pin]\nroughness = "0.8 um"\n', "surfaces.trunnion.roughness"),
        (f'{BODY}{JOINT}[joints.pivot.film]\noil = "VG 46"\n', "joints.pivot.film.viscosity"),
        (BODY.replace('"0, 0, 0 mm"', '"x"'), "1 value; allowed: three numbers"),
        (f"{BODY}[loads.push]\nforce = [10, 0, 0]\n", "this is one quantity"),
        (f'{BODY}[springs.s]\nk = "2 N/mm"\n', "springs.s.stiffness"),
        (f'{BODY}[drives.m]\nspeed = "300 RPM"\n', "write 'rpm'"),
        (f'{BODY}[drives.m]\nspeed = "5 Hz"\n', 'of turns, "5 Hz" is "300 rpm"'),
        (f'{BODY}[drives.m]\nspeed = "300 1/min"\n', 'of turns, "300 1/min" is "300 rpm"'),
    ],
)
def test_words_of_other_programs_are_understood(lines: str, hint: str) -> None:
    with pytest.raises(InputError, match=hint):
        parse_case(f'case = "mechanism"\n{lines}', "mine.toml")


def test_the_name_of_a_template_in_the_place_of_a_case_is_explained() -> None:
    with pytest.raises(InputError, match="write its case file with `tribodyn new pendulum`"):
        load_case("pendulum")
