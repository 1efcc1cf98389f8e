"""The vane mechanism in the multibody code Exudyn: rigid bodies, joints, and one of two contacts.

- ``point``: Exudyn's own compiled contact, a sphere of radius r_j in a hollow one of radius r_b at each end
  of the bushing, with stiffness and damping ratio of ``joint.contact = "point-lankarani-nikravesh"``.
- ``surface``: the rough contact of this project's compiled kernel, called by a Python user function of a
  connector, as a user would couple it in.

Drive, loads and thrust collar are the same as ours. The drive is a symbolic function, evaluated in compiled
code. What changes sign with direction, the air force and the collar's load follow the state at the beginning
of a step, in one short Python function a step. Rotations are finite in Exudyn, linear in the tilt in ours.
"""

from __future__ import annotations

import math
from typing import Any, Final

import exudyn as exu
import exudyn.itemInterface as items
import numpy as np
from exudyn.advancedUtilities import CreateSymbolicUserFunction
from numpy.typing import NDArray

from benchmarks.vane.vsv_case import constants
from tribodyn.core.problem import Problem
from tribodyn.joints.bushing import pose_at
from tribodyn.joints.point_contact import point_damping
from tribodyn.kernels.joints.bushing import update_entry_velocity, wrench
from tribodyn.kernels.joints.pose import N_WRENCH
from tribodyn.kernels.vsv import data as layout
from tribodyn.kernels.vsv.closure import sinusoid
from tribodyn.kernels.vsv.motion import fill_motion
from tribodyn.papers.cheng_2022.reduced.case import VsvCase
from tribodyn.papers.cheng_2022.reduced.parameters import Vsv

FloatArray = NDArray[np.float64]

CONTACTS: Final = ("point", "surface")
SPIN: Final = 1e-6  #: Inertia of the drag link about its own axis, which nothing turns [kg m²].
#: Of the generalised-α method: at large steps the contact rings less than with Exudyn's default of 0.9.
SPECTRAL_RADIUS: Final = 0.6


