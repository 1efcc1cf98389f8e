"""Workers are forked from a process that has imported and loaded everything."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

from tribodyn.core import fork_server
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.simulation import simulate

TOML = load_case("vsv").to_toml()
# In a process of its own: the fork server of this one may have been started by another test.
ASKED = """
import json, os, sys

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.core import fork_server
from tribodyn.studies import runners


def found() -> dict[str, object]:
    from tribodyn.kernels.vsv.functions import rhs

    about = {"threads": os.environ["OMP_NUM_THREADS"], "loaded": len(rhs.signatures)}
    return about | {"left": fork_server._CASE in os.environ}


if __name__ == "__main__":
    before = dict(os.environ)
    case, changes = json.loads(sys.argv[1])
    fork_server.start(case, changes)
    assert dict(os.environ) == before
    with runners._local_client(1) as client:
        print(json.dumps(client.submit(found).result()))
"""


@pytest.mark.skipif(fork_server.METHOD != "forkserver", reason="workers begin from nothing here")
@pytest.mark.parametrize(
    ("case", "changes"), [(TOML, {}), ("vsv", {"solver.name": "mebdf", "joint.clearance": "31 um"})]
)
def test_a_worker_has_the_equations_from_its_birth(case: str, changes: dict[str, str]) -> None:
    # The template loads what is in the cache, and compiles nothing.
    simulate(load_case("vsv").replace({"run.duration": "20 ms"}))
    asked = [sys.executable, "-c", ASKED, json.dumps([case, changes])]
    done = subprocess.run(asked, capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == {"threads": "1", "loaded": 1, "left": False}
