"""The memory of entry velocities: who enters, what is kept, when it is forgotten, and that nothing jumps."""

import numpy as np
import pytest

from tribodyn.joints.bushing import joint_wrench, new_memory, pose_at
from tribodyn.kernels.joints.bushing import pressure_field, update_entry_velocity
from tribodyn.kernels.joints.pressure import node_pressure

V_MIN = 1e-3
ONSET = 4.0


def at(depth, roughness, v_x=0.0):
    """Return an untilted trunnion whose smallest gap, at θ = 180°, is ``depth`` σ."""
    y = np.zeros(8)
    y[0], y[4] = 20e-6 - depth * roughness, v_x
    return y


def accept(data, memory, y, at_start=0.0):
    """End an accepted step and return the entry velocities."""
    update_entry_velocity(data, memory, pose_at(y), at_start)
    return memory.entry_velocity


def total(joint, h_star, approach, entry):
    """Return (P_k, P_c) of one node."""
    return node_pressure(joint.table, joint.roughness, V_MIN, 1.0, h_star * joint.roughness, approach, entry)[
        :2
    ]


@pytest.mark.parametrize("approach", [1e-2, 2e-3, 1e-4, -1e-4])
@pytest.mark.parametrize("entry", [0.0, V_MIN, 1e-2])
def test_no_jump_at_the_onset(make_joint, approach, entry):
    joint = make_joint()
    rigid, above = total(joint, ONSET + 1e-9, approach, entry)
    _, below = total(joint, ONSET - 1e-9, approach, entry)
    assert above == rigid
    assert below == pytest.approx(above, rel=1e-8)
    # The smoothstep begins with zero slope: a thousandth of σ further in there is still next to nothing.
    rigid, inside = total(joint, ONSET - 1e-3, approach, entry)
    damping = abs(inside - rigid)
    whole = abs(total(joint, ONSET - 1.0, approach, entry)[1] - total(joint, ONSET - 1.0, approach, entry)[0])
    assert damping < 1e-5 * whole


@pytest.mark.parametrize("speed", [5e-3, 2e-4, -5e-3])
def test_no_jump_at_acceptance(make_joint, speed):
    # Before acceptance a point uses max(|δ̇|, v_min) of the moment, which is what it will remember.
    joint = make_joint()
    data = joint.data()
    memory = new_memory(data)
    y = at(2.5, joint.roughness, v_x=speed)
    before, after = np.empty(joint.field_shape), np.empty(joint.field_shape)
    pressure_field(data, memory, pose_at(y), before)
    wrench = joint_wrench(data, y, omega=0.2, entry_velocity=memory.entry_velocity)
    accept(data, memory, y)
    assert memory.entry_velocity.any()
    pressure_field(data, memory, pose_at(y), after)
    np.testing.assert_array_equal(after, before)
    np.testing.assert_array_equal(
        joint_wrench(data, y, omega=0.2, entry_velocity=memory.entry_velocity), wrench
    )


def test_total_pressure_is_never_tensile_unless_asked(make_joint):
    joint = make_joint()
    h_star, approach = 2.0, -5e-3
    rigid, clipped = total(joint, h_star, approach, V_MIN)
    _, free, _, _ = node_pressure(
        joint.table, joint.roughness, V_MIN, 0.0, h_star * joint.roughness, approach, V_MIN
    )
    assert rigid > 0.0
    assert clipped == 0.0
    assert free < 0.0


def test_approaching_at_the_entry_speed_adds_the_whole_coefficient(make_joint, contact_table):
    # model.md section 3: C = 5.930 MPa at h* = 2 and 407.3 MPa at 0; P_k = 9.287 and 518.2 MPa.
    joint = make_joint()
    assert total(joint, 2.0, 3e-3, 3e-3)[1] == pytest.approx(9.287e6 + 5.930e6, rel=2e-4)
    assert total(joint, 0.0, 3e-3, 3e-3)[1] == pytest.approx(518.2e6 + 407.3e6, rel=2e-4)
    assert total(joint, 0.0, 1.5e-3, 3e-3)[1] == pytest.approx(518.2e6 + 407.3e6 / 2.0, rel=2e-4)


def middle(joint):
    """Return the index of the node where the gap is smallest."""
    return joint.grid.z // 2, joint.grid.theta // 2


def test_it_is_kept_in_contact_and_forgotten_outside(make_joint):
    joint = make_joint()
    data, node = joint.data(), middle(joint)
    memory = new_memory(data)
    accept(data, memory, at(3.9, joint.roughness, v_x=5e-3))
    for depth, speed in ((2.0, 3e-3), (1.0, 0.0), (3.9, -8e-3)):
        accept(data, memory, at(depth, joint.roughness, v_x=speed))
        assert memory.entry_velocity[node] == pytest.approx(5e-3)
    accept(data, memory, at(4.1, joint.roughness, v_x=-8e-3))
    assert not memory.entry_velocity.any()
    accept(data, memory, at(3.9, joint.roughness, v_x=2e-3))
    assert memory.entry_velocity[node] == pytest.approx(2e-3)


def test_a_worn_point_enters_later(make_joint):
    joint = make_joint()
    node = middle(joint)
    wear = np.zeros(joint.field_shape)
    wear[node] = joint.roughness
    memory = new_memory(joint.data())
    entry = accept(joint.data(wear), memory, at(3.5, joint.roughness, v_x=5e-3), 0.0)
    assert entry[node] == 0.0
    assert entry[node[0], node[1] + 1] > 0.0
