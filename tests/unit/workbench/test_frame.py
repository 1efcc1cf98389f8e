"""Frames, and what a visitor's runs are kept as."""

from __future__ import annotations

import numpy as np
import pytest
from tests.unit.workbench.host import unframed

from tribodyn.views.encode import packed
from tribodyn.workbench import frame
from tribodyn.workbench.visitor import MOST_CASES, Visitor


def test_arrays_stand_where_the_header_says_at_multiples_of_eight():
    arrays = {"f32": np.arange(3.0), "u8": np.arange(5), "f64": np.array([np.pi, np.nan])}
    kinds = {"f32": "float32", "u8": "uint8", "f64": "float64"}
    made = frame.body({"ä": [{kind: packed(values, kinds[kind])} for kind, values in arrays.items()]})
    answer = unframed(frame.addressed(made, 7, frame.KEPT))
    assert (answer.number, answer.flags) == (7, frame.KEPT)
    for found, (kind, values) in zip(answer.header["ä"], arrays.items(), strict=True):
        offset, length = found[kind][kind]
        assert offset % 8 == 0
        assert np.array_equal(
            np.frombuffer(answer.data, np.dtype(kinds[kind]).newbyteorder("<"), length, offset),
            values.astype(kinds[kind]),
            equal_nan=True,
        )
    assert frame.header(made) == answer.header


def test_equal_arrays_stand_there_once():
    times, values = packed(np.arange(100.0), "float64"), packed(np.ones(100))
    made = frame.body({"a": [times, values], "b": [packed(np.arange(100.0), "float64"), packed([])]})
    header = frame.header(made)
    assert header["a"][0] == header["b"][0]
    assert header["a"][1] != header["a"][0]
    assert len(made) < len(frame.body({"a": [times, values]})) + 100


def test_a_header_holds_no_nan():
    with pytest.raises(ValueError, match="not JSON compliant"):
        frame.body({"x": float("nan")})


def test_of_runs_the_last_and_the_pinned_are_kept_and_others_as_there_is_room():
    visitor = Visitor(room=25)
    for run in "abcd":
        visitor.keep(run, f"case {run}", b"x" * 10)
        if run == "a":
            assert visitor.pin("a")
    assert [run for run in "abcd" if visitor.frame(run)] == ["a", "d"]
    assert visitor.cases["b"] == "case b", "texts take no room"
    visitor.unpin("a")
    visitor.keep("e", "case e", b"x" * 30)
    assert list(visitor.frames) == ["e"]
    assert not visitor.pin("nothing")


def test_texts_of_cases_are_forgotten_in_time():
    visitor = Visitor(room=1)
    for number in range(MOST_CASES + 10):
        visitor.keep(str(number), "", b"xx")
    assert len(visitor.cases) == MOST_CASES
    assert str(MOST_CASES + 9) in visitor.cases
