"""What a person waits for at the workbench, and what it stands, beside what was promised.

python -m benchmarks.program.workbench [quick | MINUTES]

A page in a browser is dragged; a client that says at once that it has drawn stands in for a page where the
server alone is asked; many of them tell, for some minutes, what becomes of the memory, and a page on which
runs are pinned, for a third of that, what becomes of its own. Needs Chromium.
"""

from __future__ import annotations

import asyncio
import json
import re
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final, NamedTuple

import psutil

from benchmarks.program import workbench_page, workbench_pins
from benchmarks.program.workbench_hands import Hand, family, kept_busy, killed

DRAG: Final = 20.0  #: How long a slider is dragged [s].
SOCKETS: Final = 20
MINUTES: Final = 10.0
ROOT: Final = Path(__file__).parents[2]
_HOSTILE: Final = ("tests/faults/processes/test_hostile_workbench.py", "-k", "many or ten_thousand")


class Bound(NamedTuple):
    """What was promised: a number of a row, and how large it may be, or how small."""

    row: str
    number: str
    least: float = float("-inf")
    most: float = float("inf")

    @property
    def words(self) -> str:
        """How it is printed."""
        return f"at least {self.least:g}" if self.most == float("inf") else f"at most {self.most:g}"


BOUNDS: Final = (
    Bound("drag in a browser", "input to picture, median [s]", most=0.25),
    Bound("drag in a browser", "95 % [s]", most=0.4),
    Bound("drag in a browser", "pictures a second", least=4.0),
    Bound("page", "first picture after the command [s]", most=8.0),
    Bound("page", "without pictures [kB]", most=300.0),
    Bound("page", "requests to another origin", most=0.0),
    Bound("page", "serious faults by axe", most=0.0),
    Bound("pins", "growth over its standard error", most=2.0),
    Bound("pins", "errors of the page", most=0.0),
    Bound("pins", "numbers of other values than requested", most=0.0),
    Bound("sockets", "server, growth over its standard error", most=2.0),
    Bound("sockets", "workers, growth over its standard error", most=2.0),
    Bound("sockets", "processes left behind", most=0.0),
    Bound("worker killed", "late pictures", most=1.0),
    Bound("worker killed", "requests never answered", most=0.0),
    Bound("hostile", "tests of 10,000 messages and requests that fail", most=0.0),
)


def run(quick: bool = False, minutes: float = MINUTES) -> dict[str, Any]:
    """Measure, print and return; ``quick``: a short drag on one socket."""
    found: dict[str, Any] = {}
    with workbench() as (process, address):
        found |= asyncio.run(_alone(process, address, 0.5 if quick else DRAG))
    _print(found)
    if quick:
        return found
    with workbench() as (process, address):
        found |= workbench_page.measured(address, process.create_time(), DRAG)
    with workbench() as (_, address):
        found["pins"] = workbench_pins.pinned(address, minutes / 3.0)
    found |= asyncio.run(_together(minutes))
    found["hostile"] = _hostile()
    _print(found)
    for bound in BOUNDS:
        value = found[bound.row][bound.number]
        kept = "" if bound.least <= value <= bound.most else "  MISSED"
        print(f"{bound.row}: {bound.number}: {value:.3g}, {bound.words}{kept}", flush=True)
    return found


def _print(found: Mapping[str, Mapping[str, float]]) -> None:
    for name, row in found.items():
        print(f"{name}: " + ", ".join(f"{key} {value:.3g}" for key, value in row.items()), flush=True)


@contextmanager
def workbench() -> Iterator[tuple[psutil.Process, str]]:
    """Have a workbench, and its address with the key."""
    command = [sys.executable, "-m", "tribodyn", "workbench", "--json", "--quiet"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        told = "".join(process.stdout.readline() for _ in range(3))
        try:
            yield psutil.Process(process.pid), str(json.loads(told)["address"])
        finally:
            process.terminate()


async def _alone(process: psutil.Process, address: str, seconds: float) -> dict[str, dict[str, float]]:
    """Ask for the first picture and drag, without a browser; once more while a worker is killed."""
    hand = await Hand.at(*await Hand.entry(address))
    await hand.request({}, rest=True)
    await hand.picture()
    found = {"first picture": {"seconds": time.time() - process.create_time()}}
    found["drag"] = await hand.dragged(seconds)
    found["worker killed"] = await killed(hand, process, seconds)
    hand.socket.close()
    return found


async def _together(minutes: float) -> dict[str, dict[str, float]]:
    """Ask on many sockets, end the workbench, and count what is left of it."""
    with workbench() as (process, address):
        place, cookie = await Hand.entry(address)
        found = await kept_busy(process, place, cookie, SOCKETS, minutes)
        all_of_it: Sequence[psutil.Process] = family(process)
        process.terminate()
        _, left = psutil.wait_procs(all_of_it, timeout=60.0)
    return {"sockets": {**found, "processes left behind": float(len(left))}}


def _hostile() -> dict[str, float]:
    """Run the tests that send nonsense and lies, ten thousand of each kind."""
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *_HOSTILE]
    told = subprocess.run(command, cwd=ROOT, capture_output=True, text=True).stdout
    passed, failed = (
        sum(map(float, re.findall(rf"(\d+) (?:{word})", told))) for word in ("passed", "failed|error")
    )
    return {
        "tests that pass": passed,
        "tests of 10,000 messages and requests that fail": failed or float(not passed),
    }


if __name__ == "__main__":
    given = sys.argv[1:]
    run(quick=given == ["quick"], minutes=float(given[0]) if given not in ([], ["quick"]) else MINUTES)
