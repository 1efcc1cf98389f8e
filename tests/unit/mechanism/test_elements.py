"""What every element keeps: equation, reactions, power, derivatives and refusals, over the list of all kinds.

The ground of each example is a free body here, so that reactions on all bodies show.
"""

import re
from dataclasses import replace
from typing import ClassVar

import numpy as np
import pytest

import tribodyn as td
from mebdf.arrays import FloatArray
from tribodyn.cases.load import parse
from tribodyn.core.errors import InputError
from tribodyn.core.problem import Problem
from tribodyn.kernels.mechanism.bodies import collect, move, place
from tribodyn.kernels.mechanism.data import COORDINATE, DISTANCE, N_STATES, NONE, PATH, TURNING, VELOCITY
from tribodyn.kernels.mechanism.law import fill_law
from tribodyn.mechanism.assembly.assembly import Assembly, assemble
from tribodyn.mechanism.assembly.closing import System
from tribodyn.mechanism.assembly.mechanism_problem import mechanism_problem
from tribodyn.mechanism.assembly.parts_by_number import model_of
from tribodyn.mechanism.builder.mechanism_builder import Mechanism
from tribodyn.mechanism.elements import ELEMENTS
from tribodyn.mechanism.elements.distance import Distance
from tribodyn.mechanism.elements.element import ElementKeys
from tribodyn.mechanism.elements.gear import Gear, Rack
from tribodyn.mechanism.elements.screw import Screw
from tribodyn.mechanism.elements.stop import one_sided
from tribodyn.mechanism.figures.mechanism import draw
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.sections import mechanism


class WithBacklash(Gear):
    """A gear pair with one flank in contact, so that its force law has two legs."""

    LAW: ClassVar = one_sided
    EXAMPLE: ClassVar[str] = Gear.EXAMPLE.replace(
        "ratio = -0.5", 'ratio = -0.5\nbacklash = "0 mm"\nmesh_stiffness = "1 N/um"\nrestitution = 0.7'
    )


BASE = 'base = { mass = "5 kg", centre = "10, 20, 30 mm", inertia = "1e-2, 2e-2, 2e-2 kg m^2" }'
ALL = (*ELEMENTS, WithBacklash)
OVER_ALL = pytest.mark.parametrize("kind", ALL, ids=lambda kind: kind.__name__)
FORCES = [kind for kind in ALL if kind.LAW is not None]
COUPLING = [kind for kind in ELEMENTS if "joints" in kind.model_fields]


def parsed(text: str) -> MechanismCase:
    case = parse(text, "example", {MechanismCase.kind(): MechanismCase})
    assert isinstance(case, MechanismCase)
    return case


def without_drive(text: str) -> str:
    return re.sub(r"\[drives.motor\](.|\n)*", "", text)


def floating(kind: type[ElementKeys]) -> MechanismCase:
    """Return the example of a kind with a free body in the place of the ground, and weights."""
    text = (
        re.sub("gravity = .*", "", kind.EXAMPLE)
        .replace('"ground"', '"base"')
        .replace("[joints]", f"{BASE}\n[joints]")
    )
    return parsed(text.replace("[bodies]", 'gravity = "3, -9, 2 m/s^2"\n[bodies]'))


def assembled(kind: type[ElementKeys]) -> Assembly:
    found = assemble(model_of(floating(kind)))
    found.require_sound()
    return found


def disturbed(kind: type[ElementKeys], share: float) -> System:
    """Return the mechanism with its bodies somewhat off, so that joints are open, and moving."""
    system, chance = System(assembled(kind).model), np.random.default_rng(1)
    for body in range(system.n):
        change = share * chance.normal(size=6) * np.repeat([system.size, 1.0], 3)
        move(system.now.bodies[body], change, np.zeros(4))
    system.now.bodies.v[:-1], system.now.bodies.w[:-1] = chance.normal(size=(2, system.n, 3))
    system.refresh()
    return system


def row_of(system: System) -> FloatArray:
    """Return the first equation of the element over velocities of all bodies, the ground too, (n + 1, 6)."""
    row, leg = np.zeros((system.n + 1, 6)), system.model.first_leg
    while leg != NONE:
        coupling, now = system.parts.couplings[leg], system.now.couplings[leg]
        row[coupling.socket] += now.G[0, :6]
        row[coupling.shaft] += now.G[0, 6:]
        leg = int(coupling.next_leg)
    return row


