"""How the largest torque of the underwater vehicle grows with its thrusters: 200 searches, side by side.

python3 thruster_sweep.py [--sizes N] [--budget N] [--out FILE]

`solve` lets go of Python's lock, so threads use all cores. Each search has one thread.
"""

import argparse
import os
from concurrent.futures import ThreadPoolExecutor

import matplotlib
import maxwrench as mw
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=int, default=200)
    parser.add_argument("--budget", type=int, default=8000)
    parser.add_argument("--out", default="thruster_sweep.png")
    options = parser.parse_args()

    task = mw.load("uvms/valve")
    robot = task.robot
    thrusters = np.arange(len(robot.actuator_names)) < len(robot.thruster_names)

    def best(size):
        """beta_2 with thrusters of that size [N m]."""
        factor = np.where(thrusters, size, 1)
        resized = task.with_limits(factor * robot.u_min, factor * robot.u_max)
        return mw.solve(resized, budget=options.budget, threads=1).beta

    sizes = np.linspace(0.25, 3, options.sizes)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        betas = np.array(list(pool.map(best, sizes)))

    for size, beta in list(zip(sizes, betas))[:: max(1, options.sizes // 10)]:
        print(f"thrusters x {size:5.2f}: {beta:7.3f} N m")
    figure, ax = plt.subplots(constrained_layout=True)
    ax.plot(sizes, betas, color="#0072B2")
    ax.set(xlabel="size of the thrusters [today's]", ylabel="beta_2 [N m]", title="uvms/valve", ylim=(0, None))
    ax.grid(alpha=0.3)
    figure.savefig(options.out)
    print("picture:", options.out)


if __name__ == "__main__":
    main()
