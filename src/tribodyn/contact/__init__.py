"""Contact laws of rough surfaces, and their tabulation."""

import warnings
from collections.abc import Iterator, Mapping
from dataclasses import fields
from importlib import import_module
from importlib.metadata import entry_points
from typing import Any, Final, Protocol, cast

from tribodyn.contact.asperities import SEPARATIONS
from tribodyn.contact.bulk import Liner, lined
from tribodyn.contact.contact_law import ContactLaw
from tribodyn.contact.damping_factors import DAMPING_FACTORS
from tribodyn.contact.elastic_plastic import KogutEtsion
from tribodyn.contact.parameter import parameters_of
from tribodyn.contact.rsdc import RSDC
from tribodyn.contact.surface_pair import SurfacePair
from tribodyn.contact.table import tabulate
from tribodyn.contact.user_law import OwnLaw, check_law, law_of_user
from tribodyn.core.errors import InputError

#: Every law, one line each: its file and its class.
_MEMBERS = (
    "elastic_plastic:KogutEtsion",
    "rsdc:RSDC",
    "greenwood_tripp:GreenwoodWilliamson",
    "greenwood_tripp:GreenwoodTripp",
    "elastic_plastic:ChangEtsionBogy",
    "elastic_plastic:JacksonGreen",
    "linear:LinearContact",
)


def _member(line: str) -> type[ContactLaw]:
    module, _, name = line.partition(":")
    return cast("type[ContactLaw]", getattr(import_module(f"{__name__}.{module}"), name))


def _of_packages() -> Iterator[type[ContactLaw]]:
    """Yield the laws that installed packages have under the entry points ``tribodyn.laws``.

    One that cannot be imported, is no law or takes the name of another is left out with a warning: it must
    not keep a user from the others.
    """
    taken = {kind.name for kind in OURS}
    parameters = {name: described for kind in OURS for name, described in parameters_of(kind)}
    for entry in entry_points(group="tribodyn.laws"):
        try:
            kind = entry.load()
            check_law(kind)
            if kind.name in taken:
                raise ValueError(f"there is a law {kind.name!r} already")
            for name, described in parameters_of(kind):
                if parameters.setdefault(name, described) != described:
                    raise ValueError(f"another law has another parameter {name!r}")
        except Exception as error:
            warnings.warn(f"the contact law {entry.value} was left out: {error}", stacklevel=2)
            continue
        taken.add(kind.name)
        yield kind


OURS: Final = tuple(map(_member, _MEMBERS))  #: Laws of this package: two whose fields are equal are equal.
#: All contact laws by name: our own, and those of installed packages.
LAWS: dict[str, type[ContactLaw]] = {kind.name: kind for kind in (*OURS, *_of_packages())}


class HasSurfacePair(Protocol):
    """Anything that knows its surfaces, such as a case."""

    @property
    def surface_pair(self) -> SurfacePair:
        """The surfaces in contact."""


def law(name: str, surfaces: SurfacePair | HasSurfacePair, **options: Any) -> ContactLaw:
    """Return the contact law called ``name`` for a pair of surfaces, or for those of a case.

    Parameters
    ----------
    name
        One of ``LAWS``.
    surfaces
        A pair of surfaces, or a case that has one.
    options
        Parameters of laws, such as ``damping_factor`` and ``restitution`` [1]. Those that only other laws
        have are ignored, so that a case can pass all it has.

    Returns
    -------
    ContactLaw
        Its functions take separations h* [1] of any shape and return pressures [Pa] of that shape.

    Raises
    ------
    InputError
        There is no such law or option, or a value is out of its range.

    Examples
    --------
    >>> import tribodyn as td
    >>> from tribodyn.contact import law
    >>> f"{law('rsdc', td.load_case('slider-crank')).pressure(0.0):.4g} Pa"
    '5.182e+08 Pa'
    """
    if name not in LAWS:
        raise InputError(f"no contact law {name!r}; there is {', '.join(LAWS)}", key="contact.law")
    pair = surfaces if isinstance(surfaces, SurfacePair) else surfaces.surface_pair
    unknown = options.keys() - set().union(*map(_options_of, LAWS.values()))
    if unknown:
        raise InputError(f"no contact law has the option {', '.join(sorted(unknown))}", key="contact")
    return made(LAWS[name], pair, options)


def made(kind: type[ContactLaw], pair: SurfacePair, options: Mapping[str, Any]) -> ContactLaw:
    """Return a law of a kind for a pair of surfaces, with those of the options that it has.

    Parameters
    ----------
    kind
        Class of the law.
    pair
        The surfaces.
    options
        Parameters of laws by name; those that this law does not have are ignored.

    Returns
    -------
    ContactLaw
        The law.

    Raises
    ------
    InputError
        The value of an option is out of its range.
    """
    own = _options_of(kind)
    return kind(pair, **{key: value for key, value in options.items() if key in own})


def options_of_others(name: str) -> set[str]:
    """Return the names of the options that a law does not have, and another law has."""
    others = set().union(*map(_options_of, LAWS.values()))
    return others - _options_of(LAWS[name])


def _options_of(kind: type[ContactLaw]) -> set[str]:
    return {entry.name for entry in fields(kind)} - {"pair"}


__all__ = [
    "DAMPING_FACTORS",
    "LAWS",
    "OURS",
    "RSDC",
    "SEPARATIONS",
    "ContactLaw",
    "KogutEtsion",
    "Liner",
    "OwnLaw",
    "SurfacePair",
    "law",
    "law_of_user",
    "lined",
    "made",
    "tabulate",
]