@OVER_ALL
def test_jacobian_times_velocities_is_the_rate_of_the_residual(kind: type[ElementKeys]) -> None:
    system = disturbed(kind, 0.1)
    bodies, now = system.now.bodies, system.now.couplings[system.model.first_leg]
    velocity = np.hstack([bodies.v, bodies.w]).copy()
    # The velocity of the mass centre is global, the turn that `move` takes is about the axes of the body.
    rate = float(np.sum(row_of(system) * velocity))
    assert rate == pytest.approx(float(now.rate[0]), rel=1e-12)
    if now.rate[0] != 0.0 and system.parts.couplings[system.model.first_leg].row_kind[0] == PATH:
        return
    start, gaps, step = system.position(), [], 1e-5
    for way in (-step, step):
        system.restore(start)
        for body in range(system.n):
            move(bodies[body], way * velocity[body], np.zeros(4))
        system.refresh()
        gaps.append(float(now.residual[0]))
    assert (gaps[1] - gaps[0]) / (2.0 * step) == pytest.approx(rate, rel=1e-7)


@OVER_ALL
def test_reactions_on_all_bodies_have_no_resultant(kind: type[ElementKeys]) -> None:
    system = disturbed(kind, 0.1)
    bodies, force, moment, loads = system.now.bodies, np.zeros(3), np.zeros(3), row_of(system)
    for body, load in zip(bodies, loads, strict=True):
        force += load[:3]
        moment += body.A @ load[3:] + np.cross(body.r, load[:3])
    size = float(np.max(np.abs(loads)))
    assert size > 0.0
    assert force == pytest.approx(np.zeros(3), abs=1e-14 * size)
    assert moment == pytest.approx(np.zeros(3), abs=1e-14 * size)


@pytest.mark.parametrize("kind", [Gear, Rack], ids=lambda kind: kind.METHOD)
def test_teeth_load_the_wheels_and_not_the_body_that_carries_them(kind: type[ElementKeys]) -> None:
    system = System(assembled(kind).model)
    loads = row_of(system)[:-1]
    names = system.model.bodies
    sizes = {name: float(np.max(np.abs(load))) for name, load in zip(names, loads, strict=True)}
    assert sizes.pop("base") < 1e-15
    assert min(sizes.values()) == 1.0


def problem_of(kind: type[ElementKeys], *, dense: bool) -> Problem:
    problem = mechanism_problem(assembled(kind), duration=1.0, rtol=1e-6, dense=dense)
    # What a controller holds.
    problem.memory.now.couplings.law.held[:] = 0.3
    return problem


def rates(problem: Problem, y: FloatArray) -> FloatArray:
    f = np.zeros(y.size)
    problem.functions.rhs(0.0, y, problem.data, problem.memory, f)
    return f


def moving(problem: Problem) -> FloatArray:
    """Return a state on the constraints, not as drawn, in which all bodies move."""
    y = problem.y0.copy()
    states, chance = y.reshape(-1, N_STATES), np.random.default_rng(3)
    states[:, VELOCITY:] += chance.normal(size=(len(states), 6))
    states[:, :VELOCITY] += 1e-3 * chance.normal(size=(len(states), VELOCITY))
    problem.functions.enter(0.0, y, problem.data, problem.memory)
    return y


@OVER_ALL
def test_power_of_forces_is_the_rate_of_the_energy(kind: type[ElementKeys]) -> None:
    problem = problem_of(kind, dense=True)
    y = moving(problem)
    rate, parts, now = rates(problem, y).reshape(-1, N_STATES), problem.data.parts, problem.memory.now
    states = y.reshape(-1, N_STATES)
    kinetic = sum(
        body.mass * state[VELOCITY:TURNING] @ change[VELOCITY:TURNING]
        + state[TURNING:] @ body.inertia @ change[TURNING:]
        for body, state, change in zip(parts.bodies, states, rate, strict=True)
    )
    weight = float(np.sum(parts.bodies.mass[:, None] * states[:, VELOCITY:TURNING] @ parts.constants.gravity))
    motor = sum(0.2 * c.twist[5] for c in now.couplings[:1])
    legs = np.isin(parts.couplings.row_kind[:, 0], (COORDINATE, DISTANCE, PATH))
    assert np.max(np.abs(now.couplings.multiplier[legs, 0])) > 1e-3
    laws = now.couplings.law[(parts.couplings.law != 0) & (parts.couplings.first_leg == NONE)]
    assert kinetic == pytest.approx(weight + motor + float(np.sum(laws.force * laws.rate)), rel=1e-9)


