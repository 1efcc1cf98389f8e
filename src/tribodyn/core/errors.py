"""The ways in which tribodyn tells a user that something cannot go on."""

from __future__ import annotations

from tribodyn.core.quoting import brief


class TribodynError(Exception):
    """Base class of the errors that are shown to a user as one message."""


class InputError(TribodynError):
    """Something the user wrote is wrong; the message says what to change.

    Parameters
    ----------
    message
        What is wrong, what was given and what is allowed.
    key
        Dotted path of the offending entry (``joint.clearance``), if there is one.
    source
        File or option that held the entry, if known. Of both the text shows no more than
        :func:`~tribodyn.core.quoting.brief` does.
    """

    def __init__(self, message: str, *, key: str | None = None, source: str | None = None) -> None:
        self.key = key
        self.source = source
        self.reason = message
        where = ": ".join(brief(part) for part in (source, key) if part)
        super().__init__(f"{where}: {message}" if where else message)


class IntegrationFailure(TribodynError):
    """The time integration stopped before its end.

    Parameters
    ----------
    time
        Simulated time reached [s].
    reason
        Why the integrator stopped, in plain words.
    """

    def __init__(self, time: float, reason: str) -> None:
        self.time = time
        self.reason = reason
        super().__init__(f"stopped at t = {time:.6g} s: {reason}")


class Stopped(TribodynError):
    """The caller asked to stop before there was anything to return."""

    def __init__(self) -> None:
        super().__init__("stopped before anything was computed; nothing was saved")
