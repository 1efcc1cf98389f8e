"""The command, as a process of its own."""

import json
import signal
import subprocess
import urllib.error
import urllib.request
from urllib.parse import urlsplit

import psutil
import pytest
from tests.unit.workbench.host import TRIBODYN

from tribodyn.cli.main import main

COMMAND = [*TRIBODYN, "workbench"]


def asked(address: str):
    """Ask for an address as a browser does, which knows where names in localhost are."""
    parts = urlsplit(address)
    request = urllib.request.Request(address.replace(str(parts.hostname), "127.0.0.1", 1))
    request.add_header("Host", parts.netloc)
    return urllib.request.urlopen(request)


def test_it_says_where_it_is_lets_one_browser_in_and_leaves_nothing_behind():
    options = ["journal-dry", "--set", "joints.bearing.clearance.radial=30 um", "--json", "--workers", "1"]
    with subprocess.Popen(
        [*COMMAND, *options], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        lines = [process.stdout.readline() for _ in range(3)]
        address = json.loads("".join(lines))["address"]
        family = psutil.Process(process.pid).children(recursive=True)
        with asked(address) as answer:
            assert "HttpOnly" in answer.headers["Set-Cookie"]
        with pytest.raises(urllib.error.HTTPError, match="403"):
            asked(address)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=300)
    assert process.returncode == 0
    assert "closing the workbench" in said
    assert "Traceback" not in said
    token = address.partition("=")[2]
    assert token not in said
    _, left = psutil.wait_procs(family, timeout=300)
    assert left == []


@pytest.mark.parametrize(
    ("options", "key"),
    [(["--port", "70000"], "--port"), (["--workers", "0"], "--workers"), (["no-such-case"], "no-such-case")],
)
def test_what_it_cannot_do_is_said_at_once(options, key, capsys):
    assert main(["workbench", *options]) == 2
    assert key in capsys.readouterr().err
