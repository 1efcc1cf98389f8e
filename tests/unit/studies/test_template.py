"""Workers are forked from a process that has imported and loaded everything."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest

from tribodyn.cases import load_case
from tribodyn.simulation import simulate
from tribodyn.studies import template

# In a process of its own: the fork server of this one may have been started by another test.
ASKED = """
import json, os, sys

from tribodyn.cases import load_case
from tribodyn.studies import runners, template


def found() -> dict[str, object]:
    from tribodyn.kernels.vsv.functions import rhs

    about = {"threads": os.environ["OMP_NUM_THREADS"], "loaded": len(rhs.signatures)}
    return about | {"left": template._CASE in os.environ}


if __name__ == "__main__":
    before = dict(os.environ)
    template.start(load_case("vsv").to_toml(), {"OMP_NUM_THREADS": "1"})
    assert dict(os.environ) == before
    with runners._local_client(1) as client:
        print(json.dumps(client.submit(found).result()))
"""


@pytest.mark.skipif(template.METHOD != "forkserver", reason="workers begin from nothing here")
def test_a_worker_has_the_equations_from_its_birth() -> None:
    # The template loads what is in the cache, and compiles nothing.
    simulate(load_case("vsv").replace({"run.duration": "20 ms"}))
    done = subprocess.run([sys.executable, "-c", ASKED], capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == {"threads": "1", "loaded": 1, "left": False}


def test_where_processes_cannot_be_forked_nothing_is_started(monkeypatch: pytest.MonkeyPatch) -> None:
    def never() -> None:
        raise AssertionError

    monkeypatch.setattr(template, "METHOD", "spawn")
    monkeypatch.setattr("multiprocessing.forkserver.ensure_running", never)
    template.start(load_case("vsv").to_toml(), {})
    assert template._CASE not in os.environ
