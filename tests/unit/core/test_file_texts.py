"""Texts of files: what is none says what it is, and what to do."""

from __future__ import annotations

import pytest

from tribodyn.core.files import text_of


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
