"""What is kept of pictures takes hardly more memory than they do, however many there were."""

import platform
import subprocess
import sys

import pytest

KEPT, MADE, LEAST, MOST = 40, 400, 1_000_000, 1_300_000
PROGRAM = f"""
import random
from collections import deque
import psutil
from tribodyn.core.platforms import give_back_large_blocks
give_back_large_blocks()
source, process = random.Random(1), psutil.Process()
kept, others = deque(maxlen={KEPT}), []
before = process.memory_info().rss
for _ in range({MADE}):
    kept.append(bytearray(source.randrange({LEAST}, {MOST})))
    kept[-1][::4096] = b"x" * len(kept[-1][::4096])
    others.append(bytearray(source.randrange(1000, 5000)))
print(process.memory_info().rss - before - sum(map(len, kept)) - sum(map(len, others)))
"""


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="other libraries have other ways")
def test_forgotten_pictures_leave_no_gaps() -> None:
    found = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True)
    # Rounded up to pages, and what Python itself takes; without, it is over 20 MB.
    assert int(found.stdout) < 5_000_000