@pytest.mark.parametrize("kind", FORCES, ids=lambda kind: kind.METHOD)
def test_the_power_of_a_force_is_what_it_stores_and_turns_into_heat(kind: type[ElementKeys]) -> None:
    problem = problem_of(kind, dense=True)
    y = moving(problem)
    rates(problem, y)
    number = int(np.flatnonzero(problem.memory.now.couplings.law.force)[0])
    coupling = problem.data.parts.couplings[number]
    law, found, step = problem.memory.now.couplings[number].law, [], 1e-6
    assert law.rate != 0.0
    assert law.force != 0.0
    power, heat, supplied = law.force * law.rate, law.damping + law.friction, law.supplied.copy()
    slopes = law.in_position.copy(), law.in_rate.copy()
    at, speed = law.position.copy(), law.rate.copy()
    for position, rate in ((step, 0.0), (-step, 0.0), (0.0, step), (0.0, -step)):
        now = problem.memory.now.couplings[number]
        now.residual[0], now.rate[0] = at + position, speed + rate
        fill_law(coupling, now, problem.data.signals)
        found.append((float(law.stored), float(law.force)))
    (more, push), (less, pull), (_, faster), (_, slower) = found
    assert heat >= 0.0
    assert power == pytest.approx(supplied - heat - (more - less) / (2.0 * step) * speed, rel=1e-6)
    size = abs(push) / step
    assert slopes[0] == pytest.approx((push - pull) / (2.0 * step), rel=1e-5, abs=1e-9 * size)
    assert slopes[1] == pytest.approx((faster - slower) / (2.0 * step), rel=1e-5, abs=1e-9 * size)


@OVER_ALL
def test_derivatives_are_those_of_differences(kind: type[ElementKeys]) -> None:
    problem = problem_of(kind, dense=True)
    # Joints are open by a hundredth: much more, and rows of the example nearly depend on each other.
    y = problem.y0 + 0.01 * np.random.default_rng(2).normal(size=problem.y0.size)
    y.reshape(-1, N_STATES)[:, VELOCITY:] *= 100.0
    jacobian, f = np.zeros((y.size, y.size)), np.zeros(y.size)
    problem.functions.jac(0.0, y, problem.data, problem.memory, f, jacobian)
    step = 1e-5
    columns = [(rates(problem, y + e) - rates(problem, y - e)) / (2.0 * step) for e in step * np.eye(y.size)]
    differences = np.array(columns).T
    # Differences err by step² times a third derivative; compliance of rows is iterated in rates alone.
    assert np.abs(jacobian - differences).max() < 1e-6 * np.abs(differences).max()


@OVER_ALL
@pytest.mark.parametrize("gamma", [1e-3, -0.3])
def test_blocks_solve_as_the_full_matrix_does(kind: type[ElementKeys], gamma: float) -> None:
    problem, whole = problem_of(kind, dense=False), problem_of(kind, dense=True)
    y, jacobian = moving(whole), np.zeros((whole.y0.size,) * 2)
    whole.functions.jac(0.0, y, whole.data, whole.memory, np.zeros(y.size), jacobian)
    full, algebra = np.eye(y.size) - gamma * jacobian, problem.algebra
    assert algebra is not None
    entries, factors = np.zeros(algebra.n_entries), np.zeros(algebra.n_factors)
    pivots = np.zeros(0, dtype=int)
    problem.functions.jac(0.0, y, problem.data, problem.memory, np.zeros(y.size), entries)
    assert algebra.factorise(gamma, problem.data, entries, factors, pivots) == np.linalg.slogdet(full)[0]
    x = right = np.random.default_rng(3).normal(size=y.size)
    algebra.solve(problem.data, factors, pivots, x := right.copy())
    # Both are rounded by the condition of the matrix.
    assert np.abs(full @ x - right).max() < 1e-9 * np.abs(x).max() * np.abs(full).max()


@OVER_ALL
def test_a_run_keeps_the_equation_momentum_and_energy(kind: type[ElementKeys]) -> None:
    result = td.simulate(floating(kind).replace({"gravity": "0, 0, 0 m/s^2", "solver.rtol": "1e-8"}))
    assert float(result["gap"].max()) < 1e-12
    # Heat is integrated between the ends of steps; of an equation that holds there is none.
    assert result.attrs["energy_residual"] < (1e-9 if kind in COUPLING else 1e-5)
    # Nothing but the air acts from outside: elements act on all bodies they involve.
    for name, impulse in (("momentum", "impulse"), ("spin", "spin_impulse")):
        for axis in "xyz":
            change = result[f"{name}_{axis}"] - result[f"{name}_{axis}"][0]
            assert float(abs(change - result[f"{impulse}_{axis}"]).max()) < 1e-7


