"""Robots and contacts made in code: those of files, number by number, and what is wrong with others."""

import dataclasses
import pickle

import maxwrench as mw
import numpy as np
import pytest

ARM_LIMIT = 1.0471975511965976  # rad
LIMITS = {"q_min": -ARM_LIMIT, "q_max": ARM_LIMIT, "velocity_max": 1, "effort_max": 1}
HULL = mw.Link("hull", mass=10, inertia=[0.15, 0.32, 0.43333])


def rod(name):
    return mw.Link(name, mass=0.1, com=[0.05, 0, 0], inertia=np.diag([0.000005, 0.0000875, 0.0000875]))


def capsule(link):
    """The capsule from [0, 0, 0] to [0.1, 0, 0]."""
    return mw.Shape(link, placement=mw.Pose([0.05, 0, 0], rpy=[0, np.pi / 2, 0]), radius=0.01, half_length=0.05)


def thrusters():
    corners = {"front_left": (0.3, 0.2, -1), "front_right": (0.3, -0.2, 1)}
    corners |= {"rear_left": (-0.3, 0.2, 1), "rear_right": (-0.3, -0.2, -1)}
    return [
        mw.Thruster(name, [x, y, 0], [4, side, 0], force_min=-1, force_max=1) for name, (x, y, side) in corners.items()
    ]


def vehicle(**changes):
    """problems/planar/vehicle.toml in code."""
    parts = {
        "links": [HULL, rod("link_1"), rod("link_2")],
        "joints": [
            mw.Joint("shoulder", "hull", mw.Pose([0.3, 0.1, 0]), **LIMITS),
            mw.Joint("elbow", "link_1", mw.Pose([0.1, 0, 0]), **LIMITS),
        ],
        "name": "planar vehicle",
        "base": "x,y,yaw",
        "thrusters": thrusters(),
        "end_effectors": [mw.EndEffector("tool", "link_2", mw.Pose([0.1, 0, 0]))],
        "shapes": [mw.Shape("hull", "box", half_sizes=[0.3, 0.2, 0.1]), capsule("link_1"), capsule("link_2")],
        "ignore": [("hull", "link_1"), ("link_1", "link_2")],
        "margin": 0.005,
    }
    return mw.make_robot(**(parts | changes))


def push(robot, **more):
    pose = mw.Pose(rpy=[0, 0, 0.17453292519943295])
    return mw.Static(robot, pose=pose, c="x", any="fx,fy,tz", theta_r=["shoulder", "elbow"], **more)


def same_values(made, of_file, count=200):
    span = of_file.theta_r_max - of_file.theta_r_min
    theta_r = of_file.theta_r_min + np.random.default_rng(1).uniform(0, 1, (count, span.size)) * span
    for wrench in ("pure", "any"):
        mine, theirs = (mw.evaluate(task, theta_r, wrench=wrench) for task in (made, of_file))
        assert mine.status == theirs.status and mine.valid.any()
        for name in ("beta", "u", "h", "q", "base"):
            assert getattr(mine, name) == pytest.approx(getattr(theirs, name), rel=1e-12, abs=1e-12, nan_ok=True)
    

def test_it_is_the_robot_of_the_file():
    made, of_file = vehicle(), mw.load("planar/force").robot
    for name in ("name", "base", "joint_names", "link_names", "thruster_names", "end_effectors", "parents"):
        assert getattr(made, name) == getattr(of_file, name)
    for name in ("B", "u_min", "u_max", "q_min", "q_max", "velocity_max"):
        assert getattr(made, name) == pytest.approx(getattr(of_file, name), abs=1e-15)
    assert len(made.bodies) == len(of_file.bodies) == 3
    same_values(push(made), mw.load("planar/force"))


def test_indices_are_as_good_as_names():
    named = vehicle()
    joints = [
        mw.Joint("shoulder", 0, mw.Pose([0.3, 0.1, 0]), **LIMITS),
        mw.Joint("elbow", 1, mw.Pose([0.1, 0, 0]), **LIMITS),
    ]
    numbered = vehicle(joints=joints, end_effectors=[mw.EndEffector("tool", 2, mw.Pose([0.1, 0, 0]))])
    assert mw.evaluate(push(numbered), [0.1, 0.2]).beta == mw.evaluate(push(named), [0.1, 0.2]).beta


