"""Texts of files and words of people: tables, marks, quotes."""

from __future__ import annotations

import time

import pytest

from tribodyn.cases.keys import keys_of
from tribodyn.cli.main import COMMANDS
from tribodyn.core.errors import InputError
from tribodyn.core.files import named, text_of
from tribodyn.core.quoting import synonyms
from tribodyn.mechanism.elements import ELEMENTS
from tribodyn.mechanism.joints import JOINTS
from tribodyn.mechanisms.catalogue import kinds, load_case, parse_case

LONG = 100_000
QUICK = 1.0  #: Processor time of any header of this length [s]; a thousand times what it takes.


@pytest.mark.parametrize(
    ("cell", "expected"),
    [
        ("time [ms]", ("time", "ms")),
        ('"Position (mm)"', ("Position", "mm")),
        ("torque (net) [N m]", ("torque (net)", "N m")),
        ("torque (net) (N m)", ("torque (net)", "N m")),
        (" x ", ("x", None)),
        ("x ()", ("x ()", None)),
        ("x )", ("x )", None)),
        ("[m]", ("", "m")),
        ('" x [m] "', ("x", "m")),
        ("", ("", None)),
        ("x []", None),
        ("x [m", None),
        ("x m]", None),
        ("x [m]]", None),
        ("x [a] (m)", None),
        ('x "y" [m]', None),
    ],
)
def test_name_and_unit(cell: str, expected: tuple[str, str | None] | None) -> None:
    assert named(cell) == expected


@pytest.mark.parametrize(
    "cell",
    [
        "x" + " " * LONG + "[",
        "(" * LONG,
        ")" * LONG,
        "()" * LONG,
        '"' + " " * LONG + '"x',
        " (" * LONG + ")",
        "[" * LONG,
        "x" * LONG + "(",
    ],
)
def test_no_header_takes_long(cell: str) -> None:
    """A regular expression took 40 minutes for 10,000 blanks."""
    began = time.process_time()
    named(cell)
    assert time.process_time() - began < QUICK


@pytest.mark.parametrize("content", [b"a,b\n", "\ufeffa,b\n".encode()])
def test_a_text_is_read_with_or_without_its_mark(content: bytes) -> None:
    assert text_of(content) == "a,b\n"


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("# ok\n# Führung\n".encode("cp1252"), r"byte 8, line 2\); save it with the encoding UTF-8"),
        (b"PK\x03\x04and so on", "a workbook or a document .* save the sheet as CSV"),
        (b"\xd0\xcf\x11\xe0and so on", "a workbook"),
    ],
)
def test_what_is_no_text_says_what_to_do(content: bytes, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        text_of(content)


def test_a_part_of_a_file_says_where_in_the_file_it_ends() -> None:
    with pytest.raises(ValueError, match="byte 1003"):
        text_of(b"1,2\xff", 1000)


BODY = '[bodies.rod]\nmass = "1 kg"\ncentre = "0, 0, 0 mm"\ninertia = "1e-4, 1e-4, 1e-4 kg m^2"\n'
JOINT = '[joints.pivot]\nbetween = ["ground", "rod"]\npoint = "0, 0, 0 mm"\naxis = [0, 0, 1]\n'


def test_every_meaning_is_a_word_of_ours() -> None:
    keys = keys_of(kinds()["mechanism"])
    names = {part for path in keys for part in path.split(".")}
    ours = {*JOINTS, *COMMANDS, *names, *(kind.METHOD for kind in ELEMENTS), "drive", "load", "ground"}
    assert {word for meant in synonyms().values() for word in meant} <= ours


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
