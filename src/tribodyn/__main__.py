"""``python -m tribodyn`` is the command ``tribodyn``."""

from __future__ import annotations

import sys

from tribodyn.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
