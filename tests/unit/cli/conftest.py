import os

import pytest

from tribodyn.cli import interrupt


@pytest.fixture
def leaving(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let what would end this process at once raise ``SystemExit`` instead."""

    def leave(status: int) -> None:
        raise SystemExit(status)

    monkeypatch.setattr(os, "_exit", leave)
    # Later tests may need the folder of workers of this process.
    monkeypatch.setattr(interrupt, "_forget_workers", lambda: None)
