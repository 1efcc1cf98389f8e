"""The lines of a text file, block by block: whatever the file is, little more than one block is held."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import BinaryIO, Final

from tribodyn.core.delimited import SEPARATORS, with_points
from tribodyn.core.errors import InputError
from tribodyn.core.files import ARCHIVES, text_of

_MARKS: Final = tuple(mark.encode() for mark in SEPARATORS)
BLOCK: Final = 1_000_000
"""Bytes that are read at a time."""


@dataclass(frozen=True, slots=True)
class Line:
    """A line of the file, or a piece of a line that is longer than a block."""

    number: int
    text: str
    goes_on: bool = False
    """Whether more of it follows; the piece ends with a separator then."""


@dataclass(frozen=True, slots=True)
class Block:
    """Lines that follow each other."""

    number: int
    """Of the first line in the file, counted from 1."""
    texts: list[str]
    goes_on: bool
    """Whether the last line goes on in the next block."""
    begun: bool = False
    """Whether the first line began in the block before."""

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

    Parameters
    ----------
    stream
        An open file.
    source
        Its name.

    Raises
    ------
    InputError
        The file is empty or binary, or has a piece as long as a block that no separator divides.
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
