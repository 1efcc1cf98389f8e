"""Kernels and the data of a run are computed by functions that round in the same way on every processor."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import mebdf
import tribodyn
from tribodyn.mechanism import elements

SOLVER, PACKAGE = Path(mebdf.__file__).parent, Path(tribodyn.__file__).parent
KERNELS = [*SOLVER.glob("kernels/**/*.py"), *PACKAGE.glob("kernels/**/*.py")]
LAWS = list(Path(elements.__file__).parent.glob("*.py"))  #: Force laws are compiled, too.
#: Functions of ``math`` and NumPy that the C library or NumPy chooses by the processor.
INEXACT = re.compile(r"(arc|a)?(sin|cos|tan)h?2?|exp[m1|2]*|log\w*|pow|power|float_power|hypot|cbrt|erfc?")


def inexact(source: str) -> Iterator[str]:
    """Yield the uses of such functions, and powers of variables that are not whole numbers."""
    for node in ast.walk(ast.parse(source)):
        match node:
            case ast.Attribute(value=ast.Name(id="math" | "np"), attr=name) if INEXACT.fullmatch(name):
                yield ast.unparse(node)
            case ast.BinOp(op=ast.Pow(), right=ast.Constant(value=int())) | ast.BinOp(left=ast.Constant()):
                pass
            case ast.BinOp(op=ast.Pow()):
                yield ast.unparse(node)


def test_uses_are_found() -> None:
    source = (
        "math.sin(x) + np.arctan2(y, x) + x**2 + x**1.5 + math.sqrt(x) + y**n + np.expand_dims(2.0**-3, 0)"
    )
    assert sorted(inexact(source)) == ["math.sin", "np.arctan2", "x ** 1.5", "y ** n"]


def test_kernels_and_laws_use_no_function_that_depends_on_the_processor() -> None:
    assert len(KERNELS) > 50
    # Constants are computed by whole numbers.
    given = [path for path in (*KERNELS, *LAWS) if path.name != "constants.py"]
    found = {str(path): list(inexact(path.read_text())) for path in given}
    assert not {path: uses for path, uses in found.items() if uses}
