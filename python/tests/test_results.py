"""Attributes that say how a result came about, and names of classes."""

import maxwrench as mw
import numpy as np
import pytest


def test_classes_of_results(tmp_path):
    force = mw.load("planar/force")
    cost = mw.sensitivity(force, actuators="elbow", friction=1, budget=20)
    front = mw.pareto("uvms/valve", "uvms/lift", points=3, budget=100)
    proof, moved = mw.certify(force), mw.certify("planar/trajectory", [0, 0])
    proof.save(tmp_path / "a.proof")
    moved.save(tmp_path / "b.proof")
    motion = {"t": [0, 1, 2], "shoulder": [-0.8, -0.7, -0.8], "elbow": [1, 0.9, 1]}
    for result, kind in (
        (cost, mw.Sensitivity),
        (cost.losses[0], mw.Loss),
        (front, mw.Front),
        (mw.map(force, {"azimuth": (0, 6, 3)}, budget=50), mw.Map),
        (mw.margin(force, motion), mw.Margin),
        (proof, mw.Proof),
        (moved, mw.TrajectoryProof),
        (mw.verify(tmp_path / "a.proof"), mw.VerifiedProof),
        (mw.verify(tmp_path / "b.proof"), mw.VerifiedTrajectory),
    ):
        assert type(result) is kind and "object at 0x" not in repr(result)


def test_the_value_of_linf_polytope_beside_another_measure():
    at = [0.3, 0.1]
    other = mw.evaluate("planar/force", at, measure="ellipsoid")
    ours = mw.evaluate("planar/force", at)
    assert other.beta_linf == pytest.approx(ours.beta, rel=1e-12) and other.beta <= other.beta_linf * (1 + 1e-12)
    assert np.isnan(mw.evaluate("planar/force", [0, 1.2]).beta_linf)


def test_between_the_instants_of_a_trajectory():
    turn = mw.evaluate("planar/trajectory", [0, 0])
    # The instants are close to each other, so what is between them is close to the least of them.
    assert turn.between_knots == pytest.approx(turn.betas.min(), rel=1e-4)
    assert np.isnan(mw.evaluate("planar/force", [0, 0]).between_knots)


def test_why_a_search_stopped():
    assert mw.solve("planar/force", search="sample", budget=50).stopped == "the evaluations ran out"
    ended = mw.solve("uvms/valve", search="sample", budget=10**8, callback=lambda count: True)
    assert ended.stopped == "interrupted"
    assert mw.evaluate("planar/force", [0, 0]).stopped == ""


def test_counts_of_ik_solutions():
    one = mw.evaluate("planar/force", [0, 0]).solutions
    assert (one["found"], one["valid"], one["most"]) == (1, 1, 1)
    found = mw.solve("dual_arm/two_arms", search="sample", budget=200).solutions
    # Every solution that was found is valid, or is rejected for one reason.
    assert found["valid"] == found["found"] - found["beyond_limit"] - found["singular"] - found["collision"]
    assert found["most"] >= 2 and found["incomplete"] == 0 and found["found"] > 200


def test_the_scenario_that_an_explanation_explains():
    push = mw.load("fixed/push")
    listed = mw.Static(push.robot, uncertainty={"torque": 0.1, "mass": {"link_3": 0.5}})
    answer = mw.evaluate(listed, listed.theta_r_default)
    assert answer.explain().scenario == answer.decides != ""


def test_weights_of_a_front():
    front = mw.pareto("uvms/valve", "uvms/lift", points=3, budget=100)
    assert front.phi == pytest.approx([0, np.pi / 4, np.pi / 2])
    expected = front.own * np.column_stack([np.cos(front.phi), np.sin(front.phi)])
    assert front.weights == pytest.approx(expected, abs=1e-9)


def test_a_held_trajectory_says_what_was_simulated():
    held = mw.solve_held("planar/trajectory", simulations=2, budget=300)
    assert isinstance(held, mw.HeldTrajectory) and 1 <= held.simulations <= 2
    assert held.reading >= held.first  # it is kept if nothing better is held
    one = mw.solve_held("planar/trajectory", simulations=1, budget=300)
    assert one.simulations == 1 and one.first == one.reading == held.first


def test_iterations_of_a_linear_program():
    assert mw.linprog([1, 2], [[1, 1]], [1]).iterations >= 1
    assert mw.linprog([0], np.zeros((0, 1)), [], [0], [1]).iterations == 0


