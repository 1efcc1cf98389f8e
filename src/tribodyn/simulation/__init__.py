"""From a case to a dataset: build its system, integrate it, gather what a user asks for."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, cast

from tribodyn.cases.case import Case
from tribodyn.cases.groups import Contact
from tribodyn.cases.loads import Controlled, OwnFunction, with_functions
from tribodyn.contact import OwnLaw, law_of_user
from tribodyn.core.environment import one_thread
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.core.problem import asked
from tribodyn.integrate import INTERRUPTED
from tribodyn.mechanisms.catalogue import MECHANISMS, AnyCase, case_of
from tribodyn.mechanisms.mechanism_protocol import MechanismDescriptor, ResultPart, SystemCase
from tribodyn.mechanisms.self_checks import YIELDED, may_yield
from tribodyn.simulation.checkpoint import is_of
from tribodyn.simulation.costs import Estimate, estimated
from tribodyn.simulation.session import Session
from tribodyn.simulation.wear import simulate_campaign, simulate_plain

if TYPE_CHECKING:
    import xarray as xr


def simulate(
    case: AnyCase,
    *,
    progress: Callable[[float], None] | None = None,
    stop: Callable[[], bool] | None = None,
    checkpoint: str | PathLike[str] | None = None,
    law: OwnLaw | None = None,
    drive: OwnFunction | None = None,
    loads: Mapping[str, OwnFunction] | None = None,
    controllers: Mapping[str, OwnFunction] | None = None,
) -> "xr.Dataset":
    """Simulate a case.

    Parameters
    ----------
    case
        A case, the name of a built-in one, the path of a case file, or a :class:`tribodyn.Mechanism`.
    progress
        Called with the simulated time [s] after accepted steps, by the solver ``mebdf`` some ten times a
        second; in a wear campaign with the cycles of wear behind.
    stop
        Asked whenever ``progress`` is called, and about once a second while the start is looked for and the
        result is checked; when true the run ends there.
    checkpoint
        File in which a wear campaign is kept after every jump, and from which it goes on if the file is
        there. It stays when the campaign is over. Other runs do not use it.
    law
        A contact law instead of the one that the case names: a subclass of
        :class:`tribodyn.contact.ContactLaw`, or a function that returns the pressure [Pa] at an array of
        separations h* = h/σ [1]. Damping follows from the case.
    drive
        A function of the time ``t`` [s] instead of the drive of the case: the crank angle of the vane
        mechanism [rad], or the speed of a shaft [rad/s].
    loads
        Functions by the names of the loads that they take the place of: ``force_x``, ``force_y``,
        ``force_z`` and ``moment`` on the vane, ``force_x``, ``force_y``, ``moment_x`` and ``moment_y`` on a
        shaft, in N and N m; in a user-defined mechanism the names of its loads. Their arguments are named
        ``t`` and ``theta_v`` or ``theta_a``, of a shaft or of the joint that a load follows ``angle``. They
        are tabulated; the case in the result holds the tables.
    controllers
        Functions by the names of the controllers of a user-defined mechanism. They are evaluated at sampling
        times alone and return a torque [N m] or force [N]. Their arguments are ``t``, ``angle`` and
        ``speed`` or ``position`` and ``velocity`` of the joint, and names of outputs, SI units. The case in
        the result does not hold them.

    Returns
    -------
    xarray.Dataset
        See the manual's page on results. A run that stopped before its end says why in the attribute
        ``failure`` and holds what was computed.

    Raises
    ------
    InputError
        If the case asks for something that cannot be.
    Stopped
        If ``stop`` was true before anything was computed.

    Examples
    --------
    >>> import tribodyn as td
    >>> result = td.simulate(td.load_case("slider-crank", {"run.cycles": 1}))
    >>> result.tribodyn.summary["status"], result.sizes["joint"]
    ('complete', 4)
    """
    given, path = case_of(case), None if checkpoint is None else Path(checkpoint)

    def session(case: Case, *notes: str) -> Session:
        own = with_functions(with_controllers(case, controllers or {}), drive, loads)
        chosen = own if law is None else _with_law(own, law)
        return replace(_session(chosen), progress=progress, stop=stop, notes=notes)

    with asked(stop), one_thread():
        return _carried(given, session, path)


def _carried(case: Case, session: Callable[..., Session], checkpoint: Path | None) -> "xr.Dataset":
    """Simulate a case, once more with elastic bodies where asperities alone do not carry."""
    if checkpoint is not None and checkpoint.exists():
        softer = case.yielding()
        again = None if softer is None else session(softer, YIELDED)
        if again is not None and is_of(checkpoint, again.case.to_toml()):
            return _simulated(again, checkpoint)
    found = _simulated(session(case), checkpoint)
    softer = case.yielding() if may_yield(found.attrs["failure"]) else None
    if softer is None:
        return found
    if checkpoint is not None:
        checkpoint.unlink(missing_ok=True)
    try:
        return _simulated(session(softer, YIELDED), checkpoint)
    except InputError:  # under more than their hardness bodies have no place to start from
        return found


def with_controllers(case: Case, functions: Mapping[str, OwnFunction]) -> Case:
    """Return a case with functions of controllers; refuse those that it has no place for, or lacks."""
    if isinstance(case, Controlled):
        return case.with_controllers(functions)
    if functions:
        raise InputError(f'a case of the kind "{case.kind()}" has no controllers', key="controllers")
    return case


def _with_law(case: Case, law: OwnLaw) -> Case:
    """Return a case with a law that no list holds."""
    contact = getattr(case, "contact", None)
    if not isinstance(contact, Contact):
        raise InputError(f'a case of the kind "{case.kind()}" has no table [contact]', key="law")
    return case.model_copy(update={"contact": contact.with_own(law_of_user(law))})


def _simulated(session: Session, checkpoint: Path | None) -> "xr.Dataset":
    if not session.mechanism.of_cycle:
        return session.dataset(session.integrated(session.case.duration), ResultPart())
    campaign = cast("Case", session.case).campaign_cycles
    return simulate_campaign(session, checkpoint) if campaign else simulate_plain(session)


def _mechanism(case: Case) -> MechanismDescriptor:
    kind: str = getattr(case, "case", "")
    if kind not in MECHANISMS:
        raise InputError(f"given {kind!r}; allowed: {', '.join(MECHANISMS)}", key="case")
    return MECHANISMS[kind]


def _session(case: Case) -> Session:
    mechanism = _mechanism(case)
    known = cast(SystemCase, case)
    return Session(known, mechanism, mechanism.system(known))


def first_steps(case: Case) -> str:
    """Take the first steps of a run, which load all that it needs; return why they failed, if they did."""
    return _first_steps(_session(case))


def _first_steps(session: Session) -> str:
    """Take the first steps of a run; return why they failed, if they did."""
    short = replace(session, stop=lambda: True)
    with one_thread():
        run = short.integrated(short.case.duration)
        return str(short.dataset(run, ResultPart()).attrs["failure"])


def estimate(case: AnyCase) -> Estimate:
    """Return the memory and the processor time that a run of a case is expected to take.

    Parameters
    ----------
    case
        As for :func:`simulate`. Nothing is built; see the manual's page on case files for the
        accuracy.
    """
    found = case_of(case)
    return estimated(_mechanism(found).workload(cast(SystemCase, found)))


def check(case: AnyCase, *, deep: bool = False) -> Sequence[str]:
    """Find out without running it what a run of a case would refuse.

    Parameters
    ----------
    case
        As for :func:`simulate`. Its mechanism is put together, with the tables of its contact laws.
    deep
        Whether its start is found and the first step taken, too.

    Returns
    -------
    sequence of str
        What a user should know of case and mechanism before it runs, one sentence each; also that the run is
        estimated to take more than 2 GB of memory or an hour.

    Raises
    ------
    InputError
        What the run would raise.
    TribodynError
        If the run would fail at its first step.

    Examples
    --------
    >>> import tribodyn as td
    >>> td.check("slider-crank")[-1]
    'degrees of freedom: 0 with ideal joints (fully driven); clearances free 2 more'
    """
    case = case_of(case)
    said = case.remarks()
    session = _session(case)
    with one_thread():
        remarks = (*said.warnings, *said.notes, *estimate(case).warnings, *session.system.check())
    if not deep:
        return remarks
    failure = _first_steps(session)
    if failure not in ("", INTERRUPTED):
        raise TribodynError(f"a run fails at its first step: {failure}")
    return remarks


__all__ = ["check", "estimate", "first_steps", "simulate"]
