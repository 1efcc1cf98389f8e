"""``python -m tribodyn`` is the command ``tribodyn``."""

from __future__ import annotations

import sys

from tribodyn.cli.interrupt import hear_signals_to_the_end


def main() -> int:
    """Run the command in a process of its own, where signals are heard before all else is imported."""
    hear_signals_to_the_end()
    from tribodyn.cli.main import main as command

    return command()


if __name__ == "__main__":
    sys.exit(main())
