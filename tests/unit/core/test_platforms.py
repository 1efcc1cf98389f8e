from pathlib import Path

import pytest

from tribodyn.core import platforms


@pytest.mark.parametrize(
    ("said", "allowed"),
    [("max 100000", 8), ("nonsense", 8), ("1000 100000", 1), ("250000 100000", 3), ("900000 100000", 8)],
)
def test_a_container_may_use_less_than_the_machine_has(
    said: str, allowed: int, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr("os.sched_getaffinity", lambda _: range(8), raising=False)
    monkeypatch.setattr("os.cpu_count", lambda: 8)
    quota = tmp_path / "cpu.max"
    monkeypatch.setattr(platforms, "_QUOTA", quota)
    assert platforms.processors() == 8
    quota.write_text(f"{said}\n", encoding="ascii")
    assert platforms.processors() == allowed