def two_arms():
    """What problems/planar/two_arms_robot.toml has in addition or in place of vehicle.toml."""
    wide = LIMITS | {"q_min": -2 * ARM_LIMIT, "q_max": 2 * ARM_LIMIT}
    return {
        "links": [HULL, *map(rod, ("link_1", "link_2", "second_1", "second_2"))],
        "joints": [
            mw.Joint("shoulder", "hull", mw.Pose([0.3, 0.1, 0]), **LIMITS),
            mw.Joint("elbow", "link_1", mw.Pose([0.1, 0, 0]), **LIMITS),
            mw.Joint("shoulder_2", "hull", mw.Pose([0.3, -0.1, 0]), **wide),
            mw.Joint("elbow_2", "second_1", mw.Pose([0.1, 0, 0]), **wide),
        ],
        "end_effectors": [
            mw.EndEffector("tool", "link_2", mw.Pose([0.1, 0, 0])),
            mw.EndEffector("second_tool", "second_2", mw.Pose([0.1, 0, 0])),
        ],
        "shapes": [
            mw.Shape("hull", "box", half_sizes=[0.3, 0.2, 0.1]),
            *map(capsule, ("link_1", "link_2", "second_1", "second_2")),
        ],
        "ignore": [("hull", "link_1"), ("link_1", "link_2"), ["hull", "second_1"], "second_1,second_2"],
    }


def test_a_second_contact():
    of_file = mw.load("planar/two_arms")
    robot = vehicle(**two_arms())
    assert robot.joint_names == of_file.robot.joint_names
    assert robot.q_min == pytest.approx(of_file.robot.q_min)
    wall = mw.Contact(
        "second_tool",
        "basis",
        frame=mw.Pose([-0.02, -0.25, 0], rpy=[np.pi / 2, 0, np.pi / 2]),
        surface="line",
        joints="shoulder_2,elbow_2",
        basis=[mw.Direction([0.5, 0, 1, 0, 0, 0], min=0), mw.Direction([-0.5, 0, 1, 0, 0, 0], min=0)],
        min=[-0.12],
        max=[0.12],
        default=[0],
        length_scale=0.1,
    )
    made = push(robot, end_effector="tool", theta_r_default=[0, 0], contact=wall)
    assert made.theta_r_names == of_file.theta_r_names == ["shoulder", "elbow", "regrasp_1"]
    same_values(made, of_file)
    assert mw.evaluate(pickle.loads(pickle.dumps(made)), [0, 0, 0]).beta == mw.evaluate(made, [0, 0, 0]).beta


def crane(**changes):
    """A boom of 2 kg on a stand, which carries itself and a load at 1 m."""
    boom = mw.Link("boom", mass=2, com=[0.5, 0, 0], inertia=[1e-3, 0.2, 0.2])
    parts = {
        "links": [mw.Link("stand"), boom],
        "joints": [mw.Joint("tilt", axis=[0, 2, 0], q_min=-1, q_max=1, effort_max=30)],
        "end_effectors": [mw.EndEffector("hook", "boom", mw.Pose([1, 0, 0]))],
    }
    return mw.make_robot(**(parts | changes))


def lift(robot, q=0.0):
    return mw.evaluate_joints(mw.Static(robot, joints={"tilt": q}, c="z"), [q]).beta


def test_gravity_buoyancy_and_mount():
    # Torque balance about the joint: F 1 m = 30 N m - m g 0.5 m.
    assert lift(crane()) == pytest.approx(30 - 2 * 9.81 * 0.5, rel=1e-12)
    assert lift(crane(gravity=1.62)) == pytest.approx(30 - 2 * 1.62 * 0.5, rel=1e-12)
    # In water 0.001 m^3 carries 1 kg, at 0.25 m.
    floating = mw.Link("boom", 2, [0.5, 0, 0], [1e-3, 0.2, 0.2], volume=0.001, cob=[0.25, 0, 0])
    water = crane(links=[mw.Link("stand"), floating], water_density=1000)
    assert lift(water) == pytest.approx(30 - 9.81 * (2 * 0.5 - 1 * 0.25), rel=1e-12)
    # About the vertical it may be turned.
    turned = crane(mount=mw.Pose(rpy=[0, 0, 1.0]))
    assert lift(turned) == pytest.approx(lift(crane()), rel=1e-12)
    assert lift(crane(), 0.5) == pytest.approx((30 - 2 * 9.81 * 0.5 * np.cos(0.5)) / np.cos(0.5), rel=1e-12)


