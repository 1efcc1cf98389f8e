"""What options of LLVM that keep every bit do to the time of runs, and to the size of the library.

    python -m benchmarks.program.llvm_options

writes ``docs/_static/llvm_options.csv``: processor times over those of the library as it is built, of the
shortest of runs that take turns; "!" marks other results. It takes some twenty minutes.
"""

from __future__ import annotations

import csv
import hashlib
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, Final

from llvmlite import binding as llvm

from mebdf.compiled import build, jit, make
from mebdf.compiled.kernel import entries
from mebdf.compiled.library import MANIFEST, fingerprint, level, system
from mebdf.compiled.platforms import PLATFORMS
from tribodyn.kernels.jit import SOURCES

TARGET: Final = Path(__file__).parents[2] / "docs" / "_static" / "llvm_options.csv"
CASES: Final = ("vsv", "vsv-joints", "slider-crank")
REPEATS: Final = 3
WIDTH: Final = r'\1 "prefer-vector-width"="{}" {{'
VARIANTS: Final[dict[str, dict[str, Any]]] = {
    "as built": {},
    "inlining 50": {"inlining_threshold": 50},
    "inlining 1000": {"inlining_threshold": 1000},
    "no SLP vectors": {"slp_vectorization": False},
    "v4, 256 bits": {"processor": "x86-64-v4"},
    "v4, 512 bits": {"processor": "x86-64-v4", "width": 512},
}
CHILD: Final = """
import json, sys, time
from pathlib import Path
from mebdf.compiled.library import Sources
own = Sources.folder.fget
Sources.folder = property(lambda self: Path(sys.argv[1]) if self.package.name == "tribodyn" else own(self))
import tribodyn
tribodyn.simulate(sys.argv[2])
began = time.thread_time()
found = tribodyn.simulate(sys.argv[2])
print(json.dumps([time.thread_time() - began, found.attrs["rows_sha256"], found.attrs["machine_code"]]))
"""


def made(text: str, manifest: dict[str, Any], folder: Path, options: dict[str, Any]) -> int:
    """Write the library of a variant; return its size in bytes."""
    create, here, processors = llvm.create_pass_builder, level(), PLATFORMS[system()].processors
    kept, tuning = processors[here], {k: v for k, v in options.items() if k not in ("width", "processor")}

    def tuned(target: Any, speed: Any) -> Any:
        for name, value in tuning.items():
            setattr(speed, name, value)
        return create(target, speed)

    if "width" in options:
        text = re.sub(r"^(define .*) \{$", WIDTH.format(options["width"]), text, flags=re.M)
    processors[here], llvm.create_pass_builder = options.get("processor", kept), tuned
    try:
        code = make._library(text, system(), here)
    finally:
        processors[here], llvm.create_pass_builder = kept, create
    folder.mkdir()
    (folder / f"{here}.so").write_bytes(code)
    levels = {here: hashlib.sha256(code).hexdigest()}
    (folder / MANIFEST).write_text(json.dumps(manifest | {"levels": levels}), encoding="utf-8")
    return len(code)


def timed(folder: Path, case: str) -> tuple[float, str]:
    """Return the time of a second run of a case with a library, and the hash of its rows."""
    command = [sys.executable, "-c", CHILD, str(folder), case]
    seconds, rows, library = json.loads(subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout)
    code = hashlib.sha256((folder / f"{level()}.so").read_bytes()).hexdigest()
    assert code[:16] in library, library
    return seconds, rows


def run() -> None:
    """Print and write the table."""
    listed = entries(SOURCES)
    functions = [jit.compiled(kernel, kernel.layouts) for kernel in listed]
    described = [(function.symbol, function.kinds, function.result) for function in functions]
    text = str(build.linked(jit.libraries(functions), described))
    numbered = enumerate(zip(listed, functions, strict=True))
    manifest = {
        "sources": fingerprint(SOURCES),
        "system": system(),
        "functions": {k.name: [number, k.digest(k.layouts), f.result] for number, (k, f) in numbered},
    }
    with tempfile.TemporaryDirectory() as place:
        folders = {name: Path(place, str(k)) for k, name in enumerate(VARIANTS)}
        sizes = {name: made(text, manifest, folders[name], options) for name, options in VARIANTS.items()}
        times: dict[tuple[str, str], list[tuple[float, str]]] = {}
        for case in CASES:
            for _ in range(REPEATS):
                for name, folder in folders.items():
                    times.setdefault((name, case), []).append(timed(folder, case))
    table = [["options", "MB", *CASES]]
    for name in VARIANTS:
        cells = []
        for case in CASES:
            of, by = times[name, case], times["as built", case]
            ratio = min(of)[0] / min(by)[0]
            cells.append(f"{ratio:.3f}" + ("" if of[0][1] == by[0][1] else "!"))
        table.append([name, f"{sizes[name] / 1e6:.2f}", *cells])
        print(*table[-1], sep=",", flush=True)
    with TARGET.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(table)


if __name__ == "__main__":
    run()