@pytest.mark.parametrize("kind", COUPLING, ids=lambda kind: kind.METHOD)
def test_any_order_of_bodies_in_joints_is_the_same_mechanism(kind: type[ElementKeys]) -> None:
    expected = td.simulate(parsed(kind.EXAMPLE))
    swapped = re.sub(r'between = \["(\w+)", "(\w+)"\]', r'between = ["\2", "\1"]', kind.EXAMPLE)
    # The motor turns the second body, which is the other one then.
    found = td.simulate(parsed(swapped.replace('"0.2 N m"', '"-0.2 N m"')))
    for name in ("position", "velocity", "angular_velocity", "element_force", "element_moment"):
        # Mass centres at rest move by rounding.
        largest = max(1e-6, float(abs(expected[name]).max()))
        both = found[name].values, expected[name].values
        assert both[0] == pytest.approx(both[1], abs=1e-9 * largest, nan_ok=True), name
    # An element gives a force, a torque or both.
    assert np.fmax(abs(expected["element_force"]), abs(expected["element_moment"])).min() > 0.0


@pytest.mark.parametrize("kind", [k for k in ELEMENTS if k not in COUPLING], ids=lambda kind: kind.METHOD)
def test_a_misdescribed_member_is_refused_with_the_reason(kind: type[ElementKeys]) -> None:
    for key, fields in (("between", "nowhere"), ("body", "nowhere"), ("joint", "nowhere")):
        if key in kind.model_fields:
            found = re.sub(rf"(\n{key} = .*?\")\w+", rf"\1{fields}", kind.EXAMPLE, count=1)
            with pytest.raises(InputError, match=rf"{kind.TABLE}\.\w+\.{key}: .* \"nowhere\" is no "):
                parsed(found)
    for old, new, key, reason in WRONG.get(kind.METHOD, ()):
        assert old in kind.EXAMPLE
        with pytest.raises(InputError, match=rf"{kind.TABLE}\.\w+\.{key}: .*{reason}"):
            parsed(without_drive(kind.EXAMPLE).replace(old, new))


_POINTS = [
    ('between = ["crank", "rocker"]', 'between = ["crank", "crank"]', "between", "twice the same body"),
    ("100, 60, 20 mm", "0, 30, 0 mm", "second_point", "both ends are at one point"),
]
_CURVE = 'torque = { speeds = "-100, 0, 100, 200 rad/s", values = "3, 2, 1.2, 0 N m" }'
_OF_ANGLE = ('input = { type = "revolute"', 'input = { type = "prismatic"', "joint", "a joint with an angle")
#: Of each kind: what is replaced in its example, by what, and which key is refused with which reason.
WRONG: dict[str, list[tuple[str, str, str, str]]] = {
    "distance": _POINTS,
    "nonlinear_spring": [
        ('between = ["arm", "ground"]', 'between = ["arm", "arm"]', "between", "twice the same body")
    ],
    "torsion_spring": [_OF_ANGLE],
    "stop": [
        _OF_ANGLE,
        ('angle = "-0.2 deg"\n', "", "angle", "say where it begins"),
        ('angular_stiffness = "100 N m/rad"\n', "", "angular_stiffness", "needs its angular_stiffness"),
        ("restitution = 0.6", 'damping_factor = "kelvin-voigt"', "damping_factor", "needs a mass"),
    ],
    "drag": [("drag_coefficient = 1.2", "drag_coefficient = -1.2", "drag_coefficient", ">= 0")],
    "friction": [
        ('radius = "10 mm"\n', "", "radius", "needs the radius at which it slides"),
        ("static_coefficient = 0.15", "static_coefficient = 0.05", "static_coefficient", "below that of"),
    ],
    "motor": [
        _OF_ANGLE,
        (_CURVE, "", "stall_torque", "say what it gives: stall_torque and no_load_speed"),
        (_CURVE, 'stall_torque = "2 N m"', "no_load_speed", "a straight line needs its no_load_speed"),
        (_CURVE, 'stall_torque = "2 N m"\nno_load_speed = "-9 rpm"', "no_load_speed", "or both below"),
        (_CURVE, 'torque = "2 N m"', "torque", "a table over speeds; a constant one is a drive"),
    ],
    "controller": [
        _OF_ANGLE,
        ('angle = "20 deg"\n', "", "angle", "say what it controls, such as angle"),
        ('angle_gain = "2 N m/rad"', 'speed_gain = "2 N m s/rad"', "speed_gain", "has the gain angle_gain"),
        ('torque_limit = "1 N m"', 'force_limit = "1 N"', "force_limit", "this controller gives a torque"),
        ('angle = "20 deg"', 'angle = { angles = "0, 9 deg", values = "0, 9 deg" }', "angle", "follows time"),
        ('sampling_time = "5 ms"', 'sampling_time = "1 ns"', "sampling_time", "allowed are 100000"),
        ('sampling_time = "5 ms"', 'sampling_time = "0 s"', "sampling_time", "> 0"),
    ],
}