def test_prismatic_joints_trim_states_and_gears():
    slide = mw.Joint("slide", type="prismatic", axis=[0, 0, 1], q_min=0, q_max=1, effort_max=100)
    lifter = crane(joints=[slide], states={"up": {"slide": 0.5}})
    assert lifter.states == {"up": {"slide": 0.5}}
    task = mw.Static(lifter, joints="up", c="z")
    assert mw.evaluate_joints(task, [0.5]).beta == pytest.approx(100 - 2 * 9.81, rel=1e-12)
    # Trim that carries all of the vehicle's weight leaves nothing to the thrusters.
    up = mw.Thruster("up", direction=[0, 0, 3], force_min=-5, force_max=5)
    boat = {"links": [mw.Link("hull", 4, inertia=[1, 1, 1])], "joints": [], "base": "x,y,z", "thrusters": [up]}
    tip = [mw.EndEffector("tip")]
    for trim, force in ((None, 5 - 4 * 9.81), ((4, [0, 0, 0]), 5.0)):
        robot = mw.make_robot(**boat, end_effectors=tip, trim=trim)
        # Negative: without trim the thruster cannot hold 4 kg, and something else must.
        value = mw.evaluate(mw.Static(robot, pose=mw.Pose(), c="z"), []).beta
        assert value == pytest.approx(force, rel=1e-12)
    finger = mw.Joint("finger", "boom", q_min=-9, q_max=9, effort_max=1, gear=mw.Gear("tilt", ratio=2))
    geared = crane(
        links=[mw.Link("stand"), mw.Link("boom", 1, inertia=[1, 1, 1]), mw.Link("tip", 1, inertia=[1, 1, 1])],
        joints=[mw.Joint("tilt", q_min=-1, q_max=1, effort_max=30), finger],
    )
    np.testing.assert_array_equal(geared.B, [[1, -2], [0, 1]])


def test_hydrodynamics_count_in_time():
    drag = mw.Hydrodynamics(added_mass=[5] * 6, damping_linear=[50] * 6, damping_quadratic=[50] * 6)
    limits = {"force_min": -50.0, "force_max": 50.0}
    sides = [mw.Thruster(name, direction=axis, **limits) for name, axis in (("x", [1, 0, 0]), ("y", [0, 1, 0]))]
    values = []
    for water in ((), [drag]):
        hull = mw.Link("hull", 10, inertia=[1, 1, 1], volume=0.01, hydrodynamics=water)
        boat = mw.make_robot(
            [hull], base="x,y", thrusters=sides, end_effectors=[mw.EndEffector("bow")], water_density=1000
        )
        path = mw.Path.screw(mw.Pose(), 4, displacement=[1, 0, 0])
        values.append(mw.evaluate(mw.Trajectory(boat, path, 4, c="x", rates=False), np.zeros((4, 0))).beta)
    assert values[1] < values[0]


def test_robots_in_code_are_pickled():
    robot = vehicle()
    again = pickle.loads(pickle.dumps(robot))
    np.testing.assert_array_equal(again.B, robot.B)
    assert mw.evaluate(pickle.loads(pickle.dumps(push(robot))), [0.1, 0.2]).beta == (
        mw.evaluate(push(robot), [0.1, 0.2]).beta
    )


def test_parts_cannot_change_but_be_replaced():
    with pytest.raises(dataclasses.FrozenInstanceError):
        HULL.mass = 1
    assert dataclasses.replace(HULL, mass=12).mass == 12 and "hull" in repr(HULL)


def bad_link(**wrong):
    return lambda: crane(links=[mw.Link("stand"), mw.Link("boom", **wrong)])


def bad_joint(**wrong):
    return lambda: crane(joints=[mw.Joint("tilt", **({"q_min": -1, "q_max": 1} | wrong))])


