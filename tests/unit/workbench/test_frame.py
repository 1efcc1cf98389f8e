"""Frames, and the runs that are kept."""

import numpy as np
from tests.unit.workbench.host import unframed

from tribodyn.views.encode import packed
from tribodyn.workbench import messages
from tribodyn.workbench.server_state import KeptRuns


def test_arrays_stand_where_the_header_says_at_multiples_of_eight():
    arrays = {"f32": np.arange(3.0), "u8": np.arange(5), "f64": np.array([np.pi, np.nan])}
    kinds = {"f32": "float32", "u8": "uint8", "f64": "float64"}
    made = messages.body({"ä": [{kind: packed(values, kinds[kind])} for kind, values in arrays.items()]})
    answer = unframed(messages.addressed(made, 7, messages.KEPT))
    assert (answer.number, answer.flags) == (7, messages.KEPT)
    for found, (kind, values) in zip(answer.header["ä"], arrays.items(), strict=True):
        offset, length = found[kind][kind]
        assert offset % 8 == 0
        assert np.array_equal(
            np.frombuffer(answer.data, np.dtype(kinds[kind]).newbyteorder("<"), length, offset),
            values.astype(kinds[kind]),
            equal_nan=True,
        )
    assert messages.header(made) == answer.header


def test_of_runs_the_last_and_the_pinned_are_kept_and_others_as_there_is_room():
    runs = KeptRuns(room=25)
    for run in "abcd":
        runs.keep(run, f"case {run}", b"x" * 10)
        if run == "a":
            assert runs.pin("a")
    assert [run for run in "abcd" if runs.frame(run)] == ["a", "d"]
    assert runs.cases["b"] == "case b", "texts take no room"
    runs.unpin("a")
    runs.keep("e", "case e", b"x" * 30)
    assert list(runs.frames) == ["e"]
    assert not runs.pin("nothing")
