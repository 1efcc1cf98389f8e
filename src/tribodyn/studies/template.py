"""Template of local workers, with everything imported and the equations of a case loaded.

The fork server imports this module, which is when it prepares itself. So does a worker that takes the place
of one that died begin at once.
"""

import gc
import signal
from collections.abc import Mapping
from typing import Any

from tribodyn.core.fork_server import take_case


def _prepare(given: Mapping[str, Any]) -> None:
    """Import and load what workers need, in the process they are forked from."""
    # Ctrl-C is for the command, which ends its workers.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    from tribodyn.studies.work import load

    load(**given)
    # Objects that live for ever need not be searched for garbage in every worker.
    gc.freeze()


if given := take_case():
    _prepare(given)
