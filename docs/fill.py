"""Write tables and measured numbers into the pages of the manual, or name the pages that differ.

python docs/fill.py [--numbers numbers.json] [--made folder] [--check]

A page is complete as a file: what a list of the program, a stored measurement or a run gives stands in it,
between two comments. ``<!-- table: NAME -->`` and ``<!-- end -->`` enclose a table of :mod:`tables`,
``<!--= NAME -->`` and ``<!--/-->`` a number that ``docs/plots/measured.py`` measures, and
``<!-- made: FILE -->`` and ``<!-- end -->`` the text of a file that a script of ``docs/plots`` writes.
"""

from __future__ import annotations

import json
import re
import sys
from argparse import ArgumentParser
from collections.abc import Mapping
from decimal import Decimal
from pathlib import Path
from typing import Final

DOCS: Final = Path(__file__).parent
PAGES: Final = (DOCS.parent / "README.md", DOCS.parent / "packages/mebdf/README.md", *DOCS.rglob("*.md"))
TABLE: Final = re.compile(r"(<!-- table: ([^>]+?) -->\n).*?(<!-- end -->)", re.DOTALL)
MADE: Final = re.compile(r"(<!-- made: ([^>]+?) -->\n).*?(<!-- end -->)", re.DOTALL)
IMAGE: Final = re.compile(r"(!\[[^\]]*\]\()([^/)]+\))")
NUMBER: Final = re.compile(r"(<!--= ([^>]+?) -->)(.*?)(<!--/-->)")
_DIGITS: Final = re.compile(r"\d+(?:\.\d+)?(?:e[+-]?\d+)?")


def pages() -> list[Path]:
    """Return the pages that people write, with what the manual includes."""
    built = {"_build", "generated", "jupyter_execute"}
    return sorted(page for page in PAGES if not built & set(page.relative_to(DOCS.parent).parts))


def filled(text: str, numbers: Mapping[str, str]) -> str:
    """Return a page with its tables made anew, and the numbers that are given."""
    text = TABLE.sub(lambda found: f"{found[1]}\n{_lines(found[2])}\n\n{found[3]}", text)
    return NUMBER.sub(lambda found: _number(found, numbers), text)


def with_made(page: Path, text: str, folder: Path) -> str:
    """Return a page with the texts that scripts have written into a folder."""

    def put(found: re.Match[str]) -> str:
        file = folder / found[2]
        if not file.exists():
            return found[0]
        place = f"{'../' * (len(page.relative_to(DOCS).parts) - 1)}_static/generated/{Path(found[2]).parent}/"
        new = IMAGE.sub(rf"\g<1>{place}\g<2>", file.read_text(encoding="utf-8"))
        new = f"{found[1]}\n{new.strip()}\n\n{found[3]}"
        return found[0] if alike(found[0], new) else new

    return MADE.sub(put, text)


def _lines(name: str) -> str:
    # The model's tables are imported where one is wanted: the lists of the program take a second.
    from tables import TABLES

    return "\n".join(TABLES[name]()).strip()


def _number(found: re.Match[str], numbers: Mapping[str, str]) -> str:
    new = numbers.get(found[2], found[3])
    return found[0] if alike(found[3], new) else f"{found[1]}{new}{found[4]}"


def alike(old: str, new: str) -> bool:
    """Return whether two texts differ by one unit of the last digit of their numbers at most.

    Integrators that are not ours, and what is computed after a run, round differently on other processors.
    """
    if _DIGITS.sub("#", old) != _DIGITS.sub("#", new):
        return False
    pairs = zip(map(Decimal, _DIGITS.findall(old)), map(Decimal, _DIGITS.findall(new)), strict=True)
    return all(abs(one - other) <= _unit(one) for one, other in pairs)


def _unit(value: Decimal) -> Decimal:
    """Return one unit of the last digit."""
    return Decimal(1).scaleb(int(value.as_tuple().exponent))


def main() -> int:
    """Fill the pages, or only compare them."""
    parser = ArgumentParser(description=__doc__.partition("\n")[0] if __doc__ else None)
    parser.add_argument("--numbers", type=Path, help="from docs/plots/measured.py")
    parser.add_argument("--made", type=Path, default=DOCS, help="where scripts of docs/plots have drawn")
    parser.add_argument("--check", action="store_true", help="change nothing; fail where a page differs")
    args = parser.parse_args()
    numbers = json.loads(args.numbers.read_text(encoding="utf-8")) if args.numbers else {}
    different = []
    for page in pages():
        text = page.read_text(encoding="utf-8")
        new = with_made(page, filled(text, numbers), args.made)
        if new != text:
            different.append(page)
            if not args.check:
                page.write_text(new, encoding="utf-8")
    for page in different:
        print(f"{'differs' if args.check else 'written'}: {page.relative_to(DOCS.parent)}")
    if args.check and different:
        print("`make pages` writes what the program and its runs give", file=sys.stderr)
    return int(args.check and bool(different))


if __name__ == "__main__":
    sys.exit(main())
