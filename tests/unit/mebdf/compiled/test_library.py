"""A library is used where it fits the sources, the system and its manifest; else a sentence says why not."""

from __future__ import annotations

import json
import shutil
import struct
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest

from mebdf.compiled import build as libraries_build
from mebdf.compiled import library as libraries
from mebdf.compiled import make
from mebdf.compiled.library import MANIFEST, Library, NoMachineCode, Sources, fingerprint, library
from mebdf.kernels.jit import SOURCES as SOLVER

KERNELS = """
from pathlib import Path
from mebdf.compiled.kernel import decorators
from mebdf.compiled.library import Sources

SOURCES = Sources(Path(__file__).parents[1], ("kernels/*.py",), listing=("small.kernels",))
entry, kernel, inlined = decorators(SOURCES)
"""
CODE = '''
from small.kernels.jit import entry, kernel

@kernel
def inner(x):
    return {factor} * x

@entry
def multiple(x: float) -> float:
    """Return the multiple of a number."""
    return inner(x)
'''
ASK = """
import sys
if "without" in sys.argv:
    sys.modules["numba"] = sys.modules["llvmlite"] = None
from small.kernels.code import multiple
try:
    print(multiple(21.0), "numba" in sys.modules and sys.modules["numba"] is not None)
except ImportError as problem:
    print(problem)
"""


