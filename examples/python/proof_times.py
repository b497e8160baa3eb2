"""How long a proof of the best posture takes at random reachable poses of an arm.

python3 proof_times.py [URDF TOOL] [--poses N] [--c AXIS] [--gap G] [--seconds S] [--seed N] [--out FILE.csv]

A pose is that of the tool in a random posture: joints uniform between their limits, within pi, without collision. A posture
that does not hold its own weight is drawn again. Each proof has one thread, and its seconds are those of the clock. Without arguments: the Kinova Gen3 of problems/gallery.
"""

import argparse
import csv
import pathlib
import time

import maxwrench as mw
import numpy as np

GEN3 = pathlib.Path(__file__).parents[2] / "problems" / "gallery" / "gen3"
DRAWS = 1000  # of which one must hold its own weight
COLUMNS = ("pose", "beta", "bound", "gap", "boxes", "status", "search_s", "proof_s")


def chain(robot):
    """The joints between base and tool, as indices."""
    joints, link = [], robot.end_effector_links[0]
    while link > 0:
        joints.insert(0, link - 1)
        link = robot.parents[link - 1]
    return joints


def drawn_task(robot, c, rng):
    """A task at the pose of a random posture."""
    moved = chain(robot)
    lower, upper = np.maximum(robot.q_min[moved], -np.pi), np.minimum(robot.q_max[moved], np.pi)
    for _ in range(DRAWS):
        joints = dict(zip([robot.joint_names[i] for i in moved], rng.uniform(lower, upper)))
        try:
            task = mw.Static(robot, c=c, joints=joints)
        except ValueError as error:  # such as a pose at which the arm is singular
            why = str(error)
            continue
        answer = mw.evaluate(task, task.theta_r_default)
        if answer.has_value:
            return task
        why = answer.reason
    raise SystemExit(f"{robot.name}: none of {DRAWS} drawn postures holds its own weight; the last one: {why}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("robot", nargs="*", metavar="URDF TOOL")
    parser.add_argument("--poses", type=int, default=20)
    parser.add_argument("--c", default="z")
    parser.add_argument("--gap", type=float, default=1e-3)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=pathlib.Path)
    options = parser.parse_args()
    if len(options.robot) == 2:
        robot = mw.Robot.from_urdf(options.robot[0], tool=options.robot[1])
    elif options.robot:
        parser.error(f"got {len(options.robot)} of the words URDF and TOOL, expected both or none")
    else:
        robot = mw.Robot.from_toml(GEN3 / "robot.toml")
    rng = np.random.default_rng(options.seed)
    rows = []
    for i in range(options.poses):
        task = drawn_task(robot, options.c, rng)
        start = time.perf_counter()
        proof = mw.certify(task, gap=options.gap, seconds=options.seconds, threads=1)
        total = time.perf_counter() - start
        rows.append((i, proof.beta, proof.bound, proof.gap, proof.boxes, proof.status, total - proof.seconds, proof.seconds))
    if options.out:
        with options.out.open("w", newline="") as file:
            csv.writer(file).writerows([COLUMNS, *rows])
    seconds = np.array([row[7] for row in rows])
    proven = np.array([row[5] == "proven" for row in rows])
    searches = np.array([row[6] for row in rows])
    print(f"{robot.name}: {proven.sum()} of {len(rows)} poses proven to {100 * options.gap:g} % within {options.seconds:g} s")
    print(f"proof  s  median {np.median(seconds):.2f}, 90 % {np.quantile(seconds, 0.9):.2f}, longest {seconds.max():.2f}")
    print(f"search s  median {np.median(searches):.2f}, longest {searches.max():.2f}")
    if not proven.all():
        print(f"largest gap {100 * max(row[3] for row in rows):.3g} %")


if __name__ == "__main__":
    main()
