"""Words of messages: quoted values, and words of other programs with those of this program for them."""

import difflib
import re
import tomllib
from collections.abc import Collection
from functools import cache
from importlib.resources import files
from typing import Final

LONGEST: Final = 80  #: Characters of a given text that a message repeats at most.
GREY: Final = "\x1b[2m"
PLAIN: Final = "\x1b[0m"  #: Escapes that make a terminal write in grey, and as before.


def brief(text: object, most: int = LONGEST) -> str:
    """Return a text as messages quote it: whole, or its two ends where it is long.

    ``text``: whatever was given; what is no text is quoted as Python writes it; ``most``: length of what is
    returned, at most.

    Examples
    --------
    >>> brief("joint.clearance")
    'joint.clearance'
    >>> brief("x" * 1000, 9)
    'xxx...xxx'
    """
    words = str(text)
    end = (most - 3) // 2
    return words if len(words) <= most else f"{words[:end]}...{words[-end:]}"


def on_one_line(text: str) -> str:
    """Return a text with codes for characters that are not printed, such as those that move a cursor."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def without_controls(text: str) -> str:
    """Return a text of several lines with codes for characters that are not printed; some may be grey."""
    parts = re.split(f"({re.escape(GREY)}|{re.escape(PLAIN)}|[\n\t])", text)
    return "".join(part if part in (GREY, PLAIN, "\n", "\t") else on_one_line(part) for part in parts)


def as_given(text: str) -> str:
    """Return the beginning of a message on a wrong text."""
    return f'given "{brief(text)}"'


def meant(word: str, words: Collection[str]) -> str:
    """Return the end of a message that says which of `words` was probably meant, empty where none is near."""
    near = closest(word, words)
    return f'; did you mean "{near}"?' if near else ""


def nearest(word: str, words: Collection[str], number: int = 5) -> str:
    """Return those of many `words` that are most like one that is not among them, and their number.

    Examples
    --------
    >>> nearest("wear", ["wear_depth", "force"])
    'nearest of 2: wear_depth'
    """
    first = closest(word, words)
    alike = difflib.get_close_matches(word[:LONGEST], words, n=number, cutoff=0.4)
    begun = [other for other in words if any(part.startswith(word) for part in other.split("_"))]
    found = [*dict.fromkeys([*([first] if first else []), *begun, *alike])][:number]
    return f"nearest of {len(words)}: {', '.join(found or list(words)[:number])}"


def closest(word: str, words: Collection[str], *, cutoff: float = 0.5) -> str | None:
    """Return the one of `words` that means the same as `word`, or is spelled most like it, if any is.

    ``word``, ``words``: what was given, and what is allowed; ``cutoff``: likeness of the spelling from which
    a word counts, 0 to 1.
    """
    synonym = next((other for other in meanings(word) if other in words), None)
    if synonym is not None:
        return synonym
    by_letters = {other.casefold(): other for other in words}
    found = difflib.get_close_matches(word[:80].casefold(), by_letters, n=1, cutoff=cutoff)
    return by_letters[found[0]] if found else None


#: Words whose values are twice those of the words of this program for them.
OF_DIAMETERS: Final = frozenset({"diameter", "diametral", "diametral_clearance"})


def meanings(word: str) -> tuple[str, ...]:
    """Return the words of this program for a word, none where it is not known.

    Examples
    --------
    >>> meanings("Hinge")
    ('revolute',)
    """
    return tuple(synonyms().get(word.casefold().replace(" ", "-"), ()))


@cache
def synonyms() -> dict[str, list[str]]:
    """Return the words of this program for those of others, the likeliest first."""
    return tomllib.loads(files("tribodyn.core").joinpath("synonyms.toml").read_text(encoding="utf-8"))
