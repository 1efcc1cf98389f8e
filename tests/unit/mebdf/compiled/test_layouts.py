"""Arguments of compiled code are taken apart into words; what does not fit is refused."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from mebdf.arrays import FloatArray, FloatMatrix
from mebdf.compiled.layouts import STACKED, Absent, Array, Number, One, Tuple, annotated

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


def test_an_annotation_that_says_too_little_is_named() -> None:
    def vague(x: Any) -> None:
        """Say nothing of the argument."""

    with pytest.raises(TypeError, match="no layout follows from the annotation"):
        annotated(vague)


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
