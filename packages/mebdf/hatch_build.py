"""Machine code of the kernels, made when a wheel is built."""

import os
import platform
import runpy
import subprocess
import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class Kernels(BuildHookInterface[Any]):
    """Puts the library into wheels; on systems that have none, kernels are compiled where they run."""

    def dependencies(self) -> list[str]:
        """Return the package that a build for another system needs: a linker."""
        return ["ziglang>=0.13"] if "MEBDF_SYSTEM" in os.environ else []

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Make the library for this system, or the one that ``MEBDF_SYSTEM`` names.

        An editable installation takes what `make kernels` makes.
        """
        root = Path(self.root)
        places = [*filter(Path.is_dir, (root / "src", root / "packages" / "mebdf" / "src"))]
        listed = next(
            file for place in places if (file := place / "mebdf" / "compiled" / "platforms.py").exists()
        )
        platforms = runpy.run_path(str(listed))["PLATFORMS"]
        system = os.environ.get("MEBDF_SYSTEM", f"{sys.platform}-{platform.machine()}")
        if version == "editable" or system not in platforms:
            return
        # Not by PYTHONPATH: the environment of a build takes from it what is installed as editable beside it.
        package = self.metadata.core.name
        program = (
            f"import sys; sys.path[:0] = {[*map(str, places)]!r}; "
            f"from mebdf.compiled.make import main; main([{package!r}, '--system', {system!r}])"
        )
        subprocess.run([sys.executable, "-c", program], cwd=root, check=True)
        build_data["pure_python"], build_data["tag"] = False, platforms[system].tag