class ExudynModel:
    """The mechanism, ready to be integrated once.

    Parameters
    ----------
    case, vsv, problem
        The case, its mechanism and its initial value problem, which gives the start.
    contact
        One of :data:`CONTACTS`.
    """

    def __init__(self, case: VsvCase, vsv: Vsv, problem: Problem, contact: str) -> None:
        self.case, self.vsv, self.surface = case, vsv, contact == "surface"
        self.data, self.memory = constants(problem.data), problem.memory.joint
        self.motion = np.zeros((layout.N_ROWS, layout.N_COLUMNS))
        mechanism = problem.data.mechanism
        fill_motion(mechanism, sinusoid(mechanism, 0.0), problem.y0, self.motion)
        self.container = exu.SystemContainer()
        self.mbs = self.container.AddSystem()
        self.ground = self.mbs.AddObject(items.ObjectGround())
        self.height = self.data.l_3 - self.data.half_length
        self._crank()
        self._rod_and_ring()
        self._vane(problem.y0)
        self._joints()
        self._loads()
        self._surface() if self.surface else self._points()
        self.mbs.SetPreStepUserFunction(self._before_step)

    def _value(self, row: int) -> float:
        return float(self.motion[row, layout.VALUE])

    def _point(self, row: int) -> FloatArray:
        return np.array(self.motion[row : row + 3, layout.VALUE])

    def _body(self, mass: float, inertia: tuple[float, ...], place: Any, angles: Any) -> tuple[int, int]:
        """Add a rigid body with its mass centre at a place; return its node and its number."""
        node = self.mbs.AddNode(items.NodeRigidBodyRxyz(referenceCoordinates=[*place, *angles]))
        inertias = [*inertia, 0.0, 0.0, 0.0]
        body = items.ObjectRigidBody(mass=mass, inertia=inertias, nodeNumber=node)
        return node, self.mbs.AddObject(body)

    def _marker(self, body: int, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> int:
        place = exu.HT(translation=[x, y, z])
        return int(self.mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=body, localHT=place)))

    def _crank(self) -> None:
        """Add the driven crank: its coordinate turns it about −Y, the Z axis of a turned frame."""
        d, mbs = self.data, self.mbs
        node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.0], initialCoordinates=[d.start_angle]))
        self.crank = mbs.AddObject(
            items.ObjectRotationalMass1D(
                inertia=d.crank_inertia + d.m_1 * (0.5 * d.l_1) ** 2,
                nodeNumber=node,
                referencePosition=[d.pivot_x, d.l_4, d.pivot_z],
                referenceRotation=np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]),
            )
        )
        coordinates = [
            mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=number, coordinate=0))
            for number in (mbs.AddNode(items.NodePointGround()), node)
        ]
        driven = mbs.AddObject(items.ObjectConnectorCoordinate(markerNumbers=coordinates))
        start, swing, nu = d.start_angle, d.speed_amplitude / d.angular_frequency, d.angular_frequency

        def angle(mbs: Any, t: Any, item: Any, offset: Any) -> Any:
            return start + swing * (1.0 - exu.symbolic.cos(nu * t))

        # The item does not own the expression: it lives as long as this object.
        self._angle = CreateSymbolicUserFunction(mbs, angle, "offsetUserFunction", driven)
        mbs.SetObjectParameter(driven, "offsetUserFunction", self._angle)

    def _rod_and_ring(self) -> None:
        """Add the drag link, along its own Z axis, and the ring, whose frame θ_b turns about −Y."""
        d, n = self.data, self._point(layout.N_X)
        along = (math.atan2(-n[1], n[2]), math.asin(n[0]), 0.0)
        across = d.link_inertia
        _, self.link = self._body(d.m_2, (across, across, SPIN), self._point(layout.O2_X), along)
        turned = (0.0, -self._value(layout.THETA_B), 0.0)
        _, self.ring = self._body(d.m_3, (d.ring_inertia,) * 3, self._point(layout.O3_X), turned)

    def _vane(self, y0: FloatArray) -> None:
        """Add the vane with its trunnion; O_j is at (0, 0, vane_arm) of its frame."""
        d, across = self.data, self.vsv.vane_inertia
        axis = np.array([-math.tan(y0[3]), -math.tan(y0[2]), 1.0])
        axis /= np.linalg.norm(axis)
        angles = (math.atan2(-axis[1], axis[2]), math.asin(axis[0]), self._value(layout.THETA_V))
        centre = np.array([y0[0], y0[1], self.height]) - d.vane_arm * axis
        inertia = (across, across, self.vsv.inertias.J_vz)
        self.vane_node, self.vane = self._body(d.m_v, inertia, centre, angles)
        self.reference = np.array([*centre, *angles])

    def _joints(self) -> None:
        d, half = self.data, 0.5 * self.data.l_2
        arm, middle = 0.5 * d.l_3 * math.cos(0.5 * self.vsv.lengths.phi), 0.5 * self.vsv.lengths.phi
        x, z = arm * math.sin(middle), arm * math.cos(middle)  # mass centre of the ring from its axis
        s_2 = (d.l_3 * math.sin(self.vsv.lengths.phi) - x, 0.0, d.l_3 * math.cos(self.vsv.lengths.phi) - z)
        ring_axis = self._marker(self.ring, -x, 0.0, -z)
        lever = self._marker(self.vane, d.l_4, 0.0, d.vane_arm + d.half_length)
        self.bushing = self._marker(self.ground, z=self.height)
        self.trunnion = self._marker(self.vane, z=d.vane_arm)
        for markers in (
            (self._marker(self.crank, 0.0, d.l_1), self._marker(self.link, z=-half)),
            (self._marker(self.link, z=half), self._marker(self.ring, *s_2)),
        ):
            self.mbs.AddObject(items.ObjectJointSpherical(markerNumbers=list(markers)))
        self._free((self._marker(self.ground, y=d.l_4), ring_axis), [1, 0, 1, 1, 0, 1])
        self._free((ring_axis, lever), [1, 1, 0, 0, 0, 0])  # slides along the radial pin, Z of the ring
        self.collar = self._free((self.bushing, self.trunnion), [0, 0, 1, 0, 0, 0])

    def _free(self, markers: tuple[int, int], constrained: list[int]) -> int:
        joint = items.ObjectJointGeneric(markerNumbers=list(markers), constrainedAxes=constrained)
        return int(self.mbs.AddObject(joint))

    def _loads(self) -> None:
        """Add weights and the loads on the vane; as in ours its weight has no moment about O_j."""
        mbs, d = self.mbs, self.data
        for marker, weight in (
            (self.trunnion, -d.vane_weight),
            (self._marker(self.link), d.weight[layout.O2_Z]),
            (self._marker(self.ring), d.weight[layout.O3_Z]),
        ):
            mbs.AddLoad(items.LoadForceVector(markerNumber=marker, loadVector=[0.0, 0.0, weight]))
        centre = self._marker(self.vane)
        self.air = mbs.AddLoad(items.LoadForceVector(markerNumber=centre, loadVector=[0.0] * 3))
        self.moment = mbs.AddLoad(items.LoadTorqueVector(markerNumber=centre, loadVector=[0.0] * 3))

    def _before_step(self, mbs: Any, t: float) -> bool:
        """Set what follows the state at the beginning of a step, and the memory of a rough contact."""
        d = self.data
        q = mbs.GetNodeOutput(self.vane_node, exu.OutputVariableType.Coordinates) + self.reference
        phi_x, phi_y = q[3], -q[4]
        direction = 1.0 if math.sin(d.angular_frequency * t) >= 0.0 else -1.0
        air_x = d.air_force_x * math.tanh((q[5] - d.switch_angle) / d.switch_width)
        pull = mbs.GetObjectOutput(self.collar, exu.OutputVariableType.ForceLocal)[2]
        moment = d.collar_radius * max(0.0, -pull)
        tilt = math.hypot(phi_x, phi_y, 1e-6)
        twist = -direction * (d.air_moment + self.vsv.joint.friction.coefficient * moment)
        torque = [-moment * phi_x / tilt, moment * phi_y / tilt, twist]
        mbs.SetLoadParameter(self.air, "loadVector", [air_x, d.air_force_y, 0.0])
        mbs.SetLoadParameter(self.moment, "loadVector", torque)
        if self.surface:
            self._remember(q)
        return True

    def _remember(self, q: FloatArray) -> None:
        """Let nodes enter and leave contact."""
        kind, place = exu.OutputVariableType, [0.0, 0.0, self.data.vane_arm]
        offset = self.mbs.GetObjectOutputBody(self.vane, kind.Position, place)
        velocity = self.mbs.GetObjectOutputBody(self.vane, kind.Velocity, place)
        turning = self.mbs.GetNodeOutput(self.vane_node, kind.AngularVelocity)
        y = np.empty(8)
        fill_state(offset, q[3:], velocity, turning, y)
        update_entry_velocity(self.data.joint, self.memory, pose_at(y), 0.0)

    def _surface(self) -> None:
        """Connect trunnion and bushing by the rough contact; the connector takes forces on the bushing."""
        joint, memory, y, out = self.data.joint, self.memory, np.zeros(8), np.zeros(N_WRENCH)

        def force(mbs: Any, t: float, item: int, *motion: Any) -> list[float]:
            fill_state(*motion[:4], y)
            wrench(joint, memory, pose_at(y, omega=motion[3][2]), out)
            return [-component for component in out]

        self.mbs.AddObject(
            items.ObjectConnectorRigidBodySpringDamper(
                markerNumbers=[self.bushing, self.trunnion],
                useIntrinsicFormulation=False,
                springForceTorqueUserFunction=force,
            )
        )

    def _points(self) -> None:
        """Add a sphere in a hollow sphere at each end, F = (4/3) E √(r_j r_b/c) δ^1.5 for both together."""
        joint, pair = self.vsv.joint, self.case.surface_pair
        size = joint.geometry
        radius = size.radius * size.bore_radius / size.clearance
        damping = point_damping(self.case.contact.law_of(pair))
        for z in (-self.data.half_length, self.data.half_length):
            data = items.NodeGenericData(initialCoordinates=[0.0] * 4, numberOfDataCoordinates=4)
            trunnion = self._marker(self.vane, z=self.data.vane_arm + z)
            contact = items.ObjectContactSphereSphere(
                markerNumbers=[trunnion, self._marker(self.ground, z=self.height + z)],
                nodeNumber=self.mbs.AddNode(data),
                spheresRadii=[size.radius, size.bore_radius],
                isHollowSphere1=True,
                dynamicFriction=joint.friction.coefficient,
                frictionProportionalZone=joint.friction.slip_velocity,
                contactStiffness=0.5 * 4.0 / 3.0 * pair.composite_modulus * math.sqrt(radius),
                contactStiffnessExponent=1.5,
                restitutionCoefficient=1.0 - damping / 1.5,  # its damping ratio is 3/2 (1 − e)
                minimumImpactVelocity=joint.entry.minimum_velocity,
                impactModel=1,
            )
            self.mbs.AddObject(contact)

    def solve(self, duration: float, step: float, every: float) -> tuple[FloatArray, FloatArray]:
        """Integrate; return times [s] and vane angles [rad], each of shape (n,).

        Exudyn shortens steps where Newton's iteration fails and lengthens them again up to ``step``.
        """
        kind = exu.OutputVariableType.Coordinates
        sensor = items.SensorNode(nodeNumber=self.vane_node, storeInternal=True, outputVariableType=kind)
        number = self.mbs.AddSensor(sensor)
        self.mbs.Assemble()
        settings = exu.SimulationSettings()
        settings.timeIntegration.numberOfSteps = round(duration / step)
        settings.timeIntegration.endTime = duration
        settings.timeIntegration.generalizedAlpha.spectralRadius = SPECTRAL_RADIUS
        # With the steps that its contacts recommend Exudyn takes three times as many.
        settings.timeIntegration.discontinuous.useRecommendedStepSize = False
        settings.timeIntegration.verboseMode = 0
        settings.solution.file.write = False
        settings.solution.sensors.writePeriod = every
        self.mbs.SolveDynamic(settings)
        rows = self.mbs.GetSensorStoredData(number)
        return rows[:, 0], rows[:, 6] + self.reference[5]


def fill_state(offset: Any, angles: Any, velocity: Any, turning: Any, y: FloatArray) -> None:
    """Fill the eight states (8,) from the motion of O_j; the axis is (sin b, −sin a cos b, cos a cos b)."""
    a, b = angles[0], angles[1]
    d_x, d_y, d_z = math.sin(b), -math.sin(a) * math.cos(b), math.cos(a) * math.cos(b)
    w_x, w_y, w_z = turning[0], turning[1], turning[2]
    v_x, v_y, v_z = w_y * d_z - w_z * d_y, w_z * d_x - w_x * d_z, w_x * d_y - w_y * d_x
    tan_x, tan_y = -d_y / d_z, -d_x / d_z
    y[0], y[1], y[4], y[5] = offset[0], offset[1], velocity[0], velocity[1]
    y[2], y[3] = math.atan(tan_x), math.atan(tan_y)
    y[6] = (d_y * v_z / d_z - v_y) / d_z / (1.0 + tan_x**2)
    y[7] = (d_x * v_z / d_z - v_x) / d_z / (1.0 + tan_y**2)
