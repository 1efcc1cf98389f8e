"""A library is known by all sources that it is made from, those of the solver included."""

from __future__ import annotations

import ast
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from mebdf.compiled import library
from mebdf.kernels import jit as solver
from tribodyn.kernels import jit

ALL = {"mebdf": solver.SOURCES, "tribodyn": jit.SOURCES}


def copied(sources: library.Sources, folder: Path) -> library.Sources:
    """Return the sources in a copy of the packages."""
    return library.Sources(
        folder / sources.package.name,
        sources.patterns,
        sources.listing,
        tuple(copied(below, folder) for below in sources.below),
    )


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """A copy of both packages."""
    for sources in ALL.values():
        name, ignored = sources.package.name, shutil.ignore_patterns("__pycache__")
        shutil.copytree(sources.package, tmp_path / name, ignore=ignored)
    return tmp_path


def append(path: str) -> Callable[[Path], object]:
    return lambda folder: (folder / path).write_text((folder / path).read_text() + "\n# more\n")


CHANGES: dict[str, Callable[[Path], object]] = {
    "kernel": append("tribodyn/kernels/lookup.py"),
    "deep kernel": append("tribodyn/kernels/joints/surface/jacobian.py"),
    "table": append("tribodyn/core/remembered.py"),
    "new": lambda folder: (folder / "tribodyn" / "kernels" / "new.py").touch(),
    "gone": lambda folder: (folder / "tribodyn" / "kernels" / "vsv" / "__init__.py").unlink(),
    "moved": lambda folder: (folder / "tribodyn/kernels/lookup.py").rename(
        folder / "tribodyn/kernels/look.py"
    ),
}
CHANGES_OF_THE_SOLVER: dict[str, Callable[[Path], object]] = {
    "core": append("mebdf/kernels/core.py"),
    "array": append("mebdf/arrays.py"),
    "options": append("mebdf/compiled/jit.py"),
    "new": lambda folder: (folder / "mebdf" / "kernels" / "new.py").touch(),
}


def names(folder: Path) -> dict[str, str]:
    """Return the name of the machine code of each package in a copy."""
    return {name: library.fingerprint(copied(sources, folder)) for name, sources in ALL.items()}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES.keys())
def test_a_change_of_what_is_compiled_here_changes_this_name_alone(copy, change):
    before = {name: library.fingerprint(sources) for name, sources in ALL.items()}
    append("tribodyn/core/errors.py")(copy)
    assert names(copy) == before
    change(copy)
    after = names(copy)
    assert after["tribodyn"] != before["tribodyn"]
    assert after["mebdf"] == before["mebdf"]


@pytest.mark.parametrize("change", CHANGES_OF_THE_SOLVER.values(), ids=CHANGES_OF_THE_SOLVER.keys())
def test_a_change_of_the_solver_changes_both_names(copy: Path, change: Callable[[Path], object]) -> None:
    before = names(copy)
    append("mebdf/solver.py")(copy)
    assert names(copy) == before
    change(copy)
    after = names(copy)
    assert after["tribodyn"] != before["tribodyn"]
    assert after["mebdf"] != before["mebdf"]


@pytest.mark.parametrize("sources", ALL.values(), ids=ALL.keys())
def test_what_is_compiled_imports_nothing_that_the_name_does_not_cover(sources: library.Sources) -> None:
    covered = {path for _, path in sources.files()}
    imported = {
        module
        for path in covered
        if path.suffix == ".py"
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.ImportFrom) and node.module
        for module in (node.module, *(f"{node.module}.{name.name}" for name in node.names))
        if module.startswith(("mebdf", "tribodyn"))
    }
    root = sources.package.parent
    files = {root.joinpath(*module.split(".")).with_suffix(".py") for module in imported}
    assert {path for path in files if path.is_file()} <= covered