def test_places_of_a_map():
    found = mw.map("planar/force", {"azimuth": (0, 6, 5)}, budget=100, check=1.0, refine=1)
    assert found.refine == 1 and len(found) == 9  # each of four cells was halved once
    assert found.index.ravel().tolist() == list(range(9))
    assert found.at.ravel() == pytest.approx(np.linspace(0, 6, 9))
    assert sorted(found.level) == [0, 0, 0 + 1, 2, 2, 3, 3, 3, 3]  # coarse to fine
    assert found.checked == 9 and np.isfinite(found.scratch).all()
    better = found.scratch - found.beta > 1e-3 * np.abs(found.scratch)
    assert found.improved == np.count_nonzero(better)
    assert found.unchanging == []
    assert np.isnan(mw.map("planar/force", {"azimuth": (0, 6, 3)}, budget=50).scratch).all()
    # A valve that moves with the free vehicle changes nothing.
    assert mw.map("uvms/valve", {"x": (0, 1, 3)}, budget=50).unchanging == ["x"]


def test_slices_and_clearance_of_a_proof_in_time(tmp_path):
    proof = mw.certify("planar/trajectory", [0, 0])
    proof.save(tmp_path / "turn.proof")
    checked = mw.verify(tmp_path / "turn.proof")
    assert checked and checked.slices == proof.slices > 0
    assert checked.clearance == proof.clearance > 0  # no collision anywhere on the path


def test_starts_of_a_later_stage():
    seen = []

    class Later(mw.Search):
        name, accepts_starts = "later_stage", True

        def maximize(self, objective):
            seen.extend(objective.starts)
            objective(objective.starts[0][0])

    mw.add_search(Later())
    assert mw.solve("planar/force", search="sample+later_stage", budget=200).has_value
    values = [beta for _, beta in seen]
    assert values == sorted(values, reverse=True)
    assert mw.evaluate("planar/force", seen[0][0]).beta == pytest.approx(values[0], rel=1e-12)

    class First(Later):
        name, accepts_starts = "first_stage_only", False

    mw.add_search(First())
    with pytest.raises(mw.InputError, match="first_stage_only"):
        mw.solve("planar/force", search="sample+first_stage_only", budget=200)


def test_defaults_of_strategies(rejects):
    assert (mw.Search.local, mw.Search.accepts_starts, mw.Search.name) == (False, False, "")
    assert (mw.Measure.supports_any, mw.Measure.unit, mw.Measure.name) == (False, None, "")
    with pytest.raises(NotImplementedError, match="without a method maximize"):
        mw.Search().maximize(None)
    with pytest.raises(NotImplementedError, match="without a method value"):
        mw.Measure().value(None)

    class Flat(mw.Measure):
        name = "flat_value"

        def value(self, posture):
            assert isinstance(posture, mw.Posture)
            return 1.0

    mw.add_measure(Flat())
    assert "flat_value" in str(rejects(mw.evaluate, "uvms/valve", [0, 0, 0, 0], measure="flat_value", wrench="any"))

    class Any(Flat):
        name, supports_any = "flat_value_of_any", True

    mw.add_measure(Any())
    task = mw.load("uvms/valve")
    assert mw.evaluate(task, task.theta_r_default, measure="flat_value_of_any", wrench="any").beta == 1


def test_what_is_said_of_a_robot():
    two = mw.load("dual_arm/two_arms").robot
    assert [two.link_names[i] for i in two.end_effector_links] == ["left_link_4", "right_link_4"]
    assert two.warnings == two.notes == []
    arm = mw.load("gallery/panda/lift").robot
    assert any("not read" in note for note in arm.notes) and arm.warnings == []


def test_a_robot_whose_data_are_wrong_is_warned_of(tmp_path):
    urdf = """<robot name="heavy"><link name="base"/>
      <link name="rod"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
      <joint name="turn" type="revolute"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/>
      <limit lower="1" upper="-1" effort="10" velocity="1"/></joint></robot>"""
    (tmp_path / "heavy.urdf").write_text(urdf)
    robot = mw.Robot.from_urdf(tmp_path / "heavy.urdf")
    assert len(robot.warnings) == 1 and "lower 1 is above upper -1" in robot.warnings[0]
    assert (robot.q_min.tolist(), robot.q_max.tolist()) == ([-1], [1])


