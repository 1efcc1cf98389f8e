"""The mechanisms, each in one folder and on one line of the list below."""

from __future__ import annotations

from typing import Final

from tribodyn.mechanisms.base import Mechanism
from tribodyn.mechanisms.journal.descriptor import JOURNAL
from tribodyn.mechanisms.vsv.descriptor import VSV

MECHANISMS: Final[dict[str, Mechanism]] = {
    mechanism.kind: mechanism
    for mechanism in (
        VSV,
        JOURNAL,
    )
}
"""Every mechanism, by the kind of its cases."""

__all__ = ["MECHANISMS", "Mechanism"]
