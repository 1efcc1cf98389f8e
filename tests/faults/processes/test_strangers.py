"""Another user of the machine tries to talk to a sweep that runs."""

import os
import re
import stat
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import psutil
import pytest

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")

SWEEP = [
    *(sys.executable, "-m", "tribodyn", "sweep", "vsv", "--workers", "2", "--summary-only"),
    *("--vary", "joint.clearance=20:38:1 um", "--set", "run.duration=0.1 s"),
]
NOBODY = 65534
TCP_LISTENS, UNIX_LISTENS = "0A", 0x10000  #: State in /proc/net/tcp, flag in /proc/net/unix.
KNOCK = """
import os, socket, sys

if os.getuid() == 0:
    os.setgroups([])
    os.setgid(int(sys.argv[1]))
    os.setuid(int(sys.argv[1]))
for address in sys.argv[2:]:
    places = [(socket.AF_UNIX, address.replace("@", "\\0"))]
    if address.isdigit():
        places = [(socket.AF_INET, ("127.0.0.1", int(address))), (socket.AF_INET6, ("::1", int(address)))]
    for family, place in places:
        try:
            socket.socket(family).connect(place)
        except OSError:
            continue
        print(address)
"""


@pytest.fixture(scope="module")
def shared() -> Iterator[Path]:
    """Return a folder for temporary files that anybody can reach and write to, as /tmp is."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o1777)
        yield Path(folder)


@pytest.fixture(scope="module")
def family(shared: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[list[psutil.Process]]:
    """Return the processes of a sweep that is under way."""
    folder, environment = tmp_path_factory.mktemp("sweep"), os.environ | {"TMPDIR": str(shared)}
    with subprocess.Popen(SWEEP, cwd=folder, env=environment, stderr=subprocess.PIPE, text=True) as process:
        assert process.stderr is not None
        while "of 19 points, " not in (line := process.stderr.readline()):
            assert line, "the sweep ended before it computed a point"
        sweep = psutil.Process(process.pid)
        # So that it is still under way when all has been looked at.
        sweep.suspend()
        found = [sweep, *sweep.children(recursive=True)]
        yield found
        sweep.kill()
    assert psutil.wait_procs(found, timeout=300)[1] == []


def listening(family: list[psutil.Process]) -> list[str]:
    """Return where processes can be talked to: TCP ports, and sockets by their path or, after an @, name."""
    return [
        *ports(own := sockets(family)),
        *[row[7] for row in rows("unix") if row[6] in own and int(row[3], 16) & UNIX_LISTENS],
    ]


def sockets(family: list[psutil.Process]) -> set[str]:
    """Return the inodes of all sockets that processes hold."""
    held = set()
    for handle in (handle for process in family for handle in Path(f"/proc/{process.pid}/fd").iterdir()):
        with suppress(OSError):
            held |= set(re.findall(r"socket:\[(\d+)\]", os.readlink(handle)))
    return held


def rows(table: str) -> list[list[str]]:
    path = Path("/proc/net", table)
    return [line.split() for line in path.read_text().splitlines()[1:]] if path.exists() else []


def ports(inodes: set[str]) -> list[str]:
    found = [row for table in ("tcp", "tcp6") for row in rows(table) if row[9] in inodes]
    return [str(int(row[1].rpartition(":")[2], 16)) for row in found if row[3] == TCP_LISTENS]


def test_a_stranger_is_refused_wherever_a_sweep_listens(family: list[psutil.Process]) -> None:
    assert len(family) >= 4, "a sweep, the process it forks from and two workers"
    asked = listening(family)
    if os.getuid() != 0:
        # This test cannot become another user; what only its own can reach is the matter of the next one.
        asked = [address for address in asked if not address.startswith("/")]
    knock = [sys.executable, "-I", "-c", KNOCK, str(NOBODY), *asked]
    opened = subprocess.run(knock, cwd="/", capture_output=True, text=True, check=True).stdout
    assert opened.split() == []


def test_what_a_sweep_puts_among_shared_temporary_files_is_closed_to_others(family, shared):
    put = {path: path.lstat() for path in shared.iterdir()}
    assert {oct(stat.S_IMODE(status.st_mode)) for status in put.values()} <= {"0o700", "0o600"}
    assert {status.st_uid for status in put.values()} <= {os.getuid()}
    inside = [Path(address) for address in listening(family)]
    assert all(path.parent in put for path in inside), inside
