"""Compiled functions as libraries of which machine code is made when it is asked for.

Numba optimises each function together with all that it calls and makes machine code of it, again at every
level of calls. Here a function that has no wrappers, because only others call it, stays intermediate code. It
is optimised as a part of the functions that are called from outside, and of these alone machine code is made.
Operations are compiled as they are written: what a function returns does not depend on how it is optimised.
"""

from __future__ import annotations

import hashlib
import os
import secrets
from collections.abc import Iterable, Iterator
from functools import cached_property
from typing import Any, Final

import numba as nb
from llvmlite import binding
from numba.core import codegen
from numba.core.compiler import CompileResult
from numba.core.environment import lookup_environment
from numba.core.funcdesc import default_mangler

_KIND: Final = "lean"
"""Layout of a kept library, beside numba's ``object`` and ``bitcode``."""
_IN_THIS_PROCESS: Final = "numba.dynamic.globals"
_LONGEST: Final = 256
_BEGINNING: Final = 160
_TESTED: Final = nb.version_info.short == (0, 68)
"""Whether this is the version of numba whose private names are used here; others compile in their own way."""
_TOKEN: Final = secrets.token_hex(4)


class LeanLibrary(codegen.JITCodeLibrary):
    """A library that is optimised with all that it calls when an address in it is first asked for."""

    _own: Any = None
    """Its intermediate code as callers take it; None until it is asked for."""
    _bitcode: bytes | None = None
    """The same of a library that was kept, with all that it calls, until it is parsed."""
    _names: frozenset[str] | None = None

    def add_linking_library(self, library: Any) -> None:
        """Note a library whose functions are called."""
        self._linking_libraries.append(library)

    def _optimize_functions(self, ll_module: Any) -> None:
        """Make functions small: they are optimised together with those that call them."""
        ll_module.data_layout = self._codegen._data_layout
        for function in ll_module.functions:
            if not function.is_declaration:
                manager = binding.create_new_function_pass_manager()
                manager.add_sroa_pass()
                manager.add_simplify_cfg_pass()
                manager.add_instruction_combine_pass()
                manager.add_simplify_cfg_pass()
                manager.run(function, self._codegen._pass_builder())

    def get_pointer_to_function(self, name: str) -> int:
        """Return the address of a function; 0 if the library itself does not define it."""
        if not self._finalized and name not in self.names():
            return 0
        address: int = super().get_pointer_to_function(name)
        return address

    def names(self) -> frozenset[str]:
        """Return the names of the functions that the library itself defines."""
        if self._names is None:
            self._names = frozenset(_defined(self._final_module.functions))
        return self._names

    @property
    def has_dynamic_globals(self) -> bool:
        """Whether it contains addresses that only this process has."""
        return self._has_addresses or any(
            each._has_addresses if isinstance(each, LeanLibrary) else each.has_dynamic_globals
            for each in self._called()
        )

    @cached_property
    def _has_addresses(self) -> bool:
        names = (each.name for each in self._for_callers().global_variables)
        return any(name.startswith(_IN_THIS_PROCESS) for name in names)

    def finalize(self) -> None:
        """Optimise the library with all that it calls, and make its machine code."""
        self._raise_if_finalized()
        self._codegen._check_llvm_bugs()
        self._final_module = self._whole()
        _hide(self._final_module, self.names())
        self._optimize_final_module()
        self._final_module.verify()
        self._finalize_final_module()
        code: Any = self._codegen
        for each in self._final_module.global_variables:
            if (environment := lookup_environment(each.name)) is not None:
                code.set_env(each.name, environment)

    def kept(self) -> tuple[str, str, Any]:
        """Return the kept parts of the library: machine code, if any was made, and intermediate code."""
        code, symbols = None, frozenset[str]()
        if self._finalized:
            module = self._final_module
            code = self._get_compiled_object()
            symbols = frozenset((*_defined(module.functions), *_defined(module.global_variables)))
        return self.name, _KIND, (code, symbols, self._whole().as_bitcode(), self.names())

    @classmethod
    def _unserialize(cls, code: Any, state: tuple[str, str, Any]) -> Any:
        name, kind, content = state
        if kind != _KIND:
            return super()._unserialize(code, state)
        self = cls(code, name)
        self.enable_object_caching()
        machine_code, symbols, self._bitcode, self._names = content
        if machine_code is not None:
            self._set_compiled_object(machine_code)
            self._finalize_final_module()
            code._engine._defined_symbols |= symbols
        return self

    def _get_module_for_linking(self) -> Any:
        """Return the content of a library of numba's own kind, which calls this one."""
        return self._whole()

    def _for_callers(self) -> Any:
        """Return its intermediate code, of which a caller takes what it calls."""
        if self._own is None:
            if self._bitcode is not None:
                self._own, self._bitcode = binding.parse_bitcode(self._bitcode), None
            else:
                self._own = self._final_module
                for name in self.names():
                    self._own.get_function(name).linkage = "linkonce_odr"
        return self._own

    def _whole(self) -> Any:
        """Return a new module of its intermediate code and of all that it calls."""
        module = self._for_callers().clone()
        for each in self._called():
            self._reload_init.update(each._reload_init)
            called = each._for_callers() if isinstance(each, LeanLibrary) else each._get_module_for_linking()
            module.link_in(called, preserve=True)
        return module

    def _called(self) -> list[Any]:
        """Return the libraries of all that is called, each once, behind one that calls it."""
        found: dict[int, Any] = {id(self): self}

        def add(libraries: Iterable[Any]) -> None:
            for each in libraries:
                if id(each) not in found:
                    found[id(each)] = each
                    if isinstance(each, LeanLibrary):
                        add(each._linking_libraries)

        add(self._linking_libraries)
        return [each for each in found.values() if each is not self]


