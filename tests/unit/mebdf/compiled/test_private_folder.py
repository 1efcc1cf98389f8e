"""Nobody but this user can have written what is in a private folder; old ones go."""

from __future__ import annotations

import os
import stat
import threading
import time
from pathlib import Path

import pytest

from mebdf.compiled.private_folder import NotPrivate, locked, private_folder, prune

DAY = 86400.0


@pytest.mark.parametrize("umask", [0o000, 0o077])
def test_a_new_folder_is_for_its_owner_alone(tmp_path: Path, umask: int) -> None:
    before = os.umask(umask)
    try:
        made = private_folder(tmp_path / "missing" / "own")
    finally:
        os.umask(before)
    assert stat.S_IMODE(made.stat().st_mode) == 0o700
    assert private_folder(made) == made


@pytest.mark.parametrize("mode", [0o770, 0o702, 0o777])
def test_a_folder_that_others_may_write_to_is_refused(tmp_path: Path, mode: int) -> None:
    folder = tmp_path / "open"
    folder.mkdir()
    folder.chmod(mode)
    with pytest.raises(NotPrivate, match="others may write"):
        private_folder(folder)


def test_a_folder_of_another_user_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = private_folder(tmp_path / "theirs")
    other = os.geteuid() + 1
    monkeypatch.setattr(os, "geteuid", lambda: other)
    with pytest.raises(NotPrivate, match="another user"):
        private_folder(folder)


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give a link to somebody else")
def test_a_link_that_another_user_planted_is_refused(tmp_path: Path) -> None:
    own = private_folder(tmp_path / "own")
    link = tmp_path / "link"
    link.symlink_to(own)
    assert private_folder(link) == link
    os.chown(link, 65534, 65534, follow_symlinks=False)
    with pytest.raises(NotPrivate, match="another user"):
        private_folder(link)


def test_what_is_no_folder_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    (tmp_path / "dangling").symlink_to(tmp_path / "nowhere")
    for name in ("file", "dangling", "file/below"):
        with pytest.raises(OSError, match=str(tmp_path)):
            private_folder(tmp_path / name)


def test_the_lock_keeps_others_out_until_it_is_given_back(tmp_path: Path) -> None:
    entered = threading.Event()

    def enter() -> None:
        with locked(tmp_path):
            entered.set()

    other = threading.Thread(target=enter)
    with locked(tmp_path):
        other.start()
        assert not entered.wait(0.2)
    assert entered.wait(10.0)
    other.join()


def folders(parent: Path, ages: list[float]) -> None:
    """Make folders named by their places in the list, last used so long ago [s]."""
    for place, age in enumerate(ages):
        folder = parent / f"{place:02d}"
        folder.mkdir()
        (folder / "code").touch()
        os.utime(folder, times=(time.time() - age, time.time() - age))


def left(parent: Path) -> list[int]:
    return sorted(int(path.name) for path in parent.glob("[0-9]*"))


def test_of_old_folders_the_four_used_last_stay(tmp_path: Path) -> None:
    folders(tmp_path, [(2 + place) * DAY for place in range(7)])
    prune(tmp_path, "[0-9][0-9]")
    assert left(tmp_path) == [0, 1, 2, 3]


def test_what_was_used_today_stays_unless_it_is_too_much(tmp_path: Path) -> None:
    folders(tmp_path, [60.0 * place for place in range(20)])
    prune(tmp_path, "[0-9][0-9]")
    assert left(tmp_path) == list(range(16))


def test_only_folders_of_the_pattern_go(tmp_path: Path) -> None:
    folders(tmp_path, [(2 + place) * DAY for place in range(6)])
    others = [tmp_path / "notes", tmp_path / "123"]
    for path in others:
        path.mkdir()
        os.utime(path, times=(0.0, 0.0))
    (tmp_path / "99").symlink_to(others[0])
    prune(tmp_path, "[0-9][0-9]")
    assert all(path.is_dir() for path in others)
    assert (tmp_path / "99").is_symlink()
    assert not (tmp_path / "05").exists()