def test_parts_of_a_hand_with_gears():
    closes = mw.Joint("finger_2", "palm", gear=mw.Gear("finger_1", ratio=-0.5, offset=0.2), axis=[0, 0, 1], q_min=-1, q_max=1, effort_max=5)
    opens = mw.Joint("finger_1", "palm", axis=[0, 0, 1], q_min=-1, q_max=1, effort_max=5)
    links = [mw.Link("palm")] + [mw.Link(name, 0.1, inertia=[1e-4] * 3) for name in ("one", "two")]
    robot = mw.make_robot(links, [opens, closes], end_effectors=[mw.EndEffector("tip", "one", mw.Pose([0.1, 0, 0]))])
    answer = mw.evaluate_joints(mw.Static(robot, joints={"finger_1": 0.4}, c="y"), [0.4, 0.2 - 0.5 * 0.4])
    assert answer.has_value and answer.beta == pytest.approx(5 / (0.1 * np.cos(0.4)), rel=1e-6)


def test_shapes_of_a_robot():
    def robot(**shape):
        shapes = [mw.Shape("base", "box", mw.Pose([0.5, 0, 0]), half_sizes=[0.1, 0.1, 0.1], body="post"), mw.Shape("rod", body="tip", **shape)]
        turn = mw.Joint("turn", "base", axis=[0, 0, 1], q_min=-2, q_max=2, effort_max=5)
        links = [mw.Link("base"), mw.Link("rod", 1, inertia=[1, 1, 1])]
        return mw.make_robot(links, [turn], end_effectors=[mw.EndEffector("tool", "rod", mw.Pose([0.5, 0, 0]))], shapes=shapes, find_ignored=False)

    ahead = mw.Pose([0.5, 0, 0], rpy=[0, np.pi / 2, 0])  # its axis along the rod
    for half_length, at, collides in ((0.1, 0.0, True), (0.1, 1.5, False), (0.02, 0.35, False), (0.02, 0.2, True)):
        task = mw.Static(robot(radius=0.05, half_length=half_length, placement=ahead), joints={"turn": 1.5}, c="y")
        answer = mw.evaluate_joints(task, [at])
        assert ("collision" in answer.reason) == collides, (half_length, at, answer.reason)


def test_added_mass_and_drag_load_a_motion():
    """A body that a thruster moves along a line: B u = (m + a) x_dd + (d + e |x_d|) x_d."""
    a, d, e = 3.0, 2.0, 5.0
    water = mw.Hydrodynamics(added_mass=[a, 0, 0, 0, 0, 0], damping_linear=[d, 0, 0, 0, 0, 0], damping_quadratic=[e, 0, 0, 0, 0, 0])
    assert (water.added_mass[0], water.damping_linear[0], water.damping_quadratic[0]) == (a, d, e)
    body = mw.Link("float", 4, inertia=[1, 1, 1], volume=0.004, hydrodynamics=[water])
    engine = mw.Thruster("engine", direction=[1, 0, 0], force_min=-100, force_max=100, force_rate_max=1000)
    ship = mw.make_robot([body], base="x", thrusters=[engine], end_effectors=[mw.EndEffector("bow", "float")], water_density=1000)
    t, s = np.linspace(0, 2, 5), np.sin
    motion = {"t": t, "base_x": s(t), "base_x_dot": np.cos(t), "base_x_ddot": -s(t)}
    margin = mw.margin(mw.Static(ship, c="x"), motion, ball=["fx"])
    load = (4 + a) * -s(t) + (d + e * abs(np.cos(t))) * np.cos(t)
    assert margin.margin == pytest.approx(100 - abs(load), rel=1e-9)


def test_limits_of_a_contact_that_is_near_singular(rejects):
    contact = mw.Contact("fist", "push", length_scale=0.3, sigma_min=0.1)
    assert (contact.length_scale, contact.sigma_min) == (0.3, 0.1)
    two = mw.load("dual_arm/two_arms")
    joints = dict(end_effector="left_tool", c="z", pose=two.pose)
    hold = dict(joints=["right_q1_shoulder_yaw", "right_q2_shoulder_pitch", "right_q3_elbow"])
    for wrong in ({"length_scale": 0}, {"sigma_min": -1}):
        assert next(iter(wrong)) in str(rejects(mw.Static, two.robot, contact=mw.Contact("right_tool", "push", **hold, **wrong), **joints))
