"""Numbers in the prose of a page: what is left once code, formulas, roles and links are removed."""

import re
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).parents[3]
DOCS: Final = ROOT / "docs"
SOLVER: Final = ROOT / "packages" / "mebdf" / "README.md"
#: Tables and numbers that ``docs/fill.py`` writes, front matter, fences, code, formulas, roles, links.
REMOVED: Final = (
    re.compile(r"<!-- (?:table|made): .*?<!-- end -->", re.DOTALL),
    re.compile(r"<!--= .*?<!--/-->"),
    re.compile(r"\A---\n.*?^---\n", re.DOTALL | re.MULTILINE),
    re.compile(r"^```.*?^```[^\n]*$", re.DOTALL | re.MULTILINE),
    re.compile(r"^ {4}.*$", re.MULTILINE),
    re.compile(r"\$\$.*?\$\$", re.DOTALL),
    re.compile(r"\{\w+\}`[^`]*`"),
    re.compile(r"`[^`]*`"),
    re.compile(r"\$[^$]*\$"),
    re.compile(r"(?<=\])\([^)]*\)"),
)
UNITS: Final = (
    "%|°|µm/s|mm/s|m/s²|m/s|rad/s|MPa/µm|MPa|GPa|kPa|Pa s|Pa|µm|nm|mm³|mm|m²/N|m|kN|mN|N mm|N m|N|µs|ms|s/m|s"
    "|mJ|J|Hz|kHz|mrad|rad|K|g|kg|kg m²|σ|MB|cycles|steps|times|revolutions"
)
#: A number with its unit, and any number with a point or an exponent.
NUMBER: Final = re.compile(
    rf"(?<![\w.])[+−-]?\d+(?:[.,]\d+)*(?:e[+-]?\d+)?\s?(?:{UNITS})(?![\w²³])"
    r"|(?<![\w.])[+−-]?\d+\.\d+(?:e[+-]?\d+)?(?![\w.])"
    r"|(?<![\w.])\d+e[+-]?\d+(?!\w)"
)


def pages() -> list[Path]:
    """Return the pages of the manual and what it includes, and the README."""
    built = {"_build", "_static", "generated", "jupyter_execute"}
    return [ROOT / "README.md", SOLVER, *(p for p in sorted(DOCS.rglob("*.md")) if not built & set(p.parts))]


def name(page: Path) -> str:
    """Return the name of a page in the list of numbers."""
    return str(page.relative_to(DOCS if page.is_relative_to(DOCS) else ROOT))


def prose(page: Path) -> str:
    """Return the text of a page that may hold numbers by hand."""
    text = page.read_text(encoding="utf-8")
    for pattern in REMOVED:
        text = pattern.sub(" ¶ ", text)
    return text


def numbers(text: str) -> list[re.Match[str]]:
    """Return the numbers of a text."""
    return list(NUMBER.finditer(text))
