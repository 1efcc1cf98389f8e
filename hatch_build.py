"""Machine code of the kernels, made when a wheel is built."""

from __future__ import annotations

import os
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
        path = os.pathsep.join([*map(str, filter(Path.is_dir, places)), os.environ.get("PYTHONPATH", "")])
        command = [sys.executable, "-m", "mebdf.compiled.make", self.metadata.core.name]
        subprocess.run(command, cwd=root, env=os.environ | {"PYTHONPATH": path}, check=True)
        build_data["pure_python"], build_data["tag"] = False, TAG
