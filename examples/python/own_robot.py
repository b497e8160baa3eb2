"""A robot of one's own, from its URDF to the best posture and a picture.

python3 own_robot.py [URDF] [--base AXES] [--tool LINK] [--out FILE]
"""

import argparse
import pathlib

import matplotlib
import maxwrench as mw

matplotlib.use("Agg")
ROVER = pathlib.Path(__file__).parents[2] / "problems" / "mobile" / "rover.urdf"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("urdf", nargs="?", default=ROVER)
    parser.add_argument("--base", default="x,y,yaw", help="free axes of the base, which is parked")
    parser.add_argument("--tool", default="", help="the link that is the end effector, if there are several at the ends")
    parser.add_argument("--out", default="own_robot.png")
    options = parser.parse_args()

    robot = mw.Robot.from_urdf(options.urdf, base=options.base, tool=options.tool)
    print(robot)
    for line in robot.warnings + robot.notes:
        print(" ", line)

    # The end effector stays where it is at rest; the posture that lifts most is searched.
    task = mw.Static(robot, c="z")
    answer = mw.solve(task)
    print(f"lift: {answer.beta:.1f} {answer.unit} at {task.pose}")
    for name, q in zip(robot.joint_names, answer.q):
        print(f"  {name:<20} {q:8.4f}")
    print("efforts at their limits:", ", ".join(at_limits(answer)))

    answer.plot().figure.savefig(options.out)
    print("picture:", options.out)


def at_limits(answer):
    robot = answer.task.robot
    margin = 1e-6 * (robot.u_max - robot.u_min)
    saturated = (answer.u <= robot.u_min + margin) | (answer.u >= robot.u_max - margin)
    return [name for name, full in zip(robot.actuator_names, saturated) if full]


if __name__ == "__main__":
    main()
