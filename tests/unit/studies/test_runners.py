from __future__ import annotations

import contextlib
import socket

from tribodyn.studies.runners import _local_client

DASK_DEFAULT = 8787


def test_a_sweep_needs_no_port_that_another_one_has() -> None:
    with socket.socket() as taken:
        taken.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        with contextlib.suppress(OSError):  # somebody has it already: as good
            taken.bind(("127.0.0.1", DASK_DEFAULT))
            taken.listen()
        # Dask would warn and offer another port; warnings are errors here.
        with _local_client(1) as client:
            assert client.submit(sum, (1, 2)).result() == 3
