"""The paper's torque with two contacts: an arm pushes on a wall while the other turns a rigid bar.

python3 paper_dual_arm.py [--budget N]   N: evaluations of each search
"""

import argparse

import maxwrench as mw

TANK = {"one contact": 23, "default contact": 26, "best contact": 30}  # N m, measured in the paper


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--budget", type=int, default=20000)
    budget = parser.parse_args().budget
    alone, wall = mw.load("dual_arm/bar_alone"), mw.load("dual_arm/bar_wall")
    searched = [mw.solve(wall, search=search, budget=budget) for search in ("grid+cmaes", "annealing+cmaes")]
    answers = {
        "one contact": mw.evaluate(alone, alone.theta_r_default),
        "default contact": mw.evaluate(wall, wall.theta_r_default),
        "best contact": max(searched, key=lambda answer: answer.beta),
    }
    one = answers["one contact"]
    print("                     ours     tank  ours gain  tank gain    regrasp [m]")
    for name, answer in answers.items():
        gain, tank_gain = answer.beta / one.beta - 1, TANK[name] / TANK["one contact"] - 1
        print(
            f"{name:<16} {answer.beta:8.3f}  {TANK[name]:7.1f}  {100 * gain:+8.1f} %  {100 * tank_gain:+6.1f} %    "
            f"[{', '.join(f'{x:.4f}' for x in answer.theta_r)}]"
        )


if __name__ == "__main__":
    main()
