"""TOML from strangers: what would cost more than its length suggests is refused before it is parsed.

The parser calls itself for every bracket, and keeps all beginnings of a dotted key. One pass over the text
finds how deep both go, strings and comments left out; the first string that does not end is where the parser
will stop, too, so nothing behind it counts.

Groups are repeated in atomic groups: Python before 3.11.5 matches them wrongly where they are repeated
possessively.
"""

import re
import tomllib
from typing import Any, Final

LARGEST: Final = 1_000_000
"""Length of a text that is parsed, at most; a case with all its comments has 15,000 characters."""
DEEPEST: Final = 20
"""Depth of tables, arrays and dotted keys, each at most; cases are four deep."""
_MOST_MARKS: Final = 100_000
"""Dots, brackets, commas, equals signs and lines, at most: a table costs up to a kilobyte for each."""

_MARKS: Final = re.compile(
    r'''
    """(?>[^"\\]*+(?:(?:\\.|"{1,2}(?!"))[^"\\]*+)*)"{3,5}
    | \'\'\'(?>[^']*+(?:'{1,2}(?!')[^']*+)*)'{3,5}
    | "(?!"")(?>[^"\\\n]*+(?:\\.[^"\\\n]*+)*)"
    | '(?!'')[^'\n]*+'
    | \#[^\n]*+
    | (?P<open>[\[{]) | (?P<close>[\]}]) | (?P<dot>\.) | (?P<next>[,=\n]) | (?P<broken>["'])
    ''',
    re.VERBOSE | re.DOTALL,
)


def parse(text: str) -> dict[str, Any]:
    """Return the tables of a TOML text.

    Parameters
    ----------
    text
        Whatever somebody wrote.

    Raises
    ------
    ValueError
        It is not valid TOML, too long, too deep or has too many entries; the message says which.
    """
    if len(text) > LARGEST:
        raise ValueError(f"longer than {LARGEST} characters")
    _refuse_depth(text)
    return tomllib.loads(text)


def _refuse_depth(text: str) -> None:
    """Refuse a text that would cost the parser much time or memory; linear in the length of the text."""
    depth = dots = marks = 0
    for match in _MARKS.finditer(text):
        kind = match.lastgroup
        if kind is None:
            continue
        if kind == "broken":
            return
        depth += (kind == "open") - (kind == "close")
        dots = dots + 1 if kind == "dot" else 0
        marks += 1
        if max(depth, dots) >= DEEPEST:
            raise ValueError(f"nested too deeply, more than {DEEPEST} levels")
        if marks > _MOST_MARKS:
            raise ValueError("too many entries")


def in_braces(error: str) -> str:
    """Return the message on a table in braces that is continued elsewhere; empty for any other error."""
    if not error.startswith("Cannot declare ("):
        return ""
    *above, last = re.findall(r"'([^']*)'", error)
    table = ".".join(above)
    words = (
        f"{above[-1] if above else last} = {{...}} is closed by its brace, so [{table}.{last}] cannot follow"
    )
    return f"{words}; write [{table}] with a line for each key instead of the braces"
