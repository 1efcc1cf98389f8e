"""Compilation of kernels to LLVM's intermediate code, by numba.

Floating-point operations are compiled as they are written: none is contracted, reordered or replaced by
another. So a kernel returns the same bits on every processor and from every level that it is inlined into. It
calls no function of the C library: :mod:`mebdf.kernels.elementary` has those that are needed. Division by
zero gives inf or NaN, which the integrators watch for.

Kernels allocate no memory. Numba's reference counts, which take a fifth of the time of a run, are switched
off by the private option ``_nrt``; a kernel that creates an array does not compile.

Numba optimises each function together with all that it calls, again at every level of calls, and makes
machine code of it. Here functions stay intermediate code until :mod:`mebdf.compiled.build` links them.
"""

import hashlib
from collections.abc import Iterable, Iterator
from functools import cache
from typing import Any, Final, NamedTuple

import numba as nb
from llvmlite import binding, ir
from numba.core import cgutils, codegen, types
from numba.core.environment import lookup_environment
from numba.core.funcdesc import default_mangler
from numba.core.imputils import lower_builtin
from numba.core.registry import cpu_target
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, models, register_model, typeof_impl
from numba.np.numpy_support import from_dtype

from mebdf.compiled import build
from mebdf.compiled.kernel import Instruction, Kernel
from mebdf.compiled.layouts import Absent, Array, Layout, Layouts, One, Tuple
from mebdf.compiled.library import NoMachineCode

__all__ = [
    "AbstractTemplate",
    "cgutils",
    "infer_global",
    "intrinsic",
    "ir",
    "lower_builtin",
    "models",
    "nb",
    "register_model",
    "signature",
    "types",
]
_TESTED: Final = (0, 68)  #: Version of numba whose private names are used here.
_BEGINNING: Final = 160


class Compiled(NamedTuple):
    """A compiled function: name, kinds of its arguments in LLVM, kind of result, and its library."""

    symbol: str
    kinds: tuple[str, ...]
    result: str
    library: Any


class _Lean(codegen.JITCodeLibrary):
    """A library that stays intermediate code until an address in it is asked for, which no kernel is.

    Functions of others that numba compiles in this process are: they are optimised with all that they call.
    """

    _own: Any = None

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
        if not self._finalized and name not in _defined(self.own()):
            return 0
        address: int = super().get_pointer_to_function(name)
        return address

    def finalize(self) -> None:
        """Optimise the library with all that it calls, and make its machine code."""
        self._raise_if_finalized()
        names = _defined(self.own())
        self._final_module = self._get_module_for_linking()
        for each in self._final_module.functions:
            if each.name in names:
                each.linkage = "external"
        self._optimize_final_module()
        self._final_module.verify()
        self._finalize_final_module()
        code: Any = self._codegen
        for each in self._final_module.global_variables:
            if (environment := lookup_environment(each.name)) is not None:
                code.set_env(each.name, environment)

    def own(self) -> Any:
        """Return its intermediate code, of which a caller takes what it calls."""
        if self._own is None:
            self._own = self._final_module
            for name in _defined(self._own):
                self._own.get_function(name).linkage = "linkonce_odr"
        return self._own

    def all(self) -> list[Any]:
        """Return this library and those of all that is called, each once, behind one that calls it."""
        found: dict[int, Any] = {}

        def add(libraries: Iterable[Any]) -> None:
            for each in libraries:
                if id(each) not in found:
                    found[id(each)] = each
                    if isinstance(each, _Lean):
                        add(each._linking_libraries)

        add([self])
        return list(found.values())

    def _get_module_for_linking(self) -> Any:
        """Return a new module of its intermediate code and of all that it calls."""
        module = self.own().clone()
        for each in self.all()[1:]:
            module.link_in(_code_of(each), preserve=True)
        return module


class _Code(codegen.JITCPUCodegen):
    """Numba's code generator with such libraries."""

    _library_class = _Lean

    def set_env(self, env_name: str, env: Any) -> None:
        """Give machine code what it takes from Python, where there is machine code."""
        if self._engine.is_symbol_defined(env_name):
            super().set_env(env_name, env)


def _code_of(library: Any) -> Any:
    """Return the intermediate code of a library; one of numba's own kind comes with all that it calls."""
    return library.own() if isinstance(library, _Lean) else library._get_module_for_linking()


def _defined(module: Any) -> set[str]:
    return {each.name for each in module.functions if not each.is_declaration}


