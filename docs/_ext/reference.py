"""Pages of the reference, one for each package: one for each module would make every side bar long."""

from __future__ import annotations

import pkgutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import mebdf
import tribodyn

GENERATED = Path("reference", "generated")
TOPS = {"tribodyn": tribodyn, "mebdf": mebdf}


def packages() -> Iterator[str]:
    """Yield the dotted name of every part of tribodyn, then of the solver and the packages below it."""
    own = pkgutil.iter_modules(tribodyn.__path__, "tribodyn.")
    yield from (found.name for found in own if not found.ispkg and not found.name.endswith("__main__"))
    yield from _below("tribodyn")
    yield "mebdf"
    yield from _below("mebdf")


def _below(top: str) -> Iterator[str]:
    return (found.name for found in pkgutil.walk_packages(TOPS[top].__path__, f"{top}.") if found.ispkg)


def page(package: str) -> str:
    """Return the page of a package: itself, then each of its modules."""
    top, *below = package.split(".")
    folder = Path(*TOPS[top].__path__, *below)
    modules = [module.name for module in pkgutil.iter_modules([str(folder)]) if not module.ispkg]
    parts = [_part(package, "=")]
    parts += [_part(f"{package}.{name}", "-") for name in modules if not name.startswith("__")]
    return "\n".join(parts)


def _part(module: str, line: str) -> str:
    return (
        f"{module}\n{line * len(module)}\n\n.. automodule:: {module}\n   :members:\n   :ignore-module-all:\n"
    )


def _write(app: Any) -> None:
    folder = Path(app.srcdir) / GENERATED
    folder.mkdir(parents=True, exist_ok=True)
    there = {f"{package}.rst": page(package) for package in packages()}
    for old in folder.glob("*.rst"):
        if old.name not in there:
            old.unlink()
    for name, text in there.items():
        path = folder / name
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


def setup(app: Any) -> dict[str, bool]:
    """Write the pages before they are read."""
    app.connect("builder-inited", _write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
