"""Compiled functions as they are kept: their intermediate code is parsed only if a caller is compiled.

Of a function from its cache numba keeps the object file and the parsed intermediate code. Parsing takes half
the time of loading, and what is parsed takes a sixth of the memory of a process that simulates a mechanism.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final

from llvmlite import binding
from numba.core import codegen
from numba.core.compiler import CompileResult

_KIND: Final = "lean"
"""How the content of a kept library is laid out, beside numba's ``object`` and ``bitcode``."""


class LeanLibrary(codegen.JITCodeLibrary):
    """A library that parses its intermediate code when it is first linked into another."""

    _bitcode: bytes | None = None

    def _get_module_for_linking(self) -> Any:
        if self._bitcode is not None:
            self._shared_module, self._bitcode = binding.parse_bitcode(self._bitcode), None
        return super()._get_module_for_linking()

    @classmethod
    def _unserialize(cls, code: Any, state: tuple[str, str, Any]) -> Any:
        name, kind, content = state
        if kind != _KIND:
            return super()._unserialize(code, state)
        object_code, bitcode, symbols = content
        self = cls(code, name)
        self.enable_object_caching()
        self._set_compiled_object(object_code)
        self._finalize_final_module()
        code._engine._defined_symbols |= symbols
        self._bitcode = bitcode
        return self


def reduced(compiled: Any) -> tuple[Any, ...]:
    """Return what is kept of a compiled function."""
    (name, _, (object_code, bitcode)), *others = compiled._reduce()
    symbols = frozenset(_defined(compiled.library._get_module_for_linking()))
    return ((name, _KIND, (object_code, bitcode, symbols)), *others)


def rebuilt(context: Any, kept: tuple[Any, ...]) -> Any:
    """Return the compiled function of which ``kept`` was kept, for a target of numba."""
    context.codegen()._library_class = LeanLibrary
    return CompileResult._rebuild(context, *kept)


def _defined(module: Any) -> Iterator[str]:
    for things in (module.functions, module.global_variables):
        yield from (each.name for each in things if not each.is_declaration)
