"""Small vibrations about positions at rest: natural frequencies, damping ratios and mode shapes.

Drives and loads are held, bodies are at rest where all forces balance, and the linear equations of
:mod:`~tribodyn.mechanism.analyses.linearised` have solutions x exp(s t). An eigenvalue s has the natural
frequency |s|/2π and the damping ratio −Re s/|s|: a mode of ratio one decays without oscillation, and below
zero the position is unstable. Friction, loads against the motion and damping of impacts are left out: none of
them is linear in small motions.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.core.problem import Problem, Solution
from tribodyn.kernels.mechanism.data import N_STATES, ORIENTATION, VELOCITY
from tribodyn.mechanism.analyses.linearised import LinearEquations, Linearised
from tribodyn.mechanism.analyses.statics import Equilibria, require_no_film
from tribodyn.mechanism.assembly.assembly import Assembly
from tribodyn.mechanism.assembly.mechanism_problem import length_scale
from tribodyn.mechanism.assembly.output_values import rotations
from tribodyn.mechanism.assembly.pieces import modes_of_bodies
from tribodyn.mechanism.assembly.positions import DrivePath, held, walked
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.mechanism_variables import Observed

_FREE: Final = 1.0e-6  #: Eigenvalue over the largest undamped frequency that is zero.
_UNDAMPED: Final = 1.0e-9  #: Damping ratio that is zero.
#: Change of forces over all forces, for a displacement by one unit, that is no instability.
_LOOSE: Final = 1.0e-7
_REAL: Final = 1.0e-9  #: Imaginary part of an eigenvalue over its size that is zero.
_MOST: Final = 0.5  #: Share of the kinetic energy along the axis of a joint from which a motion slides in it.


def without_friction(case: MechanismCase) -> MechanismCase:
    """Return a case without friction in joints and loads against the motion; viscous friction stays."""
    joints = {
        name: joint
        if joint.clearance is None
        else joint.model_copy(
            update={"clearance": joint.clearance.model_copy(update={"friction_coefficient": 0.0})}
        )
        for name, joint in case.joints.items()
    }
    loads = {name: load for name, load in case.loads.items() if load.frame != "motion"}
    smooth = case.with_elements(lambda keys: keys.without_friction)
    return smooth.model_copy(update={"joints": joints, "loads": loads})


def require_freedom(assembly: Assembly) -> None:
    """Refuse a mechanism that cannot vibrate.

    Raises InputError if no degree of freedom is left, ideal joints cannot follow the drives, or an oil film
    carries a joint.
    """
    if assembly.freedoms == 0:
        words = (
            "nothing can vibrate: joints are ideal, and drives hold every degree of freedom that they leave; "
            "give a joint clearance or springs, or let a drive give a torque or force"
        )
        raise InputError(words, key="run.analysis")
    if assembly.strain:
        raise InputError(assembly.strain, key="run.analysis")
    require_no_film(assembly)


def find_rest(
    assembly: Assembly,
    problem: Problem,
    times: FloatArray,
    picture_times: FloatArray,
    progress: Callable[[float], None] | None,
) -> Solution:
    """Return positions at rest with drives and loads held as at some times.

    ``assembly``: the mechanism, without friction; ``times``: rising, from 0 [s], shape (n_t,);
    ``picture_times``, ``progress``: as for :func:`tribodyn.mechanism.assembly.positions.walked`.
    """
    path = DrivePath(times)
    at_rest = replace(problem, data=held(problem.data, times))
    return walked(at_rest, path, _Resting(assembly, path), picture_times, progress)


class _Resting(Equilibria):
    """Finds the position at rest for one time after the other."""

    MUST_REST = True

    def __init__(self, assembly: Assembly, path: DrivePath) -> None:
        super().__init__(assembly, path)
        self._loads.hold(path.times)
        self._real = Linearised(assembly, path.times) if assembly.model.yields else None

    def __call__(self, number: int) -> FloatArray:
        """Return the state at a time, see :class:`~.positions.States`."""
        if self._real is None:
            return np.asarray(self._in_the_middle(number).ravel())
        found = self._real.balanced(float(self._path.times[number]), super().__call__(number))
        if found is None:
            raise self._no_rest(number)
        return found

    def _require_balance(self, number: int) -> None:
        """Leave it to the search for rest, in which all freedoms take part."""


@dataclass(frozen=True)
class Modes:
    """Modes at one position, those of the lowest natural frequency first."""

    #: s [1/s]: of each complex pair the one above the real axis, shape (m,).
    eigenvalue: NDArray[np.complex128]
    shape: FloatArray  #: Of unit length over the displacements x, shape (f, m).


def modes_of(linear: LinearEquations) -> Modes:
    """Return the modes of linear equations; motions that nothing holds or damps have the eigenvalue zero."""
    from scipy.linalg import eig, eigvals

    f = linear.rest.size
    matrix = np.block([[np.zeros((f, f)), np.eye(f)], [-linear.stiffness, -linear.damping]])
    found: Any = eig(matrix)
    values: NDArray[np.complex128] = found[0]
    vectors = found[1][:f]
    size = np.abs(values)
    # Damping moves eigenvalues apart and leaves their products: the largest frequency is that without it.
    zero = size <= _FREE * np.sqrt(np.max(np.abs(eigvals(linear.stiffness)), initial=0.0))
    # Where bodies rest is known to 1e-8 of a unit, and so are the forces there.
    loose = _LOOSE * linear.turning_over(vectors / np.linalg.norm(vectors, axis=0))
    zero |= (values.imag == 0.0) & (size**2 <= loose)
    n_free = -(-int(np.sum(zero)) // 2)
    values.imag[np.abs(values.imag) <= _REAL * size] = 0.0
    kept = np.flatnonzero(~zero & (values.imag >= 0.0))
    kept = kept[np.lexsort((values[kept].real, size[kept]))]
    free = np.linalg.svd(linear.stiffness)[2][f - n_free :].T
    return Modes(np.append(np.zeros(n_free), values[kept]), np.hstack([free, _real(vectors[:, kept])]))


def _real(vectors: NDArray[np.complex128]) -> FloatArray:
    """Return vectors (f, m) at the instant at which their largest entry is at its largest, of unit length."""
    largest = np.take_along_axis(vectors, np.argmax(np.abs(vectors), axis=0)[None], axis=0)
    turned = (vectors * np.conj(largest)).real
    return np.asarray(turned / np.linalg.norm(turned, axis=0))


@dataclass(frozen=True)
class Vibrations:
    """Variables of a result on vibrations."""

    #: By their names in the result.
    columns: Mapping[str, FloatArray] = field(default_factory=dict)
    coordinates: Mapping[str, ArrayLike] = field(default_factory=dict)
    #: Which positions are unstable, and what nothing holds.
    warnings: Sequence[str] = ()
    notes: Sequence[str] = ()


def vibrations_of(assembly: Assembly, times: FloatArray, found: Observed, most: int) -> Vibrations:
    """Return frequencies, damping and shapes of modes at positions at rest.

    ``assembly``: the mechanism, without friction; ``times``: of its drives [s], shape (n_t,); ``found``: rows
    at these positions; ``most``: number of modes that are kept, those of the lowest natural frequency.
    """
    position, orientation = found.bodies["position"], found.bodies["orientation"]
    mechanism, n = Linearised(assembly, times), position.shape[1]
    eigenvalue = np.full((times.size, most), np.nan, dtype=complex)
    shape, share = np.full((times.size, most, n, 6), np.nan), np.full((times.size, most, n), np.nan)
    unstable, free = np.zeros(times.size), dict[str, None]()
    forces = np.linalg.norm(found.couplings["reaction_force"], axis=-1).max(axis=1)
    for k, t in enumerate(times.tolist()):
        state = np.zeros((n, N_STATES))
        state[:, :ORIENTATION], state[:, ORIENTATION:VELOCITY] = position[k], orientation[k]
        linear = mechanism.at(t, state.ravel())
        modes, others = _held(assembly, mechanism, linear.motions, float(forces[k]), modes_of(linear))
        free |= dict.fromkeys(others)
        kept = modes.eigenvalue[:most]
        if not kept.size:
            continue
        grows = modes.eigenvalue.real > _UNDAMPED * np.abs(modes.eigenvalue)
        unstable[k] = np.max(modes.eigenvalue.real[grows], initial=0.0)
        eigenvalue[k, : kept.size] = kept
        moved = linear.motions @ modes.shape[:, : kept.size]
        weighed = np.linalg.solve(mechanism.system.metric, moved).T.reshape(-1, n, 6)
        share[k, : kept.size] = np.sum(weighed**2, axis=2)
        parts, turn = moved.T.reshape(-1, n, 6), rotations(orientation[k])
        turned = [turn.apply(part[:, 3:]) for part in parts]
        shape[k, : kept.size] = np.concatenate([parts[:, :, :3], turned], axis=2)
    used = np.isfinite(eigenvalue).any(axis=0)
    notes = [*_free_motions(free), *_without_contact(assembly, found)]
    if not used.any():
        return Vibrations(notes=notes)
    size = np.abs(eigenvalue[:, used])
    ratio = -eigenvalue[:, used].real / np.where(size > 0.0, size, 1.0)
    shape, share = modes_of_bodies(assembly.model.pieces, orientation, shape[:, used], share[:, used])
    return Vibrations(
        {
            "natural_frequency": size / (2.0 * np.pi),
            "damping_ratio": np.where(np.abs(ratio) <= _UNDAMPED, 0.0, ratio),
            "mode_shape": shape[..., :3],
            "mode_rotation": shape[..., 3:],
            "mode_share": share,
        },
        {"mode": [str(number) for number in range(1, int(np.sum(used)) + 1)]},
        _instability(times, unstable),
        [*_moving(tuple(assembly.model.case.bodies), share[0]), *notes],
    )


def _held(
    assembly: Assembly, mechanism: Linearised, motions: FloatArray, force: float, modes: Modes
) -> tuple[Modes, list[str]]:
    """Return the modes that something holds, and the other motions in words.

    Nothing holds what has no stiffness, nor a slide along the axis of a joint within its end gaps: one of no
    more stiffness than the largest force in a joint gives, |s|² ≤ F way²/length.
    """
    model, joints = assembly.model, assembly.model.case.joints
    bodies, real = model.bodies, zip(model.clearances, model.real, strict=True)
    gaps = {name: number for name, number in real if joints[name].kind.FACES}
    slides = mechanism.system.now.couplings["RT"][list(gaps.values()), 2]
    moved, free = motions @ modes.shape, []
    weighed = np.linalg.solve(mechanism.system.metric, moved).T.reshape(-1, len(bodies), 6)
    ways = np.linalg.norm(moved.T.reshape(weighed.shape)[:, :, :3], axis=2).max(axis=1)
    bound = force * ways**2 / length_scale(assembly)
    kept = np.full(ways.size, True)
    for m, (parts, s) in enumerate(zip(weighed, modes.eigenvalue, strict=True)):
        along = np.sum((parts[:, :3] @ slides.T) ** 2, axis=0)
        slide = np.max(along, initial=0.0) > _MOST and abs(s) ** 2 <= bound[m]
        kept[m] = not slide and s != 0.0
        if not kept[m]:
            body = bodies[int(np.argmax(np.sum(parts**2, axis=1)))]
            ways_of = [name for way, name in zip(along.tolist(), gaps, strict=True) if way > _MOST]
            own = [name for name in ways_of if body in joints[name].between]
            free.append(" along ".join([body, *(own or ways_of)[:1]]))
    return Modes(modes.eigenvalue[kept], modes.shape[:, kept]), free


def _instability(times: FloatArray, rate: FloatArray) -> list[str]:
    """Return the unstable positions in words; ``rate`` is that of growth [1/s], shape (n_t,)."""
    if not np.any(rate > 0.0):
        return []
    number, fastest = int(np.sum(rate > 0.0)), int(np.argmax(rate))
    which = "the position" if times.size == 1 else f"{number} of {times.size} positions"
    return [
        f"{which} at rest {'is' if number == 1 else 'are'} unstable: a small displacement grows e-fold in "
        f"{1.0 / rate[fastest]:.3g} s at t = {times[fastest]:.4g} s; frequencies of modes whose damping "
        "ratio is below zero are rates of growth"
    ]


def _moving(bodies: Sequence[str], share: FloatArray) -> list[str]:
    """Return the body that moves most in each mode, in words; ``share`` of shape (m, n)."""
    if len(bodies) == 1:
        return []
    most = [(int(np.argmax(one)), float(np.max(one))) for one in share if np.isfinite(one).all()]
    named = (f"{mode} {bodies[body]} {100.0 * part:.0f} %" for mode, (body, part) in enumerate(most, start=1))
    return [f"largest share of a body in the kinetic energy of each mode at the start: {', '.join(named)}"]


def _free_motions(free: Mapping[str, None]) -> list[str]:
    """Return the motions that nothing holds, in words."""
    words = "free within the end gaps or without stiffness, and no modes"
    return [f"{words}: {', '.join(free)}"] if free else []


def _without_contact(assembly: Assembly, found: Observed) -> list[str]:
    """Return the joints with clearance whose surfaces do not touch at rest, in words."""
    forces = np.linalg.norm(found.couplings["reaction_force"], axis=-1)
    return [
        f"the surfaces of joint {assembly.model.joints[k]} do not touch at rest"
        f"{'' if np.all(forces[:, k] == 0.0) else ' at some positions'}: its shaft is free within the "
        "clearance"
        for k in assembly.model.real
        if np.any(forces[:, k] == 0.0)
    ]
