"""The type stub of the builder: what type checkers and editors know of its methods.

``make golden`` writes it anew from the keys of a case.
"""

import inspect
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from tribodyn.mechanism.builder import methods
from tribodyn.mechanism.builder.arguments import signature_of_case

STUB: Final = Path(methods.__file__).with_name("signatures.pyi")
WIDTH: Final = 110
HEAD: Final = '''"""Types of the builder's methods; ``make golden`` writes them from the keys of a case."""

from collections.abc import Mapping, Sequence
from typing import Any, Self, TypeAlias

import numpy as np

Table: TypeAlias = Mapping[str, object]
Vector: TypeAlias = Sequence[float | str] | str | np.ndarray[Any, Any]

class Signatures:
'''


def method(name: str, signature: inspect.Signature, returned: str) -> Iterator[str]:
    """Yield the lines of a method, as the formatter breaks them."""
    arguments, keywords = [], False
    for one in signature.parameters.values():
        if one.kind is one.KEYWORD_ONLY and not keywords:
            keywords = True
            arguments.append("*")
        annotation = "" if one.annotation is one.empty else f": {one.annotation}"
        arguments.append(f"{one.name}{annotation}{'' if one.default is one.empty else ' = ...'}")
    whole = ", ".join(arguments)
    if len(line := f"    def {name}({whole}) -> {returned}: ...") <= WIDTH:
        yield line
        return
    yield f"    def {name}("
    yield from [f"        {whole}"] if len(whole) + 8 <= WIDTH else (f"        {one}," for one in arguments)
    yield f"    ) -> {returned}: ..."


def stub() -> str:
    """Return the stub."""
    builder = signature_of_case()
    own = inspect.Parameter("self", inspect.Parameter.POSITIONAL_OR_KEYWORD)
    lines = [*method("__init__", builder.replace(parameters=[own, *builder.parameters.values()]), "None")]
    for one in methods.METHODS:
        lines += method(one.name, one.signature, "Self")
    return HEAD + "\n".join(lines) + "\n"


def test_the_stub_holds_the_keys_of_today() -> None:
    assert STUB.read_text(encoding="utf-8") == stub()


if __name__ == "__main__":
    sys.exit(STUB.write_text(stub(), encoding="utf-8") == 0)
