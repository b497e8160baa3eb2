"""The paper's experiments in time: the torque throughout a turn, and the peak torque of an impulse.

python3 paper_motion.py [--budget N]   N: evaluations of each search

This is the scheme spline of `maxwrench reproduce`, which prints the others, too. fixed, static: the
default posture throughout; between: the value between knots; reading: in the virtual tank.
"""

import argparse

import maxwrench as mw

# task, title, names of the rows, the paper's tank [N m]
TABLES = [
    ("uvms/valve_trajectory", "torque throughout a turn by 180 degrees in 5 s", ("fixed", "optimised"), (16, 19)),
    ("uvms/valve_impulse", "peak torque in an impulse of 2.5 s", ("static", "impulse"), (25, 35)),
]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--budget", type=int, default=5000)
    budget = parser.parse_args().budget
    for name, title, rows, tank in TABLES:
        task = mw.load(name)
        answers = (mw.evaluate(task, task.theta_r_default), mw.solve(task, budget=budget))
        experiments = [mw.simulate(answer) for answer in answers]
        print(f"{name}: {title}, {task.unit}")
        print("found_by     value  between  reading held   tank  gain: value reading   tank")
        for row, answer, experiment, measured in zip(rows, answers, experiments, tank):
            gains = (
                answer.beta / answers[0].beta,
                experiment.reading / experiments[0].reading,
                measured / tank[0],
            )
            held = "yes" if experiment.held else "no"
            print(
                f"{row:<9} {answer.beta:8.2f} {answer.between_knots:8.2f} {experiment.reading:8.2f} {held:>4}  "
                f"{measured:5.1f}       {gains[0]:6.2f}  {gains[1]:6.2f} {gains[2]:6.2f}"
            )


if __name__ == "__main__":
    main()
