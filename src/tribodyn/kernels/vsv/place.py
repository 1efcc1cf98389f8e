"""Place of the trunnion in its bushing, whose clearance may follow the temperatures of a run."""

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.actions import NONE, held
from tribodyn.kernels.jit import entry
from tribodyn.kernels.joints.paper import fill_pose
from tribodyn.kernels.signals import evaluate
from tribodyn.kernels.vsv.data import TIME, VsvData, VsvMemory


@entry
def place(data: VsvData, t: float, y: FloatArray, omega: float, direction: float, memory: VsvMemory) -> None:
    """Fill the pose of the joint from the state ``y`` (8,), the speed ω_v [rad/s] and its direction."""
    pose, number = memory.joint.scratch.pose, int(data.mechanism.opening)
    fill_pose(y, omega, direction, pose)
    if number != NONE:
        within = held(memory.segment, TIME, t)
        pose.opening, pose.v_opening, _ = evaluate(data.actions.signals, number, t, within)
