"""The server for many behind nginx, set up as the manual says: https, a password, and nobody gets around it.

Left out where nginx is not installed; TRIBODYN_NGINX names one in another place.
"""

from __future__ import annotations

import getpass
import itertools
import os
import shutil
import socket
import subprocess
import textwrap
import time
from base64 import b64encode
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import pytest
from tests.unit.workbench.host import PUBLIC, SOON, TRIBODYN, Page, in_loop
from tests.unit.workbench.test_server import EVIL, ROUTES, UPGRADE
from tests.unit.workbench.test_sessions import secret_in
from tornado.httpclient import AsyncHTTPClient, HTTPRequest, HTTPResponse
from tornado.websocket import websocket_connect

GUIDE = Path(__file__).parents[2] / "docs" / "guide" / "workbench.md"
NGINX = os.environ.get("TRIBODYN_NGINX") or shutil.which("nginx", path=f"{os.environ['PATH']}:/usr/sbin")
ENTRANCE = {"Authorization": "Basic " + b64encode(b"anna:secret").decode()}
SETTINGS = """
    user {user};
    pid {folder}/pid;
    error_log {folder}/errors;
    events {{ }}
    http {{
        access_log off;
        client_body_temp_path {folder}/a; proxy_temp_path {folder}/b; fastcgi_temp_path {folder}/c;
        uwsgi_temp_path {folder}/d; scgi_temp_path {folder}/e;
        server {{
            listen 127.0.0.1:{port} ssl;
            ssl_certificate {folder}/certificate;
            ssl_certificate_key {folder}/key;
            {location}
        }}
    }}
"""

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(not (NGINX and shutil.which("openssl")), reason="needs nginx and openssl"),
]


@dataclass
class Proxy:
    """A proxy that listens, with the server behind it."""

    port: int
    certificate: str

    @property
    def host(self) -> str:
        return f"{PUBLIC}:{self.port}"

    def request(self, scheme: str, path: str, headers: Mapping[str, str]) -> HTTPRequest:
        address = f"{scheme}://127.0.0.1:{self.port}{path}"
        return HTTPRequest(address, headers=dict(headers), ca_certs=self.certificate, request_timeout=SOON)

    async def get(self, path: str, headers: Mapping[str, str]) -> HTTPResponse:
        return await AsyncHTTPClient().fetch(self.request("https", path, headers), raise_error=False)

    async def admitted(self) -> tuple[str, str]:
        """Come with a password, and return the cookie and the secret as an address has it."""
        answer = await self.get("/?token=new", {"Host": self.host, **ENTRANCE})
        assert answer.code == 200
        return answer.headers["Set-Cookie"].partition(";")[0], secret_in(answer.body)


@pytest.fixture(scope="module")
def proxy(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Proxy]:
    """The proxy of the manual before a server of its own, both as processes."""
    folder = tmp_path_factory.mktemp("proxy")
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    options = [f"{PUBLIC}:{port}", "--case", "journal-dry", "--port", "0", "--workers", "1"]
    command = [*TRIBODYN, "serve", *options]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as server:
        assert server.stderr is not None
        behind = int(server.stderr.readline().split(" for ")[0].rpartition(":")[2])
        write_settings(folder, port, behind)
        program = [str(NGINX), "-c", f"{folder}/settings", "-p", str(folder), "-g", "daemon off;"]
        with subprocess.Popen(program, stderr=subprocess.DEVNULL) as nginx:
            wait_until_open(port)
            yield Proxy(port, f"{folder}/certificate")
            nginx.terminate()
        server.terminate()


def write_settings(folder: Path, port: int, behind: int) -> None:
    """Write what nginx needs: the manual's lines with our port and password, and a certificate."""
    text = GUIDE.read_text(encoding="utf-8")
    block = textwrap.dedent(text[text.index("    location / {") :].partition("\n\n")[0])
    location = block.replace("127.0.0.1:8000", f"127.0.0.1:{behind}").replace("/etc/nginx", str(folder))
    assert location.count(str(folder)) == location.count(str(behind)) == 1
    (folder / "vanes").write_text("anna:{PLAIN}secret\n", encoding="ascii")
    (folder / "settings").write_text(
        SETTINGS.format(user=getpass.getuser(), folder=folder, port=port, location=location)
    )
    names = f"subjectAltName=DNS:{PUBLIC},IP:127.0.0.1"
    kind = ["-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-days", "2"]
    made = ["-subj", f"/CN={PUBLIC}", "-addext", names, "-keyout", f"{folder}/key"]
    command = ["openssl", "req", *kind, *made, "-out", f"{folder}/certificate"]
    subprocess.run(command, check=True, capture_output=True)


def wait_until_open(port: int) -> None:
    """Wait until somebody listens."""
    until = time.monotonic() + SOON
    while True:
        try:
            socket.create_connection(("127.0.0.1", port)).close()
        except ConnectionRefusedError:
            assert time.monotonic() < until
            time.sleep(0.05)
        else:
            return


def test_without_the_password_nothing_is_behind_the_proxy(proxy: Proxy) -> None:
    @in_loop
    async def test() -> None:
        cookie, secret = await proxy.admitted()
        ours = {"Host": proxy.host, "Cookie": cookie, "Origin": f"https://{proxy.host}"}
        for route in (f"{path}?{secret}" for path in ROUTES):
            for headers in (ours, {**ours, **UPGRADE}):
                assert (await proxy.get(route, headers)).code == 401

    test()


def test_through_the_proxy_only_our_own_page_is_answered(proxy: Proxy) -> None:
    @in_loop
    async def test() -> None:
        cookie, secret = await proxy.admitted()
        hosts = (proxy.host, PUBLIC, f"127.0.0.1:{proxy.port}", "evil.example")
        origins = (None, f"https://{proxy.host}", f"http://{proxy.host}", f"https://{PUBLIC}", "null", EVIL)
        for host, origin, known in itertools.product(hosts, origins, (cookie, f"{cookie}x", None)):
            asked = {"Host": host, "Origin": origin, "Cookie": known, **ENTRANCE}
            headers = {name: value for name, value in asked.items() if value is not None}
            ours = host == proxy.host and origin in origins[:2]
            for route in ROUTES:
                # Whom the proxy lets in may ask for the page without a cookie: that is how one is given.
                plain = ours and (known == cookie or route == "/")
                path = f"{route}?{secret}"
                assert ((await proxy.get(path, headers)).code != 403) == plain, (route, headers)
                if not (ours and origin and known == cookie):
                    assert (await proxy.get(path, {**headers, **UPGRADE})).code == 403, (route, headers)

    test()


def test_through_the_proxy_a_page_is_sent_its_pictures(proxy: Proxy) -> None:
    @in_loop
    async def test() -> None:
        cookie, secret = await proxy.admitted()
        ours = {"Host": proxy.host, "Cookie": cookie, "Origin": f"https://{proxy.host}"}
        answer = await proxy.get("/", {**ours, **ENTRANCE})
        assert f"wss://{proxy.host}" in answer.headers["Content-Security-Policy"]
        request = proxy.request("wss", f"/socket?{secret}", {**ours, **ENTRANCE})
        page = Page(await websocket_connect(request, max_message_size=10**8))
        assert (await page.until("hello"))["mechanism"] == "journal"
        await page.run(1, {"joint.clearance": "31 um", "run.duration": "2 ms"}, rest=True)
        found = (await page.picture()).header
        assert found["values"]["joint.clearance"] == "31 um"
        assert found["failure"] == ""
        await page.leave()

    test()
