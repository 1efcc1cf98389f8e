"""Units that cases are written in every day, with their exact sizes: with these alone pint is not loaded.

What pint makes of each is the same; a test compares them all.
"""

import re
from typing import Final

#: Sizes in base units, as decimals, by the base unit and then by the unit.
SIZES: Final = {
    "1 / kelvin": {"1/K": "1"},
    "1 / meter ** 2": {"1/m^2": "1", "1/mm^2": "1E+6", "1/um^2": "1E+12"},
    "kilogram / meter / second ** 2": {
        "GPa": "1E+9",
        "HB": "9.80665E+6",
        "HV": "9.80665E+6",
        "MPa": "1E+6",
        "Pa": "1",
        "bar": "1E+5",
        "kPa": "1E+3",
    },
    "kilogram * meter / kelvin / second ** 3": {"W/(m K)": "1"},
    "kelvin": {"K": "1", "degC": "1"},
    "kilogram * meter / second ** 2": {"MN": "1E+6", "N": "1", "kN": "1E+3"},
    "kilogram / meter ** 2 / second ** 2": {"MPa/um": "1E+12", "Pa/m": "1"},
    "kilogram * meter ** 2 / second ** 2": {"N m": "1", "N mm": "0.001", "N*m": "1", "Nm": "1"},
    "kilogram * meter ** 2 / radian / second": {"N m s/rad": "1"},
    "kilogram * meter ** 2 / radian / second ** 2": {"N m/rad": "1"},
    "kilogram / second": {"N s/m": "1"},
    "kilogram / second ** 2": {"N/m": "1", "N/mm": "1E+3", "N/um": "1E+6"},
    "kilogram / meter / second": {"Pa s": "1", "mPa s": "0.001"},
    "meter ** 2 / second": {"cSt": "0.000001", "m^2/s": "1", "mm^2/s": "0.000001"},
    "meter": {"cm": "0.01", "m": "1", "mm": "0.001", "nm": "1E-9", "um": "0.000001"},
    "meter ** 2": {"cm^2": "0.0001", "m^2": "1", "mm^2": "0.000001"},
    "meter ** 3": {"m^3": "1", "mm^3": "1E-9"},
    "meter ** 4": {"m^4": "1", "mm^4": "1E-12"},
    "kilogram * meter ** 3 / second ** 2": {"N m^2": "1"},
    "radian": {"deg": "0.01745329251994329576923690768", "mrad": "0.001", "rad": "1"},
    "radian / second": {
        "deg/s": "0.01745329251994329576923690768",
        "mrad/s": "0.001",
        "rad/s": "1",
        "rpm": "0.1047197551196597746154214461",
    },
    "kilogram": {"g": "0.001", "kg": "1"},
    "second": {"h": "3600", "min": "60", "ms": "0.001", "s": "1", "us": "0.000001"},
    "kilogram * meter ** 2": {"kg m^2": "1"},
    "kilogram / meter ** 3": {"kg/m^3": "1"},
    "meter / second": {"m/s": "1", "mm/s": "0.001", "um/s": "0.000001"},
    "meter / second ** 2": {"m/s^2": "1"},
    "meter * second ** 2 / kilogram": {"m^2/N": "1", "mm^3/(N m)": "1E-9", "mm^3/N/m": "1E-9"},
    "1 / second": {"Hz": "1"},
    "dimensionless": {"percent": "0.01"},
    "second / meter": {"s/m": "1"},
}
#: Names in these units.
EVERYDAY: Final = frozenset(
    name for units in SIZES.values() for unit in units for name in re.findall("[A-Za-z]+", unit)
)
ZEROS: Final = {"degC": "273.15"}  #: Origins of units that do not count from zero, in base units.
