from __future__ import annotations

import os

import pytest


@pytest.fixture
def leaving(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let what would end this process at once raise ``SystemExit`` instead."""

    def leave(status: int) -> None:
        raise SystemExit(status)

    monkeypatch.setattr(os, "_exit", leave)
