"""Laws from outside of this package: a class, or a function of the separation."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, TypeAlias

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.contact.contact_law import ContactLaw
from tribodyn.core.errors import InputError

#: User-defined law: a class, or a function that returns the pressure [Pa] at an array of h*.
OwnLaw: TypeAlias = type[ContactLaw] | Callable[[FloatArray], Any]

_FACTS = ("name", "title", "source", "validity")


def law_of_user(given: OwnLaw) -> type[ContactLaw]:
    """Return the class of a law that a user gives.

    Parameters
    ----------
    given
        A subclass of :class:`ContactLaw`, or a function of h* = h/σ that returns the pressure in Pa, which
        the law is named after.

    Returns
    -------
    type
        The class; a class that was given is returned as it is.

    Raises
    ------
    InputError
        It is neither.
    """
    if isinstance(given, type):
        check_law(given)
        return given
    if not callable(given):
        raise InputError(
            f"given {type(given).__name__}; allowed: a class of a contact law, or a function of h/sigma",
            key="law",
        )
    return _of_function(given)


def check_law(kind: object) -> None:
    """Refuse a class that is no contact law, or lacks a name or a source."""
    if not (isinstance(kind, type) and issubclass(kind, ContactLaw)):
        raise InputError("a contact law is a subclass of tribodyn.contact.ContactLaw", key="law")
    missing = [fact for fact in _FACTS if not isinstance(getattr(kind, fact, None), str)]
    if missing:
        raise InputError(f"the contact law {kind.__name__} lacks {', '.join(missing)}", key="law")


def _of_function(pressure: Callable[[FloatArray], Any]) -> type[ContactLaw]:
    called = getattr(pressure, "__name__", "own").strip("<>")

    @dataclass(frozen=True)
    class Own(ContactLaw):
        name: ClassVar[str] = called
        title: ClassVar[str] = f"function {called}"
        source: ClassVar[str] = "a user-defined function"
        validity: ClassVar[str] = "known to whoever wrote it"

        def stiffness_pressure(self, h_star: FloatArray) -> FloatArray:
            h_star = np.asarray(h_star, dtype=np.float64)
            found = np.asarray(pressure(h_star), dtype=np.float64)
            if found.shape != h_star.shape or not np.isfinite(found).all() or (found < 0.0).any():
                raise InputError(
                    f"{called} must return a finite pressure >= 0 for each separation it is given, here from "
                    f"{h_star.min():g} to {h_star.max():g}",
                    key="law",
                )
            return found

    return Own
