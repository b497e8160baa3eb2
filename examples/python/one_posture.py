"""How much more the best posture holds than one inverse kinematics solution per point.

python3 one_posture.py [URDF TOOL] [--points N] [--budget N]

The rule of pal-robotics/dynamic_payload_analysis is repeated in `one_posture` and `bisected`: the joints move from zero until
the tool is at a point, whatever its orientation, and the payload of that posture is bisected. Beside it `solve` searches the
best posture of each point. Without arguments: the Franka Panda and the UR10 of problems/gallery.
"""

import argparse
import pathlib
import time

import maxwrench as mw
import numpy as np

GALLERY = pathlib.Path(__file__).parents[2] / "problems" / "gallery"
DESCRIPTIONS = "example-robot-data/robots/{}_description/urdf/{}.urdf"
ROBOTS = {
    "panda": (GALLERY / "panda" / DESCRIPTIONS.format("panda", "panda"), "panda_hand_tcp"),
    "ur10": (GALLERY / "ur10" / DESCRIPTIONS.format("ur", "ur10_robot"), "tool0"),
}
G = 9.81  # m/s^2


def one_posture(task, point):
    """The joints that put the tool at a point, from zero, within their limits; None: no convergence."""
    lower, upper = task.robot.q_min, task.robot.q_max
    q = np.clip(np.zeros(len(lower)), lower, upper)
    for _ in range(500):
        here = mw.evaluate_joints(task, q, check_collision=False)
        error, J = point - here.end_effector[:3, 3], here.J[:3]
        if np.linalg.norm(error) < 1e-3:
            return q
        q = np.clip(q + 0.1 * J.T @ np.linalg.solve(J @ J.T + 1e-9 * np.eye(3), error), lower, upper)
    return None


def bisected(task, q, most=1e3):
    """The mass [kg] at the tool that posture q holds, to 0.001 kg; None: it collides or does not hold itself."""
    here = mw.evaluate_joints(task, q)
    if not here.has_value:
        return None
    low, high, robot = 0.0, most, task.robot
    while high - low > 1e-3:
        mass = (low + high) / 2
        # The balance B u = tau_d + J'h of a fixed arm, whose B is the identity.
        u = here.tau_d + here.J.T @ [0, 0, mass * G, 0, 0, 0]
        low, high = (mass, high) if ((u >= robot.u_min) & (u <= robot.u_max)).all() else (low, mass)
    return low


def compare(name, urdf, tool, count, budget):
    robot = mw.Robot.from_urdf(urdf, tool=tool)
    task = mw.Static(robot, c="z", free=["roll", "pitch", "yaw"])
    origin = task.pose.p
    reach = max(1.0, 1.2 * np.linalg.norm(origin))
    axis = np.linspace(-reach, reach, count)
    points = [np.array([x, y, z]) for x in axis for y in axis for z in axis if z > 0]
    start = time.process_time()
    found = [(point, q) for point in points if (q := one_posture(task, point)) is not None]
    one = [(point, mass) for point, q in found if (mass := bisected(task, q))]
    one_s = time.process_time() - start

    start = time.process_time()
    best = []
    for point, _ in one:
        here = mw.Static(robot, c="z", pose=mw.Pose(point), free=["roll", "pitch", "yaw"])
        best.append(mw.solve(here, search="facet_sqp", budget=budget, threads=1).beta / G)
    best_s = time.process_time() - start
    gain = np.array(best) / [mass for _, mass in one]
    print(f"{name}: {len(points)} points, {len(found)} with an IK solution, {len(one)} of these hold themselves")
    for (point, mass), most in zip(one, best):
        print(f"  {point[0]:6.2f} {point[1]:6.2f} {point[2]:6.2f} m  one {mass:8.3f} kg  best {most:8.3f} kg")
    print(f"  gain: median {np.nanmedian(gain):.2f}, quartiles {np.nanquantile(gain, 0.25):.2f} {np.nanquantile(gain, 0.75):.2f}")
    print(f"  less than one posture holds, or none found: {np.sum(~(gain >= 1 - 1e-3))} points")
    print(f"  processor time a point: one posture {one_s / len(points):.4f} s, best posture {best_s / max(1, len(one)):.3f} s")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("robot", nargs="*", metavar="URDF TOOL")
    parser.add_argument("--points", type=int, default=6, help="points along each axis")
    parser.add_argument("--budget", type=int, default=3000, help="evaluations of each best posture")
    options = parser.parse_args()
    robots = {pathlib.Path(options.robot[0]).stem: options.robot} if len(options.robot) == 2 else ROBOTS
    for name, (urdf, tool) in robots.items():
        compare(name, urdf, tool, options.points, options.budget)


if __name__ == "__main__":
    main()