@cache
def _target() -> Any:
    """Have numba use such libraries from now on; return its target."""
    if nb.version_info.short != _TESTED:
        tested = ".".join(map(str, _TESTED))
        found = nb.__version__
        raise NoMachineCode(f"kernels are compiled by numba {tested}, not by {found}; install that one")
    context = cpu_target.target_context
    context.codegen().__class__, context.mangler = _Code, _mangled
    return context


_numbers: Final[dict[str, list[Any]]] = {}


def _mangled(name: str, kinds: Any, *, abi_tags: Any = (), uid: Any = None) -> str:
    """Return the name of a function for given types; for kernels the same in every process.

    Numba's own counts the functions of a process, takes 300,000 characters for the types of mechanisms, and
    does not tell arrays in records by their shapes.
    """
    whole = f"{name} {[str(kind) for kind in kinds]} {abi_tags}"
    known = _numbers.setdefault(hashlib.sha256(whole.encode()).hexdigest(), [])
    if uid not in known:
        known.append(uid)
    number = known.index(uid)
    digest = hashlib.sha256(f"{whole} {number}".encode()).hexdigest()
    return f"{default_mangler(name, ())[:_BEGINNING]}_{digest}"


@cache
def _dispatcher(kernel: Kernel) -> Any:
    """Return numba's dispatcher of a kernel; Python never calls it."""
    options = {"error_model": "numpy", "_nrt": False, "no_cfunc_wrapper": True, "no_cpython_wrapper": True}
    njit: Any = nb.njit
    made = njit(**options, **kernel.targetoptions)(kernel.py_func)

    def add_overload(compiled: Any) -> None:
        made.overloads[tuple(compiled.signature.args)] = compiled  # numba's own lets Python find it, too

    made.add_overload = add_overload
    return made


@typeof_impl.register(Kernel)
def _(kernel: Any, context: Any) -> Any:
    return types.Dispatcher(_dispatcher(kernel))


@typeof_impl.register(Instruction)
def _(instruction: Any, context: Any) -> Any:
    generator = instruction.generator()
    cpu_target.typing_context.refresh()
    cpu_target.target_context.refresh()
    return cpu_target.typing_context.resolve_value_type(generator)


def type_of(layout: Layout) -> Any:
    """Return numba's type of a layout."""
    if isinstance(layout, Absent):
        return types.none
    if isinstance(layout, Array):
        return types.Array(from_dtype(layout.dtype), layout.ndim, "C")
    if isinstance(layout, One):
        return from_dtype(layout.dtype)
    if isinstance(layout, Tuple):
        return types.BaseTuple.from_types([type_of(member) for member in layout.members], layout.cls)
    return {float: types.float64, int: types.int64, bool: types.boolean}[layout.kind]


def compiled(kernel: Kernel, layouts: Layouts) -> Compiled:
    """Return the intermediate code of a kernel for arguments of some layouts."""
    _target()
    kinds = tuple(map(type_of, layouts))
    dispatcher = _dispatcher(kernel)
    dispatcher.compile(kinds)
    made = dispatcher.overloads[kinds]
    symbol = made.fndesc.llvm_func_name
    function = made.library.own().get_function(symbol)
    return Compiled(
        symbol,
        tuple(str(argument.type) for argument in function.arguments)[2:],
        _result(made.signature.return_type),
        made.library,
    )


def _result(kind: Any) -> str:
    """Return the kind of a result, or the kinds of the numbers of a tuple, with commas."""
    kind = types.unliteral(kind)
    if isinstance(kind, types.UniTuple | types.Tuple):
        return "".join(f"{_result(member)}," for member in kind.types)
    if kind in (types.none, types.int64, types.float64, types.boolean):
        return str(kind)
    raise NoMachineCode(f"a kernel that Python calls returns {kind}")


def libraries(functions: Iterable[Compiled]) -> Iterator[Any]:
    """Yield the intermediate code of functions and of all that they call, each once, behind a caller."""
    seen: set[int] = set()
    for function in functions:
        for each in function.library.all():
            if id(each) not in seen:
                seen.add(id(each))
                yield _code_of(each)


@cache
def machine_code(kernel: Kernel, layouts: Layouts, suffix: str = "") -> tuple[int, str]:
    """Return address and kind of result of a kernel that is compiled now, for this process alone."""
    function = compiled(kernel, layouts)
    module = build.linked(libraries([function]), [(function.symbol, function.kinds, function.result)])
    return build.address(module, f"k0{suffix}"), function.result
