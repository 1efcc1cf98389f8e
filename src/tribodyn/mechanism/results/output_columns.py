"""Variables of the outputs of a mechanism in results."""

import math
from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.joints.clearances import Place
from tribodyn.joints.shapes import Mesh
from tribodyn.kernels import dense
from tribodyn.mechanism.analyses.ideal_motion import IdealMechanism
from tribodyn.mechanism.analyses.kinematics import of_drives
from tribodyn.mechanism.analyses.superposition import CAUSES, JointReaction, missing, responses
from tribodyn.mechanism.assembly.assembly import Assembly
from tribodyn.mechanism.assembly.output_values import Output
from tribodyn.mechanism.assembly.parts_by_number import model_of
from tribodyn.mechanism.joints.elastic import flexibility
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.model.drives_and_loads import GIVEN
from tribodyn.mechanism.results.derived_columns import coordinate
from tribodyn.mechanisms.output_keys import Instant, instant_coordinates, instants_of
from tribodyn.mechanisms.output_numbers import errors_at, shaft_displacements


def kinematic_columns(
    assembly: Assembly, outputs: Sequence[Output], times: FloatArray, couplings: Mapping[str, FloatArray]
) -> dict[str, FloatArray]:
    """Return velocity ratios of outputs, and their errors by superposition of the joints with clearance.

    ``assembly``: the mechanism of ideal joints; ``outputs``: at least one; ``times``: rising, from 0 [s],
    shape (n_t,); ``couplings``: what is observed of joints, see :class:`~.variables.Observed`.
    """
    case = assembly.model.case
    shape = (times.size, len(outputs), len(case.joints), len(CAUSES))
    estimate, real = np.zeros(shape), {}
    for name, clearance in model_of(case).clearances.items():
        k, keys = assembly.model.joints.index(name), case.joints[name].clearance
        known = clearance.film is None and not isinstance(clearance.shape, Mesh)
        estimate[:, :, k] = 0.0 if known else np.nan
        if known and keys is not None:
            force, moment = couplings["reaction_force"][:, k], couplings["reaction_moment"][:, k]
            spin = couplings["relative_rate"][:, k, 2]
            reaction = JointReaction(clearance, keys.friction_coefficient, force, moment, spin)
            real[k] = reaction.displacements()
    for name in [name for name, joint in case.joints.items() if joint.kind.HELD]:
        k = assembly.model.joints.index(name)
        reactions = np.hstack([couplings["reaction_force"][:, k], couplings["reaction_moment"][:, k]])
        real[k] = np.zeros((times.size, len(CAUSES), 6))
        real[k][:, CAUSES.index("bending")] = -dense.product(reactions, flexibility(case.joints[name]))
    mechanism = IdealMechanism(assembly)
    asked = [of_drives(mechanism), *([missing(mechanism, real)] if real else [])]
    ratios, *errors = responses(mechanism, outputs, times, *asked)
    for found in errors:
        estimate[:, :, list(real)] = found.reshape(times.size, len(outputs), len(real), -1)
    estimate[:, ~np.array([output.has_displacement for output in outputs])] = np.nan
    return {"output_ratio": ratios, "error_estimate": estimate}


def instant_errors(
    case: MechanismCase, times: FloatArray, error: FloatArray, couplings: Mapping[str, FloatArray]
) -> dict[str, FloatArray]:
    """Return errors at angles and positions of joints, and times, as :func:`.errors_at`; none without.

    ``times``: rising [s], shape (n_t,); ``error``: of its outputs, shape (n_t, n_outputs); ``couplings``:
    what is observed of joints, see :class:`~.variables.Observed`.
    """
    instants = instants_of(case.outputs)
    if not instants:
        return {}

    def drive(instant: Instant) -> FloatArray:
        joint = case.joint_of(case.outputs[instant.output].at)
        assert joint is not None
        return coordinate(case, couplings, joint, f"{instant.kind}s")

    period = math.inf if case.period is None else case.period
    return errors_at(instants, times, dict(zip(case.outputs, error.T, strict=True)), drive, period)


def output_coordinates(case: MechanismCase, outputs: Sequence[Output]) -> dict[str, list[str]]:
    """Return the names of outputs with their units, of a kinematic analysis those of its drives."""
    if not outputs:
        return {}
    drives = [name for name, keys in case.drives.items() if GIVEN[keys.gives][1] < 2]
    return {
        "output": [output.name for output in outputs],
        "output_unit": [output.unit for output in outputs],
        **instant_coordinates(case.outputs),
        **({"drive": drives, "cause": list(CAUSES)} if case.run.analysis == "kinematic" else {}),
    }


_LEAD: Final = 120  #: Positions in a cycle through which the ideal mechanism is led to the first one.


def error_growth(
    assembly: Assembly,
    outputs: Sequence[Output],
    places: Sequence[Place],
    times: FloatArray,
    pressure: FloatArray,
    depth: FloatArray,
) -> FloatArray:
    """Return the growth of the errors of outputs by the wear of their joints, shape (n_t, n_outputs).

    It is in their units; NaN for velocities, for lengths of vectors, and from where ideal joints do not
    close. ``assembly``: its joints not worn; ``outputs``: at least one; ``places``: of the surfaces of joints
    with clearance, counted among these; ``times``: rising [s], shape (n_t,); ``pressure``, and ``depth`` worn
    off, at the nodes [Pa], shape (n_t, n_nodes), and [m], shape (n_nodes,).
    """
    model, moved = assembly.model, {}
    for number, name in enumerate(model.clearances):
        own = [place for place in places if place.joint == number]
        surfaces = [place.surface for place in own]
        nodes = np.concatenate([np.arange(place.nodes.start, place.nodes.stop) for place in own])
        area = np.concatenate([surface.area for surface in surfaces])
        position = np.concatenate([surface.position for surface in surfaces])
        normal = np.concatenate([surface.normal for surface in surfaces])
        followed = shaft_displacements(position, normal, area * pressure[:, nodes], depth[nodes])
        moved[model.joints.index(name)] = followed[:, None]
    lead = np.linspace(0.0, times[0], _LEAD)[:-1] if times[0] > 0.0 else np.empty(0)
    still = {k: np.concatenate([np.zeros((lead.size, 1, 6)), own]) for k, own in moved.items()}
    mechanism = IdealMechanism(assembly)
    (found,) = responses(mechanism, outputs, np.concatenate([lead, times]), missing(mechanism, still))
    growth = found[lead.size :].sum(axis=2)
    growth[:, ~np.array([output.has_displacement for output in outputs])] = np.nan
    return np.asarray(growth)
