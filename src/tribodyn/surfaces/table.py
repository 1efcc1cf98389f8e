"""A table of numbers in a text, made block by block while it is read."""

from __future__ import annotations

import math
import re
from array import array
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import BinaryIO, Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.core.files import ARCHIVES, SEPARATORS, is_comment, text_of, with_points
from tribodyn.core.quoting import as_given
from tribodyn.surfaces.scan import MOST_POINTS

_MARKS: Final = tuple(mark.encode() for mark in SEPARATORS)
BLOCK: Final = 1_000_000  #: Bytes that are read at a time.


@dataclass(frozen=True, slots=True)
class Line:
    """A line of the file, or a piece of a line that is longer than a block."""

    number: int
    text: str
    goes_on: bool = False  #: Whether more of it follows; the piece ends with a separator then.


@dataclass(frozen=True, slots=True)
class Block:
    """Lines that follow each other."""

    number: int  #: Of the first line in the file, counted from 1.
    texts: list[str]
    goes_on: bool  #: Whether the last line goes on in the next block.
    begun: bool = False  #: Whether the first line began in the block before.

    def lines(self) -> Iterator[Line]:
        """Give the lines that are not blank."""
        last = len(self.texts) - 1
        for place, text in enumerate(self.texts):
            begun, goes_on = self.begun and place == 0, self.goes_on and place == last
            if begun or goes_on or (text and not text.isspace()):
                yield Line(self.number + place, text, goes_on)

    def with_points(self, separator: str) -> Block:
        """Return the lines with points in the place of decimal commas."""
        return replace(self, texts=[with_points(text, separator) for text in self.texts])

    def after(self, number: int) -> Block:
        """Return the lines from a number on."""
        return Block(number, self.texts[number - self.number :], self.goes_on)


def blocks(stream: BinaryIO, source: str) -> Iterator[Block]:
    """Give the lines of a file.

    ``stream``: an open file. Raises InputError if the file is empty or binary, or has a piece as long as a
    block that no separator divides.
    """
    number, start, goes_on, rest, more = 1, 0, False, b"", True
    while more:
        read = stream.read(BLOCK)
        more = len(read) == BLOCK
        content = rest + read
        if not (content or goes_on):
            break
        end = _end(content, number, source) if more else len(content)
        texts = _decoded(content[:end], start, source).splitlines() or [""]
        begun, goes_on = goes_on, more and content[end - 1 : end] in _MARKS
        yield Block(number, texts, goes_on, begun)
        number, start, rest = number + len(texts) - goes_on, start + end, content[end:]
    if start == 0:
        raise InputError("the file is empty", source=source)


def _end(content: bytes, number: int, source: str) -> int:
    """Return the end of a block: after the last line of the content, or the last field of a long one."""
    # A carriage return at the very end may have its line feed in what comes next.
    end = max(content.rfind(b"\n"), content.rfind(b"\r", 0, -1)) + 1
    if end == 0:
        mark = next((mark for mark in _MARKS if mark in content), b"\n")
        end = content.rfind(mark) + 1
    if end == 0:
        raise too_long(number, source)
    return end


def too_long(number: int, source: str) -> InputError:
    """Return the error of a comment or a field that does not end."""
    return InputError(f"line {number} has a comment or field of more than {BLOCK} characters", source=source)


def _decoded(content: bytes, start: int, source: str) -> str:
    if b"\0" in content and not content.startswith(ARCHIVES):
        raise InputError("this is a binary file, not text with commas", source=source)
    try:
        return text_of(content, start)
    except ValueError as error:
        raise InputError(str(error), source=source) from None


_MISSING: Final = ("", "nan")
_NUMBER: Final = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)
_DECIMAL_COMMA: Final = re.compile(r"[+-]?\d+,\d+", re.ASCII)
#: In such a text Python takes for a number what is one here.
_PLAIN: Final = re.compile(r"[\d\s.,;eE+-]*+(?:(?<![+-])nan[\d\s.,;eE+-]*+)*", re.ASCII | re.IGNORECASE)


class Table:
    """Lines of equally many numbers.

    ``separator``: what stands between the fields of a line; ``width``: fields of a line; by default those of
    the first line; ``comment``: called with comments between the lines; ``source``: name of the file.
    """

    def __init__(
        self, separator: str, width: int | None, comment: Callable[[Line], None], source: str
    ) -> None:
        self._separator = separator
        self._width = width
        self._comment = comment
        self._source = source
        self._values = array("d")
        self._fields = 0
        """Of a line that goes on, so far."""

    def values(self) -> FloatArray:
        """Return the numbers as they stand, shape (lines, fields); NaN where one is missing."""
        return np.frombuffer(self._values).reshape(-1, self._width or 1)

    def add(self, block: Block) -> None:
        """Add the lines of a block.

        Raises InputError if a field is no number, a line has another number of fields, or there are too many
        of them.
        """
        if not self._add_at_once(block):
            for line in block.lines():
                self._add_line(line)

    def _add_at_once(self, block: Block) -> bool:
        """Add a block of plain numbers, as nearly all are; False if its lines must be looked at."""
        if self._width is None or self._fields or block.goes_on:
            return False
        texts = [text for text in block.texts if text and not text.isspace()]
        if not texts:
            return True
        if any(text.count(self._separator) != self._width - 1 for text in texts):
            return False
        values = self._plain(self._separator.join(texts))
        if values is None:
            return False
        self._extend(values)
        return True

    def _add_line(self, line: Line) -> None:
        if not self._fields and is_comment(line.text):
            self._comment(line)
            return
        text = line.text.removesuffix(self._separator) if line.goes_on else line.text
        self._fields += text.count(self._separator) + 1
        if not line.goes_on:
            self._end_line(line.number)
        values = self._plain(text)
        self._extend(self._looked_at(text, line.number) if values is None else values)

    def _end_line(self, number: int) -> None:
        if self._width is None:
            self._width = self._fields
        if self._fields != self._width:
            raise InputError(
                f"line {number} has {self._fields} fields where {self._width} are needed; "
                "is the file cut off?",
                source=self._source,
            )
        self._fields = 0

    def _plain(self, text: str) -> array[float] | None:
        """Return the numbers in a text, None where one may be wrong."""
        if _PLAIN.fullmatch(text) is None:
            return None
        try:
            return array("d", [float(word or "nan") for word in text.split(self._separator)])
        except ValueError:
            return None

    def _looked_at(self, text: str, number: int) -> array[float]:
        return array("d", [self._number(word.strip(), number) for word in text.split(self._separator)])

    def _number(self, word: str, line: int) -> float:
        if word.lower() in _MISSING:
            return math.nan
        if _NUMBER.fullmatch(word) is None:
            hint = "; write a decimal point, not a comma" if _DECIMAL_COMMA.fullmatch(word) else ""
            raise InputError(
                f"line {line}: {as_given(word)}; allowed: a number, or nothing or nan if it is missing{hint}",
                source=self._source,
            )
        return float(word)

    def _extend(self, values: Sequence[float]) -> None:
        if len(self._values) + len(values) > MOST_POINTS:
            raise InputError(
                f"more than {MOST_POINTS} heights; cut out a part of the scan", source=self._source
            )
        self._values.extend(values)
