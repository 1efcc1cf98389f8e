"""Entries of the library: all are there, with and without compilation, and none depends on the processor."""

from __future__ import annotations

import ast
import importlib
import json
import os
import pkgutil
import random
import re
import struct
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from llvmlite.binding.object_file import ObjectFileRef

import mebdf.kernels
import tribodyn.kernels
from mebdf.compiled.build import ALLOWED
from mebdf.compiled.kernel import Kernel, entries
from mebdf.compiled.layouts import Absent, Array, Layout, Number, One, Tuple
from mebdf.compiled.library import LEVELS, MANIFEST, fingerprint
from mebdf.kernels import jit as solver
from tribodyn.kernels import jit
from tribodyn.mechanism import elements

SOURCES = (solver.SOURCES, jit.SOURCES)
LISTED = [kernel for sources in SOURCES for kernel in entries(sources)]
#: Called by force laws, which are compiled.
OF_LAWS = {
    "mebdf.kernels.elementary.exponential.exp",
    "mebdf.kernels.elementary.exponential.power",
    "tribodyn.kernels.mechanism.law.followed_load",
}


def modules() -> Iterator[Path]:
    """Yield the files of all modules that are no kernels."""
    for package in (tribodyn, mebdf):
        root = Path(package.__file__ or "").parent
        for path in sorted(root.rglob("*.py")):
            if not {"kernels", "compiled"} & set(path.relative_to(root).parts):
                yield path


def imported(path: str) -> Any:
    """Return what an import names: a module, or something in one."""
    module, _, name = path.rpartition(".")
    try:
        found = getattr(importlib.import_module(module), name, None)
        return importlib.import_module(path) if found is None else found
    except ImportError:
        return None


def named(tree: ast.Module) -> Iterator[Kernel]:
    """Yield the kernels that a module names."""
    of_kernels: dict[str, ModuleType] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and ".kernels" in f"{node.module}.":
            for alias in node.names:
                found = imported(f"{node.module}.{alias.name}")
                if isinstance(found, ModuleType):
                    of_kernels[alias.asname or alias.name] = found
                elif isinstance(found, Kernel):
                    yield found
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            found = getattr(of_kernels.get(node.value.id), node.attr, None)
            if isinstance(found, Kernel):
                yield found


def test_every_kernel_that_a_module_outside_names_is_an_entry() -> None:
    trees = (ast.parse(path.read_text(encoding="utf-8")) for path in modules())
    found = {kernel.name for tree in trees for kernel in named(tree)}
    assert "tribodyn.kernels.vsv.closure.crank_end" in found
    assert found - {kernel.name for kernel in LISTED} == OF_LAWS


@pytest.mark.parametrize("sources", SOURCES, ids=lambda sources: sources.package.name)
def test_the_library_of_these_sources_holds_all_entries(sources: Any) -> None:
    manifest = json.loads((sources.folder / MANIFEST).read_text(encoding="utf-8"))
    assert manifest["sources"] == fingerprint(sources), "make kernels"
    expected = {kernel.name: kernel.digest(kernel.layouts) for kernel in entries(sources)}
    assert {name: layout for name, (_, layout, _) in manifest["functions"].items()} == expected


def undefined(content: bytes) -> set[str]:
    """Return the functions that a shared library takes from others."""
    sections = {part.name(): part.data() for part in ObjectFileRef.from_data(content).sections()}
    names = sections[b".dynstr"]
    symbols = struct.iter_unpack("<IBBHQQ", sections[b".dynsym"])
    places = [place for place, _, _, section, *_ in symbols if section == 0 and place]
    return {names[place : names.index(b"\0", place)].decode() for place in places}


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("sources", SOURCES, ids=lambda sources: sources.package.name)
def test_the_library_is_small_and_names_no_place_and_no_function_of_others(sources: Any, level: str) -> None:
    content = (sources.folder / f"{level}.so").read_bytes()
    assert undefined(content) <= ALLOWED
    assert str(sources.package.parent).encode() not in content
    assert b".py" not in content
    assert len(content) < 1.2e6


SCRIPT = """
from tribodyn import simulate
from tribodyn.mechanisms.catalogue import load_case

# Few nodes, and a law with few integrals.
small = {"solver.grid.theta": 12, "solver.grid.z": 2, "contact.law": "gw"}
case = load_case("vsv").replace(small | {"run.duration": "0.02 ms", "run.output_interval": "0.01 ms"})
print(float(simulate(case)["F_cx"][-1]))
"""


def force(disabled: str) -> float:
    """Return the contact force at the end of a short run [N]."""
    environment = {**os.environ, "NUMBA_DISABLE_JIT": disabled}
    done = subprocess.run([sys.executable, "-c", SCRIPT], env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return float(done.stdout)


@pytest.mark.long
def test_a_run_without_compilation_is_the_same() -> None:
    # To the rounding of elementary functions, which NumPy evaluates otherwise.
    assert force("1") == pytest.approx(force("0"), rel=1e-9)


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


def fitting(layout: Layout) -> Any:
    """Return a value that fits a layout."""
    if isinstance(layout, Number):
        return layout.kind(1)
    if isinstance(layout, Array):
        return np.ones((1,) * layout.ndim, layout.dtype)
    if isinstance(layout, One):
        return np.zeros(1, layout.dtype)[0]
    if isinstance(layout, Tuple):
        return layout.cls._make(map(fitting, layout.members))  # type: ignore[attr-defined]
    return None


def spoiled(layout: Layout, luck: random.Random) -> Any:
    """Return a value that does not fit a layout, in one place of many."""
    if isinstance(layout, Tuple):
        place = luck.randrange(-1, len(layout.members))
        if place < 0:
            return tuple(map(fitting, layout.members))
        members = [spoiled(m, luck) if k == place else fitting(m) for k, m in enumerate(layout.members)]
        return layout.cls._make(members)  # type: ignore[attr-defined]
    if isinstance(layout, Array):
        fits = fitting(layout)
        read_only = fits.copy()
        read_only.flags.writeable = False
        wide = np.ones((1,) * (layout.ndim - 1) + (4,), layout.dtype)[..., ::2]
        return luck.choice([read_only, fits[None], wide, np.ones(fits.shape, np.float32), fits.tolist()])
    if isinstance(layout, One):
        more = np.dtype([("x", "f8"), *(layout.dtype.descr if layout.dtype.isbuiltin else [])])
        return luck.choice([np.zeros(1, more)[0], np.zeros(1, layout.dtype), None])
    if isinstance(layout, Absent):
        return 1.0
    return luck.choice(["1", [1.0], np.ones(1), {}, 1j] + ([0.5, True] if layout == Number(int) else []))


def test_a_thousand_wrong_arguments_are_refused() -> None:
    luck = random.Random(5)
    for number in range(1000):
        kernel = LISTED[number % len(LISTED)]
        place = luck.randrange(len(kernel.layouts))
        given = list(map(fitting, kernel.layouts))
        given[place] = spoiled(kernel.layouts[place], luck)
        with pytest.raises(TypeError):
            kernel(*given)


def test_no_field_hides_behind_an_attribute_of_records():
    """Python would read the attribute, compiled code the field: ``size`` of a record is always 1."""
    hidden, found = set(dir(np.record)), 0
    for package in (mebdf.kernels, tribodyn.kernels):
        for about in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            for name, kind in vars(importlib.import_module(about.name)).items():
                if isinstance(kind, np.dtype) and kind.names:
                    found += 1
                    assert not set(kind.names) & hidden, (about.name, name)
    assert found > 30