class LeanCode(codegen.JITCPUCodegen):
    """Numba's code generator with such libraries."""

    _library_class = LeanLibrary

    def set_env(self, env_name: str, env: Any) -> None:
        """Give machine code what it takes from Python, where there is machine code."""
        if self._engine.is_symbol_defined(env_name):
            super().set_env(env_name, env)


def use(context: Any) -> None:
    """Have a target of numba use such libraries from now on, if this version was tested."""
    code = context.codegen()
    if _TESTED and not isinstance(code, LeanCode):
        code.__class__, context.mangler = LeanCode, _mangled


def reduced(compiled: Any) -> tuple[Any, ...]:
    """Return the kept parts of a compiled function."""
    library: Any = compiled.library
    if isinstance(library, LeanLibrary):
        compiled.library.serialize_using_object_code = library.kept
    *kept, environments = compiled._reduce()
    # Machine code takes constants from them. For one without any, numba would import its module.
    return *kept, tuple(each for each in environments if each.consts)


def rebuilt(context: Any, kept: tuple[Any, ...]) -> Any:
    """Return the compiled function of which ``kept`` was kept, for a target of numba."""
    use(context)
    return CompileResult._rebuild(context, *kept)


def _mangled(name: str, types: Any, *, abi_tags: Any = (), uid: Any = None) -> str:
    """Return the name of a function for given types; those of mechanisms would take 300,000 characters.

    Numba counts the functions of a process. What is linked may have been compiled by several of them.
    """
    number = None if uid is None else f"{uid}x{_TOKEN}{os.getpid()}"
    whole: str = default_mangler(name, types, abi_tags=abi_tags, uid=number)
    if len(whole) <= _LONGEST:
        return whole
    return whole[:_BEGINNING] + hashlib.sha256(whole.encode()).hexdigest()


def _hide(module: Any, names: frozenset[str]) -> None:
    """Make functions known outside a module by these names, all others within it alone."""
    recursive = any(each.name.startswith(codegen.RuntimeLinker.PREFIX) for each in module.global_variables)
    for each in module.functions:
        if not each.is_declaration:
            if each.name in names:
                each.linkage = "external"
            elif not recursive:  # else they are looked up by their names
                each.linkage = "internal"


def _defined(things: Any) -> Iterator[str]:
    yield from (each.name for each in things if not each.is_declaration)
