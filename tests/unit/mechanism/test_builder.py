"""The builder in Python: signatures, docstrings, arrays, and what a notebook shows."""

import doctest
import inspect

import numpy as np
import pytest

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.mechanism.builder.methods import METHODS, BuilderMethod

ARM = {"mass": "1 kg", "inertia": "1e-3, 1e-3, 1e-3 kg m^2"}


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.name)
def test_a_method_documents_its_keys_by_an_example_that_runs(method: BuilderMethod) -> None:
    made = getattr(td.Mechanism, method.name)
    keys = [one.name for one in inspect.signature(made).parameters.values() if one.kind is one.KEYWORD_ONLY]
    assert set(keys) <= set(method.keys.model_fields)
    parameters = made.__doc__.split("Returns\n")[0].splitlines()
    assert all(key in parameters for key in keys)
    (example,) = doctest.DocTestFinder(recurse=False).find(made, method.name, globs={})
    assert f".{method.name}(" in example.docstring
    assert doctest.DocTestRunner().run(example).failed == 0


def test_a_signature_has_the_keys_that_a_joint_of_its_kind_takes() -> None:
    revolute = inspect.signature(td.Mechanism.revolute).parameters
    assert revolute["axis"].default is inspect.Parameter.empty
    assert revolute["start_speed"].default is None
    assert not {"start_velocity", "stiffness", "between", "type"} & set(revolute)
    # Of a shape, mass and centre follow.
    assert inspect.signature(td.Mechanism.body).parameters["mass"].default is None
    assert "clearance" not in inspect.signature(td.Mechanism.universal).parameters
    assert {"gravity", "run", "solver"} <= set(inspect.signature(td.Mechanism).parameters)


def test_a_call_without_a_body_or_with_one_too_many_is_refused() -> None:
    drawn = td.Mechanism()
    with pytest.raises(TypeError, match="second"):
        drawn.revolute("hinge", "ground")
    with pytest.raises(TypeError, match="too many"):
        drawn.body("arm", "heavy")
    misspelt = drawn.body("arm", mas="1 kg")
    with pytest.raises(InputError, match=r"bodies\.arm\.mas: .*nearest valid one is bodies\.arm\.mass"):
        misspelt.case()


def test_a_method_by_another_word_is_named() -> None:
    with pytest.raises(AttributeError, match=r"no method 'hinge'; did you mean \"revolute\"\?"):
        getattr(td.Mechanism(), "hinge")  # noqa: B009
    assert not hasattr(td.Mechanism(), "__deepcopy__")


def test_numpy_arrays_are_numbers_in_si_units() -> None:
    times = np.linspace(0.0, 1.0, 5)
    drawn = td.Mechanism(gravity=np.array([0.0, -9.81, 0.0]), run={"duration": "1 s"})
    drawn.body("arm", centre=np.array([0.05, 0.0, 0.0]), **ARM)
    drawn.revolute("hinge", "ground", "arm", point=np.zeros(3), axis=np.array([0.0, 0.0, 2.0]))
    drawn.clearance("hinge", radius="10 mm", radial="20 um", length="20 mm")
    case = drawn.drive("motor", "hinge", angle={"times": times, "values": np.deg2rad(10.0) * times**2}).case()
    assert case.bodies["arm"].centre == (0.05, 0.0, 0.0)
    assert case.gravity == (0.0, -9.81, 0.0)
    assert case.joints["hinge"].axis == (0.0, 0.0, 2.0)
    assert case.drives["motor"].signal.values == tuple(np.deg2rad(10.0) * times**2)
    flat = td.Mechanism(run={"duration": "1 s"}).body("arm", centre=np.zeros(2), **ARM)
    with pytest.raises(InputError, match=r"bodies\.arm\.centre: .*2 values"):
        flat.case()


def test_a_notebook_shows_the_case_or_what_is_still_wrong() -> None:
    drawn = td.Mechanism("Arm <1>", run={"duration": "1 s"})
    drawn.revolute("hinge", "ground", "arm", point="0, 0, 0 mm", axis=[0, 0, 1])
    page = drawn._repr_html_()
    assert "Arm &lt;1&gt;" in page
    assert "hinge" in page
    assert "bodies: a mechanism needs a body" in page
    assert "bodies.arm.mass" in drawn.body("arm", centre="0, 0, 0 m", **ARM)._repr_html_()


@pytest.mark.parametrize(
    ("arguments", "keys"),
    [
        (("a", "b"), {}),
        ((), {"joints": ["a", "b"]}),
        (("a",), {"second": "b"}),
        ((), {"first": "a", "second": "b"}),
    ],
)
def test_joints_of_an_element_are_given_by_position_or_by_name(arguments, keys) -> None:
    gear = next(method for method in METHODS if method.name == "gear")
    assert gear.values("mesh", *arguments, ratio=-2, **keys) == ("mesh", {"joints": ["a", "b"], "ratio": -2})


def test_bodies_of_a_joint_are_given_by_position_or_by_name() -> None:
    hinge = next(method for method in METHODS if method.name == "revolute")
    filled = hinge.values("hinge", "ground", "arm")
    assert filled == hinge.values(name="hinge", second="arm", first="ground")
    assert filled == hinge.values("hinge", between=["ground", "arm"])
    with pytest.raises(TypeError, match="multiple values"):
        hinge.values("hinge", "ground", "arm", between=["ground", "arm"])
    with pytest.raises(TypeError, match="missing a required argument: 'second'"):
        hinge.values("hinge", "ground")
