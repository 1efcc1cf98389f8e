"""Arguments of compiled code are taken apart into words; what does not fit is refused."""

from __future__ import annotations

import struct
from types import GenericAlias, SimpleNamespace
from typing import Annotated, Any, NamedTuple, TypeVar

import numpy as np
import pytest
from numpy.typing import NDArray

from mebdf.arrays import FloatArray, FloatMatrix
from mebdf.compiled.layouts import (
    STACKED,
    Absent,
    Array,
    Number,
    One,
    Tuple,
    annotated,
    digest,
    layout_of,
    of_hint,
)

FIELDS = np.dtype((np.record, [("a", "f8"), ("b", "i8", (2,))]))
OTHER = np.dtype((np.record, [("a", "f8"), ("c", "i8", (2,))]))
FLOAT = np.dtype(float)


class Data(NamedTuple):
    record: Annotated[Any, FIELDS]
    matrix: FloatMatrix
    size: float


def called(
    t: float,
    n: int,
    y: FloatArray,
    data: Data,
    many: Annotated[Data, STACKED],
    own: None,
    on: NDArray[np.bool_],
) -> None:
    """Have one argument of each kind."""


def record(fields: np.dtype[Any] = FIELDS) -> Any:
    return np.zeros(1, fields)[0]


def test_annotations_say_the_layouts() -> None:
    number = Number(float)
    assert annotated(called) == (
        *(number, Number(int), Array(FLOAT, 1)),
        Tuple(Data, (One(FIELDS), Array(FLOAT, 2), number)),
        Tuple(Data, (Array(FIELDS, 1), Array(FLOAT, 3), Array(FLOAT, 1))),
        *(Absent(), Array(np.dtype(bool), 1)),
    )


def test_an_annotation_may_be_a_type_alias() -> None:
    entry = TypeVar("entry", bound=np.generic)
    generic = GenericAlias(SimpleNamespace(__value__=np.ndarray[Any, np.dtype[entry]]), (np.float64,))  # type: ignore[arg-type]
    plain = SimpleNamespace(__value__=generic)
    assert of_hint(generic) == of_hint(plain) == of_hint(NDArray[np.float64]) == Array(FLOAT, 1)


def test_an_annotation_that_says_too_little_is_named() -> None:
    def vague(x: Any) -> None:
        """Say nothing of the argument."""

    with pytest.raises(TypeError, match="no layout follows from the annotation"):
        annotated(vague)


def test_words_are_those_of_numba() -> None:
    matrix = np.arange(6.0).reshape(2, 3)
    assert Number(float).words(1.5) == struct.unpack("<q", struct.pack("<d", 1.5))
    assert Number(int).words(np.int64(-3)) == (-3,)
    assert Array(FLOAT, 2).words(matrix) == (0, 0, 6, 8, matrix.ctypes.data, 2, 3, 24, 8)
    data = Data(record(), matrix, 2.0)
    layout = layout_of(data)
    assert len(layout.words(data)) == layout.size == 11


def test_a_record_is_its_own_memory_and_no_copy() -> None:
    records = np.zeros(2, FIELDS)
    assert One(FIELDS).words(records[1]) == (records.ctypes.data + FIELDS.itemsize,)


READ_ONLY = np.zeros(3)
READ_ONLY.flags.writeable = False
WRONG: list[tuple[Any, Any]] = [
    (Number(float), "1"),
    (Number(float), True),
    (Number(float), None),
    (Number(int), 1.0),
    (Number(int), True),
    (Number(int), 2**63),
    (Number(bool), 1),
    (Array(FLOAT, 1), [1.0]),
    (Array(FLOAT, 1), np.zeros(3, np.float32)),
    (Array(FLOAT, 1), np.zeros(3, ">f8")),
    (Array(FLOAT, 1), np.zeros((1, 3))),
    (Array(FLOAT, 1), np.zeros(6)[::2]),
    (Array(FLOAT, 2), np.zeros((2, 3)).T),
    (Array(FLOAT, 1), READ_ONLY),
    (Array(FLOAT, 1), np.frombuffer(bytearray(17), np.uint8)[1:].view(float)),
    (Array(FIELDS, 1), np.zeros(1, OTHER)),
    (One(FIELDS), record(OTHER)),
    (One(FIELDS), np.zeros(1, FIELDS)),
    (Tuple(Data, (One(FIELDS),)), (record(),)),
    (Absent(), 0),
]


@pytest.mark.parametrize(("layout", "value"), WRONG)
def test_what_does_not_fit_is_refused(layout: Any, value: Any) -> None:
    with pytest.raises(TypeError):
        layout.words(value)


def test_records_with_other_fields_have_another_digest() -> None:
    assert digest((One(FIELDS),)) != digest((One(OTHER),))
    assert digest((One(FIELDS),)) == digest((One(np.dtype(FIELDS.descr)),))