def bad_thruster(**wrong):
    return lambda: vehicle(thrusters=[mw.Thruster("bow", **wrong)])


def bad_shape(**wrong):
    return lambda: crane(shapes=[mw.Shape("boom", **wrong)])


def bad_contact(**wrong):
    return lambda: push(vehicle(), contact=mw.Contact("tool", "push", **wrong))


WRONG = {
    "link": lambda: crane(links=[mw.Link("stand"), mw.Link("boom"), mw.Link("jib")]),
    "links": lambda: mw.make_robot(3),
    "links[0]": lambda: mw.make_robot(["hull"]),
    "link[boom].inertial.mass": bad_link(mass=-1),
    "link[boom].inertial.mass text": bad_link(mass="heavy"),
    "link[boom].inertial.inertia": bad_link(inertia=[1, 2]),
    "link[boom].inertial.inertia skew": bad_link(inertia=[[1, 2, 0], [0, 1, 0], [0, 0, 1]]),
    "link[boom].inertial.origin.xyz": bad_link(com=[1, 2]),
    "buoyancy.boom.volume": bad_link(volume=np.nan),
    "hydrodynamics.boom[0]": bad_link(hydrodynamics=[3]),
    "joints": lambda: crane(joints=None),
    "joints[0]": lambda: crane(joints=[mw.Link("a")]),
    "joint[tilt].parent": bad_joint(parent="tower"),
    "joint[tilt].parent later": bad_joint(parent=1),
    "joint[tilt].type": bad_joint(type="ball"),
    "joint[tilt].axis.xyz": bad_joint(axis=[0, 0, 0]),
    "joint[tilt].origin": bad_joint(placement=[0, 0, 0]),
    "joint[tilt].limit.lower": bad_joint(q_min=2),
    "joint[tilt].limit.lower none": bad_joint(q_min=-np.inf),
    "joint[tilt].limit.effort": bad_joint(effort_max=-1),
    "joint[tilt].mimic.joint": bad_joint(gear=mw.Gear("pan")),
    "joint[tilt].mimic": bad_joint(gear=2),
    "base.axes": lambda: vehicle(base="x,yaw"),
    "base": lambda: vehicle(base="surge"),
    "mount": lambda: vehicle(mount=[0, 0, 0]),
    "thrusters[0]": lambda: vehicle(thrusters=[3]),
    "thrusters.list[0].force_max": bad_thruster(force_min=1),
    "thrusters.list[0].direction": bad_thruster(direction=[0, 0, 0]),
    "thrusters[0].position": bad_thruster(position="bow"),
    "end_effectors.hook.link": lambda: crane(end_effectors=[mw.EndEffector("hook", "jib")]),
    "end_effectors.hook.link index": lambda: crane(end_effectors=[mw.EndEffector("hook", 5)]),
    "environment.gravity": lambda: crane(gravity=-1),
    "trim": lambda: crane(trim=3),
    "trim.position": lambda: crane(trim=(1, [0])),
    "states": lambda: crane(states=[1]),
    "shapes[0].kind": bad_shape(kind="cone"),
    "shapes[0].link": lambda: crane(shapes=[mw.Shape("jib")]),
    "link[boom].collision.geometry.sphere.radius": bad_shape(radius=0),
    "link[boom].collision.geometry.hull.points": bad_shape(kind="hull", points=[[0, 0, 0]]),
    "shapes[0].points": bad_shape(kind="hull", points=[0, 0, 0]),
    "collision.ignore": lambda: crane(ignore=[("boom", "jib")]),
    "collision.ignore of one": lambda: crane(ignore=["boom"]),
    "collision.margin": lambda: crane(margin=-1),
    "contact": lambda: push(vehicle(), contact="wall"),
    "contact.surface": bad_contact(surface="sphere"),
    "contact.frame": bad_contact(frame=[0, 0, 0]),
    "contact.mu": bad_contact(mu="rough"),
    "contact.basis[0]": bad_contact(basis=[[1, 0, 0, 0, 0, 0]]),
    "contact.rest": bad_contact(rest=[1]),
}


@pytest.mark.parametrize("name", WRONG)
def test_wrong_parts(name, rejects):
    assert rejects(WRONG[name]).key == name.partition(" ")[0]
