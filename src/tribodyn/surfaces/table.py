"""A table of numbers in a text, read line by line."""

import math
import re
from array import array
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from typing import BinaryIO, Final, NamedTuple

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.core.files import ARCHIVES, is_comment, text_of, with_points
from tribodyn.core.quoting import as_given
from tribodyn.surfaces.scan import MOST_POINTS

LONGEST_LINE: Final = 100_000_000  #: Bytes of a line, at most: a profile may stand in a single one.
MOST_WORDS: Final = 1_000_000  #: Lines without numbers, at most: blank ones, comments, words.
_WORDS: Final = re.compile(r"\s*+(?:$|[#%/]|(?!nan)[^\W\d])", re.IGNORECASE)
_MISSING: Final = ("", "nan")
_NUMBER: Final = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)
_DECIMAL_COMMA: Final = re.compile(r"[+-]?\d+,\d+", re.ASCII)
#: In such a text Python takes for a number what is one here.
_PLAIN: Final = re.compile(r"[\d\s.,;eE+-]*+(?:(?<![+-])nan[\d\s.,;eE+-]*+)*", re.ASCII | re.IGNORECASE)


class Line(NamedTuple):
    """A line of a file."""

    number: int  #: Counted from 1.
    text: str


def lines(stream: BinaryIO, source: str) -> Iterator[Line]:
    """Give the lines of a file that are not blank.

    ``stream``: an open file. Raises InputError if the file is empty or binary, a line is too long, or there
    are too many lines without numbers.
    """
    number = start = words = 0
    while content := stream.readline(LONGEST_LINE):
        if len(content) == LONGEST_LINE:
            raise InputError(f"line {number + 1} has {LONGEST_LINE} characters or more", source=source)
        for text in _decoded(content, start, source).splitlines():
            number += 1
            words += _WORDS.match(text) is not None
            if text and not text.isspace():
                yield Line(number, text)
        if words > MOST_WORDS:
            raise InputError(f"more than {MOST_WORDS} lines hold no numbers", source=source)
        start += len(content)
    if start == 0:
        raise InputError("the file is empty", source=source)


def _decoded(content: bytes, start: int, source: str) -> str:
    if b"\0" in content and not content.startswith(ARCHIVES):
        raise InputError("this is a binary file, not text with commas", source=source)
    try:
        return text_of(content, start)
    except ValueError as error:
        raise InputError(str(error), source=source) from None


def table(
    every: Iterable[Line], separator: str, width: int | None, comment: Callable[[Line], object], source: str
) -> FloatArray:
    """Return the numbers of lines of equally many numbers, shape (lines, fields); NaN where one is missing.

    ``separator``: what stands between the fields of a line; ``width``: fields of a line, by default those of
    the first one; ``comment``: called with comments between the lines; ``source``: name of the file. Raises
    InputError if a field is no number, a line has another number of fields, or there are too many of them.
    """
    values = array("d")
    for line in every:
        if is_comment(line.text):
            comment(line)
            continue
        text = with_points(line.text, separator)
        fields = text.count(separator) + 1
        width = width or fields
        if fields != width:
            raise InputError(
                f"line {line.number} has {fields} fields where {width} are needed; is the file cut off?",
                source=source,
            )
        if len(values) + fields > MOST_POINTS:
            raise InputError(f"more than {MOST_POINTS} heights; cut out a part of the scan", source=source)
        values.extend(_numbers(text, separator, line.number, source))
    return np.frombuffer(values).reshape(-1, width or 1)


def _numbers(text: str, separator: str, line: int, source: str) -> list[float]:
    """Return the numbers of a line."""
    words = text.split(separator)
    if _PLAIN.fullmatch(text) is not None:
        with suppress(ValueError):
            return [float(word or "nan") for word in words]
    return [_number(word.strip(), line, source) for word in words]


def _number(word: str, line: int, source: str) -> float:
    if word.lower() in _MISSING:
        return math.nan
    if _NUMBER.fullmatch(word) is None:
        hint = "; write a decimal point, not a comma" if _DECIMAL_COMMA.fullmatch(word) else ""
        raise InputError(
            f"line {line}: {as_given(word)}; allowed: a number, or nothing or nan if it is missing{hint}",
            source=source,
        )
    return float(word)
