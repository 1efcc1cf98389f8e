"""Machine code of the kernels, made when a wheel is built."""

from __future__ import annotations

import platform
import subprocess
import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

TAG = "py3-none-manylinux_2_17_x86_64"
"""Any Python: the library is called by its addresses, and takes three functions of the C library at most."""


class Kernels(BuildHookInterface[Any]):
    """Puts the library into wheels for Linux; on other systems kernels are compiled where they run."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Make the library; an editable installation takes what `make kernels` makes."""
        if version == "editable" or (sys.platform, platform.machine()) != ("linux", "x86_64"):
            return
        root = Path(self.root)
        places = [root / "src", root / "packages" / "mebdf" / "src"]
        # Not by PYTHONPATH: the environment of a build takes from it what is installed as editable beside it.
        paths = [*map(str, filter(Path.is_dir, places))]
        package = self.metadata.core.name
        program = (
            f"import sys; sys.path[:0] = {paths!r}; from mebdf.compiled.make import main; main([{package!r}])"
        )
        subprocess.run([sys.executable, "-c", program], cwd=root, check=True)
        build_data["pure_python"], build_data["tag"] = False, TAG
