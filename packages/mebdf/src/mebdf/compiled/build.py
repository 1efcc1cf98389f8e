"""Machine code of kernels from LLVM's intermediate code: linked, freed of Python, optimised once."""

import re
from collections.abc import Iterable, Sequence
from functools import cache
from importlib.resources import files
from itertools import starmap
from typing import Any, Final

from llvmlite import binding as llvm

from mebdf.compiled.kernel import RESULT
from mebdf.compiled.library import NoMachineCode, level, system
from mebdf.compiled.platforms import PLATFORMS, Platform

#: Symbol of a function, kinds of its arguments, kind of its result.
Described = tuple[str, tuple[str, ...], str]
ALLOWED: Final = {"memset", "memcpy", "memmove"}  #: Functions that machine code may take from the system.


@cache
def _started() -> None:
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()


def _shim(number: int, function: Described) -> str:
    """Return a function of one address: words for the result, then those of the arguments.

    A function of two records has a second one, which is what kernels call by its address.
    """
    symbol, kinds, _ = function
    lines = [f"define i32 @k{number}(ptr %words) {{", "  %raised = alloca ptr"]
    passed = ["ptr %words", "ptr %raised"]
    for k, kind in enumerate(kinds):
        lines.append(f"  %a{k} = getelementptr i64, ptr %words, i64 {RESULT + k}")
        lines.append(f"  %v{k} = load {kind}, ptr %a{k}")
        passed.append(f"{kind} %v{k}")
    lines += [f'  %status = call i32 @"{symbol}"({", ".join(passed)})', "  ret i32 %status", "}"]
    if kinds == ("ptr", "ptr"):
        lines += [f"define void @k{number}_law(ptr %0, ptr %1) {{", "  %words = alloca ptr"]
        lines += [f'  call i32 @"{symbol}"(ptr %words, ptr %words, ptr %0, ptr %1)', "  ret void", "}"]
    declared = f'declare i32 @"{symbol}"(ptr, ptr{"".join(", " + kind for kind in kinds)})'
    return "\n".join([declared, *lines])


def linked(modules: Iterable[Any], functions: Sequence[Described]) -> Any:
    """Return one module of intermediate code, of which only functions of words can be called.

    Raises NoMachineCode if a kernel calls what it must not: Python, or a function of the C library.
    """
    _started()
    symbols = {function[0] for function in functions}
    whole = None
    for module in modules:
        part = module.clone()
        for function in part.functions:
            if not function.is_declaration:
                function.linkage = "external" if function.name in symbols else "linkonce_odr"
        if whole is None:
            whole = part
        else:
            whole.link_in(part)
    assert whole is not None
    runtime = files("mebdf.compiled").joinpath("runtime.ll").read_text(encoding="ascii")
    for text in (runtime, "\n".join(starmap(_shim, enumerate(functions)))):
        whole.link_in(llvm.parse_assembly(text))
    module = llvm.parse_assembly(_portable(str(whole)))
    module.verify()
    undefined = {f.name for f in module.functions if f.is_declaration and not f.name.startswith("llvm.")}
    if undefined - ALLOWED:
        raise NoMachineCode(f"a kernel calls {', '.join(sorted(undefined - ALLOWED))}, which no kernel may")
    return module


def _portable(text: str) -> str:
    """Free a module of numba's runtime and of the machine it was made on."""
    text = re.sub(r"= (linkonce|common|weak)( global ptr) .*$", r"= internal\2 null", text, flags=re.M)
    text = re.sub(r"= common ", "= internal ", text)
    text = re.sub(
        r"^define (linkonce_odr |weak_odr |linkonce |weak |hidden )*", "define internal ", text, flags=re.M
    )
    text = re.sub(r"^define internal (i32|void) @(k\d+(?:_law)?)\(", r"define \1 @\2(", text, flags=re.M)
    # Exceptions of numba's own code, pickled with paths of the machine that compiled: nobody raises them.
    text = re.sub(
        r"^(@\.const\.pickledata\S* = internal constant) .*$",
        r"\1 [1 x i8] zeroinitializer",
        text,
        flags=re.M,
    )
    text = re.sub(
        r"^(@\.const\.picklebuf\S* = internal constant \{[^}]*\}) .*$",
        r"\1 zeroinitializer",
        text,
        flags=re.M,
    )
    return re.sub(r"^source_filename = .*\n", "", text, flags=re.M)


def optimised(text: str, platform: Platform, level: str) -> tuple[Any, Any]:
    """Return a module of intermediate code, optimised once for a level of processors, and LLVM's machine."""
    _started()
    target = llvm.Target.from_triple(platform.triple).create_target_machine(
        cpu=platform.processors[level], features="", opt=3, reloc="pic", codemodel="default"
    )
    text = re.sub(r"^target [^\n]*\n", "", text, flags=re.M)
    if "windows" in platform.triple:  # where a function cannot be found unless it says so
        text = re.sub(r"^define (i32|void) @k", r"define dllexport \1 @k", text, flags=re.M)
    head = f'target datalayout = "{target.target_data}"\ntarget triple = "{target.triple}"\n'
    module = llvm.parse_assembly(head + text)
    options = llvm.create_pipeline_tuning_options(speed_level=3)
    options.loop_vectorization = options.slp_vectorization = options.loop_unrolling = True
    builder = llvm.create_pass_builder(target, options)
    builder.getModulePassManager().run(module, builder)
    return module, target


_engines: Final[list[Any]] = []  #: Machine code made in this process, which lasts as long as it.


def address(module: Any, name: str) -> int:
    """Return the address of a function of a module of which machine code is made now."""
    here = PLATFORMS.get(system()) or Platform(llvm.get_default_triple(), {level(): "generic"}, "", "")
    engine = llvm.create_mcjit_compiler(*optimised(str(module), here, level()))
    engine.finalize_object()
    _engines.append(engine)
    found: int = engine.get_function_address(name)
    return found
