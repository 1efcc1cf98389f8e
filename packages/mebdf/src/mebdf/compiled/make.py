"""Builder of libraries of machine code: ``python -m mebdf.compiled.make PACKAGE...``.

A package is ``mebdf`` or ``tribodyn``. A library that fits the sources is left as it is; a wheel of the same
sources in ``dist`` gives its own. Two builds give the same bytes. The Python package ziglang has linkers for
the other systems.
"""

from __future__ import annotations

import argparse
import gc
import hashlib
import importlib.util
import json
import multiprocessing
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from importlib import metadata
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mebdf.compiled.library import MANIFEST, NoMachineCode, Sources, fingerprint
from mebdf.compiled.library import system as this_system
from mebdf.compiled.platforms import PLATFORMS

if TYPE_CHECKING:
    from mebdf.compiled.jit import Compiled
    from mebdf.compiled.kernel import Kernel


def make(sources: Sources, system: str) -> None:
    """Make the library of a package for all levels of processors of a system.

    Raises NoMachineCode if a kernel does what none may do, if there is no linker, or if sources are edited
    meanwhile: what was compiled is not known then.
    """
    from mebdf.compiled import build, jit
    from mebdf.compiled.kernel import entries

    before = fingerprint(sources)
    listed = entries(sources)
    functions = _compiled(listed)
    if fingerprint(sources) != before:
        raise NoMachineCode("sources changed while they were compiled; make the kernels again")
    described = [(function.symbol, function.kinds, function.result) for function in functions]
    text = str(build.linked(jit.libraries(functions), described))
    levels = PLATFORMS[system].processors
    with ProcessPoolExecutor(len(levels), multiprocessing.get_context("fork")) as pool:
        each = {level: pool.submit(_library, text, system, level) for level in levels}
        made = {level: library.result() for level, library in each.items()}
    manifest = {
        "sources": before,
        "system": system,
        "made_by": {name: metadata.version(name) for name in ("numba", "llvmlite")},
        "levels": {name: hashlib.sha256(code).hexdigest() for name, code in made.items()},
        "functions": {
            kernel.name: [number, kernel.digest(kernel.layouts), function.result]
            for number, (kernel, function) in enumerate(zip(listed, functions, strict=True))
        },
    }
    files = {f"{name}.so": code for name, code in made.items()}
    _write(sources.folder, files | {MANIFEST: json.dumps(manifest, indent=1).encode()})


def _compiled(listed: Sequence[Kernel]) -> list[Compiled]:
    """Return the intermediate code of all entries; say how far it is."""
    from mebdf.compiled import jit

    functions = []
    for number, kernel in enumerate(listed):
        functions.append(jit.compiled(kernel, kernel.layouts))
        if (share := 10 * (number + 1) // len(listed)) > 10 * number // len(listed):
            said = f"compiling the kernels of {kernel.name.split('.')[0]}: {10 * share} %"
            print(said, file=sys.stderr, flush=True)
    return functions


def _library(text: str, system: str, level: str) -> bytes:
    """Return the bytes of a shared library of intermediate code for a level of processors."""
    from mebdf.compiled import build

    platform = PLATFORMS[system]
    with tempfile.TemporaryDirectory() as place:
        code, library = Path(place, "kernels.o"), Path(place, "kernels.so")
        module, target = build.optimised(text, platform, level)
        code.write_bytes(target.emit_object(module))
        command = [*_linker(system), "-shared", "-s", *platform.flags, code.name, "-o", library.name]
        subprocess.run(command, cwd=place, check=True)
        return library.read_bytes()


def _linker(system: str) -> list[str]:
    if system == this_system() and (compiler := shutil.which("cc")):
        return [compiler]
    if importlib.util.find_spec("ziglang") is None:
        raise NoMachineCode(f"there is no linker for {system}; install the Python package ziglang")
    return [sys.executable, "-m", "ziglang", "cc", "-target", PLATFORMS[system].linker]


def _write(folder: Path, files: dict[str, bytes]) -> None:
    """Write the files of a library, the manifest last: without it nobody loads any of them."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name in sorted(files, key=MANIFEST.__eq__):
        (folder / f"{name}.part").write_bytes(files[name])
        (folder / f"{name}.part").replace(folder / name)


def from_wheel(sources: Sources, system: str, dist: Path) -> bool:
    """Take the library from a wheel of the same sources; return whether there was one."""
    start = f"{sources.package.name}/kernels/built/"
    for path in sorted(dist.glob(f"{sources.package.name}-*.whl")):
        with zipfile.ZipFile(path) as wheel:
            names = [name for name in wheel.namelist() if name.startswith(start)]
            files = {name.removeprefix(start): wheel.read(name) for name in names}
        if MANIFEST in files and _fits(files[MANIFEST], sources, system):
            _write(sources.folder, files)
            return True
    return False


def is_there(sources: Sources, system: str) -> bool:
    """Tell whether there is a library that was made from the sources as they are."""
    from mebdf.compiled.kernel import entries

    try:
        manifest = (sources.folder / MANIFEST).read_bytes()
    except OSError:
        return False
    # Laws that stand beside the sources, as those of elements, are told apart by their digests.
    functions = json.loads(manifest)["functions"].items()
    return _fits(manifest, sources, system) and {name: digest for name, (_, digest, _) in functions} == {
        kernel.name: kernel.digest(kernel.layouts) for kernel in entries(sources)
    }


def _fits(manifest: bytes, sources: Sources, system: str) -> bool:
    found: dict[str, Any] = json.loads(manifest)
    return bool(found["sources"] == fingerprint(sources) and found["system"] == system)


def main(arguments: Sequence[str] | None = None) -> None:
    """Make the libraries that are missing."""
    parser = argparse.ArgumentParser(prog="python -m mebdf.compiled.make", description=__doc__)
    parser.add_argument("packages", nargs="+", metavar="PACKAGE")
    parser.add_argument("--dist", type=Path, default=Path("dist"), help="folder of wheels")
    parser.add_argument(
        "--system", choices=PLATFORMS, default=this_system(), help="system that it is made for"
    )
    given = parser.parse_args(arguments)
    gc.disable()  # looking for cycles takes a fifth of the time, and what it would free is little
    for package in given.packages:
        sources: Sources = importlib.import_module(f"{package}.kernels.jit").SOURCES
        if not is_there(sources, given.system) and not from_wheel(sources, given.system, given.dist):
            make(sources, given.system)


if __name__ == "__main__":
    main()
