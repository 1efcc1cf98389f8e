"""What messages repeat of what a user gave."""

from __future__ import annotations

from typing import Final

LONGEST: Final = 80
"""Characters of a given text that a message repeats at most."""


def brief(text: object, most: int = LONGEST) -> str:
    """Return a text as messages quote it: whole, or its two ends where it is long.

    Parameters
    ----------
    text
        Whatever was given; what is no text is quoted as Python writes it.
    most
        Length of what is returned, at most.

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


def as_given(text: str) -> str:
    """Return how a message about a wrong text begins."""
    return f'given "{brief(text)}"'