def build(folder: Path, *options: str) -> None:
    command = [sys.executable, "-m", "mebdf.compiled.make", "small", "--dist", str(folder / "dist"), *options]
    subprocess.run(command, cwd=folder, check=True, capture_output=True)


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a package of one kernel and its library."""
    folder = tmp_path_factory.mktemp("small")
    kernels = folder / "small" / "kernels"
    kernels.mkdir(parents=True)
    (folder / "small" / "__init__.py").touch()
    (kernels / "__init__.py").touch()
    (kernels / "jit.py").write_text(KERNELS)
    (kernels / "code.py").write_text(CODE.format(factor=2.0))
    build(folder)
    return folder


@pytest.fixture
def copy(built: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(built, tmp_path / "copy"))


def asked(folder: Path, *how: str) -> str:
    """Return what a process says that calls the kernel."""
    command = [sys.executable, "-c", ASK, *how]
    return subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout.strip()


def sources(folder: Path) -> Sources:
    return Sources(folder / "small", ("kernels/*.py",), ("small.kernels",))


def manifest(folder: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((sources(folder).folder / MANIFEST).read_text())
    return found


def change(folder: Path, **entries: Any) -> None:
    """Change entries of the manifest."""
    (sources(folder).folder / MANIFEST).write_text(json.dumps(manifest(folder) | entries))


def content(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sources(folder).folder.iterdir()}


def test_the_library_serves_without_numba(built: Path) -> None:
    assert asked(built, "without") == "42.0 False"


def test_a_kernel_edited_after_the_build_is_compiled_anew(copy: Path) -> None:
    (copy / "small" / "kernels" / "code.py").write_text(CODE.format(factor=3.0))
    assert asked(copy) == "63.0 True"
    said = asked(copy, "without")
    assert said.startswith("the machine code of small is missing or has changed since it was built")
    build(copy)
    assert asked(copy, "without") == "63.0 False"


def test_two_builds_give_the_same_bytes(copy: Path) -> None:
    before = content(copy)
    (sources(copy).folder / MANIFEST).unlink()
    build(copy)
    assert content(copy) == before


@pytest.mark.parametrize(
    ("system", "beginning"),
    [
        ("linux-aarch64", b"\x7fELF\2\1\1" + bytes(9) + b"\3\0\xb7\0"),  # a shared object for AArch64
        # Mach-O, ARM64, a library.
        pytest.param(
            "darwin-arm64", struct.pack("<IIII", 0xFEEDFACF, 0x0100000C, 0, 6), marks=pytest.mark.long
        ),
        # Makes a C library for Windows first, which takes long; tools/try-wheel makes that wheel, too.
        pytest.param("win32-AMD64", b"MZ", marks=pytest.mark.long),
    ],
)
def test_a_library_is_made_for_another_system(copy: Path, system: str, beginning: bytes) -> None:
    build(copy, "--system", system)
    code = content(copy)["baseline.so"]
    assert code.startswith(beginning)
    assert b"k0\0" in code
    assert f"the machine code is for {system}, this is " in asked(copy)
    build(copy)
    assert asked(copy, "without") == "42.0 False"


def test_a_wheel_of_the_same_sources_gives_its_library(copy: Path) -> None:
    before = content(copy)
    (copy / "dist").mkdir()
    with zipfile.ZipFile(copy / "dist" / "small-1-py3-none-any.whl", "w") as wheel:
        for name, of_file in before.items():
            wheel.writestr(f"small/kernels/built/{name}", of_file)
    shutil.rmtree(sources(copy).folder)
    assert make.from_wheel(sources(copy), libraries.system(), copy / "dist")
    assert content(copy) == before


def test_sources_that_are_edited_while_they_are_compiled_make_no_library(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    found = iter(("before", "after"))
    monkeypatch.setattr(make, "fingerprint", lambda sources: next(found))
    monkeypatch.setattr(make, "_compiled", lambda listed: [])
    with pytest.raises(NoMachineCode, match="changed while they were compiled"):
        make.make(SOLVER, "linux-x86_64")


def test_a_library_of_another_build_is_refused(copy: Path) -> None:
    change(copy, levels=dict.fromkeys(manifest(copy)["levels"], "0" * 64))
    assert "does not belong to the manifest.json beside it; install the package again" in asked(copy)


def test_a_wheel_without_its_library_says_so(copy: Path) -> None:
    for path in sources(copy).folder.glob("*.so"):
        path.unlink()
    assert ".so, which manifest.json names, is missing; install the package again" in asked(copy)


def test_a_library_of_another_system_is_refused(copy: Path) -> None:
    change(copy, system="win32-AMD64")
    assert asked(copy).startswith("the machine code is for win32-AMD64, this is linux-")


def test_a_manifest_that_cannot_be_read_is_named(copy: Path) -> None:
    (sources(copy).folder / MANIFEST).write_text("{")
    assert "manifest.json cannot be read" in asked(copy)


def test_a_processor_that_is_too_old_is_told(built: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(libraries, "level", lambda: "baseline")
    with pytest.raises(NoMachineCode, match="no code for processors without AVX2"):
        Library(sources(built).folder, manifest(built) | {"levels": {"v3": ""}})


def test_the_processor_chooses_the_level(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("TRIBODYN_LEVEL", raising=False)
    old = libraries.LEVELS["baseline"]
    for flags, level in (
        (old | {"avx"}, "baseline"),
        (old | libraries.LEVELS["v3"], "v3"),
        (set(), "baseline"),
    ):
        monkeypatch.setattr(libraries, "_flags", lambda flags=flags: flags)
        assert libraries.level.__wrapped__() == level
    monkeypatch.setattr(libraries, "_flags", lambda: {"sse2", "ssse3", "cx16", "popcnt"})
    with pytest.raises(NoMachineCode, match="this processor lacks sse4_1, sse4_2, which"):
        libraries.level.__wrapped__()


def test_sources_that_cannot_be_read_have_no_library(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        fingerprint(sources(tmp_path))
    assert library(sources(tmp_path)) is None


def test_paths_of_the_machine_leave_nothing_in_the_code() -> None:
    kept = []
    for path in ("/a", "/a/longer/path"):
        data, name = f"pickled with {path}", "0123abcd"
        text = (
            f'@.const.pickledata.{name} = internal constant [{len(data)} x i8] c"{data}"\n'
            f"@.const.picklebuf.{name} = internal constant {{ ptr, i32, ptr }} "
            f"{{ ptr @.const.pickledata.{name}, i32 {len(data)}, ptr null }}, align 8\n"
        )
        kept.append(libraries_build._portable(text))
    assert kept[0] == kept[1]


def test_an_unknown_level_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TRIBODYN_LEVEL", "v9")
    with pytest.raises(NoMachineCode, match="choose v3 or baseline"):
        libraries.level.__wrapped__()