@pytest.mark.parametrize("kind", COUPLING, ids=lambda kind: kind.METHOD)
def test_a_joint_of_a_wrong_type_is_refused_with_the_reason(kind: type[ElementKeys]) -> None:
    joint = re.findall(r'joints = \["(\w+)"', kind.EXAMPLE)[0]
    text = re.sub(rf'({joint} = {{ type = )"\w+"', r'\1"universal", second_axis = [0, 1, 0]', kind.EXAMPLE)
    text = text.replace("axis = [0, 0, 1]", "axis = [1, 0, 0]")
    text = without_drive(text)
    with pytest.raises(InputError, match=f"{joint} is a universal joint; .* takes "):
        parsed(text)


@pytest.mark.parametrize("kind", COUPLING, ids=lambda kind: kind.METHOD)
def test_unknown_joints_and_values_of_zero_are_refused_with_the_reason(kind: type[ElementKeys]) -> None:
    joint = re.findall(r'joints = \["(\w+)"', kind.EXAMPLE)[0]
    with pytest.raises(InputError, match=rf'{kind.TABLE}.*joints.* "nowhere" is no joint'):
        parsed(kind.EXAMPLE.replace(f'joints = ["{joint}"', 'joints = ["nowhere"'))
    for key in [key for key in set(kind.model_fields) - {"joints"} if f"\n{key} = " in kind.EXAMPLE]:
        zero = re.sub(
            rf'\n{key} = "?[-0-9.]+', lambda found: re.sub(r"[-0-9.]+$", "0", found[0]), kind.EXAMPLE
        )
        with pytest.raises(InputError, match=rf"{kind.TABLE}\.\w+\.{key}: .*( is 0; |> 0)"):
            parsed(zero)


@OVER_ALL
def test_the_builder_writes_the_table_of_the_kind(kind: type[ElementKeys]) -> None:
    example = parsed(kind.EXAMPLE)
    assert parsed(example.to_toml()) == example
    (_, name, keys), *_ = example.elements()
    drawn = Mechanism(run={"duration": "1 ms"})
    given = {key: example.given(f"{kind.TABLE}.{name}.{key}") for key in kind.model_fields}
    given = {key: value for key, value in given.items() if value is not None}
    assert getattr(drawn, kind.METHOD)(name, **given) is drawn
    assert drawn._tables[kind.TABLE][name] == given
    assert keys == type(keys)(**{key: getattr(keys, key) for key in kind.model_fields})


def test_an_element_is_one_class_with_its_own_names() -> None:
    for attribute in ("TABLE", "METHOD", "__name__"):
        assert len({getattr(kind, attribute) for kind in ELEMENTS}) == len(ELEMENTS)


def test_two_elements_need_two_names() -> None:
    text = Gear.EXAMPLE + '[racks.mesh]\njoints = ["input", "output"]\nradius = "20 mm"\n'
    with pytest.raises(InputError, match="has this name already"):
        parsed(text)


def test_a_state_that_is_carried_on_keeps_the_equation_after_any_number_of_turns() -> None:
    kind = Gear
    assembly = assemble(model_of(parsed(kind.EXAMPLE)))
    state, bodies = assembly.state.copy(), System(assembly.model).now.bodies
    place(state, bodies)
    for body, turn in ((0, 2.0 * np.pi), (1, -np.pi)):
        for _ in range(100):
            change = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 2.0 * np.tan(0.005 * turn)])
            move(bodies[body], change, np.zeros(4))
    collect(bodies, state)
    before = state.copy()
    problem = mechanism_problem(replace(assembly, state=state), duration=1.0, rtol=1e-6)
    problem.functions.enter(0.0, state, problem.data, problem.memory)
    # Half a turn of the wheel for each turn of the pinion: angles within a turn would not fit.
    assert state == pytest.approx(before, abs=1e-12)


@pytest.mark.parametrize(("kind", "lines"), [(Gear, 2), (Rack, 4), (Screw, 2), (Distance, 1)])
def test_figure_and_report_show_pitch_circles_and_rods(kind: type[ElementKeys], lines: int) -> None:
    result = td.simulate(parsed(kind.EXAMPLE))
    shown = mechanism.data(result)
    assert shown is not None
    assert len(shown["outlines"]) == lines  # a slider is a box and the line of its guide
    assert draw(result).axes
