"""The mass that an arm holds at its tool in its weakest posture, and in random ones.

python3 weakest_posture.py [URDF] [--tool LINK] [--xyz X,Y,Z] [--mount RPY] [--effort JOINT=NM ...] [--mass LINK=KG ...] [--samples N]

Efforts and masses replace those of the URDF, which are often placeholders. The weakest posture is the least of N random ones,
and of descents from the least three. Nothing proves it the least; collisions are left out.
"""

import argparse
import pathlib
import tempfile

import maxwrench as mw
import numpy as np
from scipy.optimize import minimize

PANDA = pathlib.Path(__file__).parents[2] / "tests" / "data" / "robots" / "panda" / "panda.urdf"


def robot_of(options):
    """The robot of a URDF with other efforts, masses and another mount."""
    lines = [
        'name = "arm"',
        f'urdf = "{pathlib.Path(options.urdf).resolve()}"',
        'source = "the URDF"',
        'status = "with the efforts and masses of the command"',
        f"base = {{ axes = [], xyz = [0, 0, 0], rpy = [{options.mount}] }}",
        f'end_effectors.tool = {{ link = "{options.tool}", xyz = [{options.xyz}] }}',
    ]
    for key, table in (("effort", "joints"), ("mass", "links")):
        for name, value in (pair.split("=") for pair in getattr(options, key)):
            lines.append(f"{table}.{name}.{key} = {float(value)}")
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "robot.toml"
        file.write_text("\n".join(lines) + "\n")
        return mw.Robot.from_toml(file)


def weakest(masses, lower, upper, samples, rng):
    """The least mass of any posture between the limits that was found, that posture, and the masses of random postures.

    Args:
        masses: the masses [kg] of postures (N, J); NaN: not even its own weight.
    """
    q = rng.uniform(lower, upper, (samples, len(lower)))

    def mass(x):
        return np.nan_to_num(masses(np.clip(np.atleast_2d(x), lower, upper)), nan=0)

    random = mass(q)
    ends = [
        minimize(lambda x: mass(x)[0], q[i], method="Nelder-Mead", options={"maxfev": 2000})
        for i in np.argsort(random)[:3]
    ]
    least = min(ends, key=lambda end: end.fun)
    return least.fun, np.clip(least.x, lower, upper), random


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("urdf", nargs="?", default=PANDA)
    parser.add_argument("--tool", default="panda_hand_tcp", help="link of the tool")
    parser.add_argument("--xyz", default="0, 0, 0", help="where the mass is in that link [m]")
    parser.add_argument("--mount", default="0, 0, 0", help="roll, pitch, yaw of the base [rad]")
    parser.add_argument("--effort", nargs="*", default=[], metavar="JOINT=NM")
    parser.add_argument("--mass", nargs="*", default=[], metavar="LINK=KG")
    parser.add_argument("--samples", type=int, default=100_000)
    options = parser.parse_args()
    robot = robot_of(options)
    middle = (robot.q_min + robot.q_max) / 2
    task = mw.Static(robot, joints=dict(zip(robot.joint_names, middle + 0.1)), payload={"com": [0, 0, 0]})

    def masses(q):
        return mw.evaluate_joints(task, q, check_collision=False).beta

    least, q, random = weakest(masses, robot.q_min, robot.q_max, options.samples, np.random.default_rng(1))
    answer = mw.evaluate_joints(task, q, check_collision=False)
    print(f"weakest  {least:.3f} kg at {' '.join(f'{x:.3f}' for x in q)}")
    print("tool     " + " ".join(f"{x:.3f}" for x in answer.end_effector[:3, 3]))
    if not answer.has_value:
        print("  does not hold its own weight")
    else:
        for name, u, limit in zip(robot.actuator_names, answer.u, robot.u_max):
            print(f"  {name:<24} {u:9.3f} of {limit:g} N m")
    for share in (1, 5, 50, 95):
        print(f"{share:2} % of random postures hold less than {np.percentile(random, share):.3f} kg")


if __name__ == "__main__":
    main()
