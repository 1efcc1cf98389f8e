import os

import pytest

from tribodyn.core import fork_server


def test_where_processes_cannot_be_forked_nothing_is_started(monkeypatch: pytest.MonkeyPatch) -> None:
    def never() -> None:
        raise AssertionError

    monkeypatch.setattr(fork_server, "METHOD", "spawn")
    monkeypatch.setattr("multiprocessing.forkserver.ensure_running", never)
    fork_server.start(name="vsv")
    assert fork_server._CASE not in os.environ


def test_the_case_is_taken_once_and_found_by_nobody_else(monkeypatch: pytest.MonkeyPatch) -> None:
    assert fork_server.take_case() is None
    monkeypatch.setenv(fork_server._CASE, '{"name": "vsv"}')
    assert fork_server.take_case() == {"name": "vsv"}
    assert fork_server.take_case() is None
