"""What every case has in common: frozen groups of keys, changed copies, TOML text."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Self, TypeVar

from pydantic import BaseModel, ConfigDict, PrivateAttr, ValidationInfo, field_validator

from tribodyn.cases.keys import Value, family_names, text
from tribodyn.core.errors import InputError

_T = TypeVar("_T")


class Group(BaseModel):
    """A table of a case file: frozen, and closed to keys it does not declare."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=False)

    @field_validator("*", mode="after")
    @classmethod
    def _in_family(cls, value: _T, info: ValidationInfo) -> _T:
        extra = cls.model_fields[str(info.field_name)].json_schema_extra
        family = extra.get("family") if isinstance(extra, dict) else None
        if family and value not in family_names(str(family)):
            raise ValueError("not a member of the family")
        return value


class Case(Group):
    """A complete, validated description of one simulation; SI units throughout.

    Attribute paths are the paths of the case file: ``case.joint.clearance`` is ``clearance`` of
    the table ``[joint]``. Make one with :func:`tribodyn.load_case`, change it with :meth:`replace`.
    """

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = ()
    """Pairs of keys of which only one may be given."""

    case: str
    title: str = text("", "heading of figures and report")

    _given: dict[str, Any] = PrivateAttr(default_factory=dict)
    _scans: dict[str, Any] = PrivateAttr(default_factory=dict)

    @classmethod
    def kind(cls) -> str:
        """Return the name that stands under ``case =`` in a file."""
        return str(cls.model_fields["case"].default)

    @classmethod
    def resolve(cls, given: Mapping[str, Value]) -> dict[str, Value]:
        """Return the defaults that depend on what was given; by default there are none."""
        return {}

    @property
    def duration(self) -> float:
        """Simulated time of the whole run [s]."""
        raise NotImplementedError

    @property
    def campaign_cycles(self) -> int:
        """Drive cycles of a wear campaign; 0 where the case asks for none."""
        return 0

    def at(self, path: str) -> Value | None:
        """Return the value at a dotted path, such as ``joint.clearance``."""
        value: Any = self
        for name in path.split("."):
            value = getattr(value, name)
        found: Value | None = value
        return found

    def replace(self, changes: Mapping[str, object], *, source: str = "replace") -> Self:
        """Return a copy with some keys changed; defaults that depend on them follow.

        Parameters
        ----------
        changes
            New values by dotted path, written as in a case file: ``{"joint.clearance": "30 um"}``.
        source
            Where the changes come from, for messages.
        """
        from tribodyn.cases.build import changed

        return changed(self, changes, source)

    def to_toml(self, *, comments: bool = False) -> str:
        """Return the case as TOML that reads back to an equal case.

        Parameters
        ----------
        comments
            Whether each key is followed by what it means, where it comes from and what it may hold.
        """
        from tribodyn.cases.write import to_toml

        return to_toml(self, comments=comments)

    def __eq__(self, other: object) -> bool:
        """Cases are equal when all their values are, however they were spelled."""
        return isinstance(other, Case) and self.model_dump() == other.model_dump()

    def __hash__(self) -> int:
        """Hash of all values."""
        return hash(self.model_dump_json())


def demand(condition: bool, key: str, message: str) -> None:
    """Raise an :class:`InputError` about `key` unless `condition` holds."""
    if not condition:
        raise InputError(message, key=key)
