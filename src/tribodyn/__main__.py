"""``python -m tribodyn`` is the command ``tribodyn``."""

import gc
import sys
from typing import Final

from tribodyn.cli.interrupt import hear_signals_to_the_end
from tribodyn.core.environment import ignore_settings

#: New objects between two searches for unreachable ones; by Python's 700 they take a tenth of a short run.
_FEW_SEARCHES: Final = 100_000

# Here and not in the function: processes that are not forked import this module, too.
ignore_settings()


def main() -> int:
    """Run the command in a process of its own, where signals are heard before all else is imported."""
    hear_signals_to_the_end()
    gc.set_threshold(_FEW_SEARCHES)
    from tribodyn.cli.console import escape_warnings
    from tribodyn.cli.main import main as command

    escape_warnings()

    status = command()
    # Python would search everything again before it ends, for a second where a run was short.
    gc.freeze()
    return status


if __name__ == "__main__":
    sys.exit(main())
