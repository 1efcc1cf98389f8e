"""Workers are forked from a process that has imported and loaded everything."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from tribodyn.core import fork_server
from tribodyn.mechanisms.catalogue import load_case

TOML = load_case("vsv").to_toml()
# In a process of its own: the fork server of this one may have been started by another test.
ASKED = """
import json, os, sys

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.core import fork_server


def tell() -> None:
    from tribodyn.kernels.vsv.functions import rhs

    about = {"threads": os.environ["OMP_NUM_THREADS"], "loaded": rhs._listed is not None}
    print(json.dumps(about | {"left": fork_server._CASE in os.environ}))


if __name__ == "__main__":
    before = dict(os.environ)
    fork_server.start(**json.loads(sys.argv[1]))
    assert dict(os.environ) == before
    fork_server.process(tell).join()
    assert dict(os.environ) == before
"""


@pytest.mark.skipif(fork_server.METHOD != "forkserver", reason="workers begin from nothing here")
@pytest.mark.parametrize(
    "given",
    [{"toml": TOML}, {"name": "vsv", "changes": {"solver.name": "mebdf", "joint.clearance": "31 um"}}],
)
def test_a_worker_has_the_equations_from_its_birth(given: dict[str, object], tmp_path: Path) -> None:
    (script := tmp_path / "asked.py").write_text(ASKED, encoding="utf-8")
    asked = [sys.executable, str(script), json.dumps(given)]
    done = subprocess.run(asked, capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == {"threads": "1", "loaded": True, "left": False}
