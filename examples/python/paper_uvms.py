"""The paper's underwater vehicle, static: its torques and lifts in the postures of three measures.

python3 paper_uvms.py [--budget N]   N: evaluations of each search

own: value of the measure; pure: the largest wrench along c alone that any efforts reach at that
posture; virtual: the mean reading in the virtual tank; tank: measured in the paper; gain over the
default posture: of pure (for beta_3 of own, because the tank's sensor took all other components),
and in the tank. Lifts are in kg; for them, `maxwrench reproduce` loads the virtual tank kilogram by
kilogram.
"""

import argparse

import maxwrench as mw

# task, title, unit of the table, tank at the default posture, (symbol, measure, wrench, tank)
TABLES = [
    (
        "uvms/valve",
        "torque about the vertical, N m",
        1,
        9,
        [("beta_1", "ellipsoid", "pure", 19.5), ("beta_2", "linf_polytope", "pure", 25), ("beta_3", "linf_polytope", "any", 76)],
    ),
    ("uvms/lift", "upward force, kg of 9.81 N", 9.81, 4, [("beta_1", "ellipsoid", "pure", 7), ("beta_2", "linf_polytope", "pure", 10)]),
]
SEARCHES = [("grid+cmaes", 1), ("annealing+cmaes", 1), ("annealing+cmaes", 2), ("annealing+cmaes", 3)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--budget", type=int, default=200000)
    budget = parser.parse_args().budget
    for name, title, unit, tank_default, rows in TABLES:
        task = mw.load(name)
        default = mw.evaluate(task, task.theta_r_default)
        print(f"{name}: {title}\n              own     pure  virtual   tank    ours   tank  theta_r")
        print(line("default", default, default, default, unit, tank_default, tank_default))
        for symbol, measure, wrench, tank in rows:
            choice = {"measure": measure, "wrench": wrench, "budget": budget}
            answers = [mw.solve(task, search=search, seed=seed, **choice) for search, seed in SEARCHES]
            best = max(answers, key=lambda answer: answer.beta if answer.has_value else 0)
            print(line(symbol, best, mw.evaluate(task, best.theta_r), default, unit, tank, tank_default))


def line(symbol, own, pure, default, unit, tank, tank_default):
    experiment = mw.simulate(own)
    virtual = f"{experiment.reading / unit:8.2f}" if experiment.held else "    lost"
    gain = (own if symbol == "beta_3" else pure).beta / default.beta
    return (
        f"{symbol:<8} {own.beta / unit:8.2f} {pure.beta / unit:8.2f} {virtual}  {tank:5.1f}  {gain:6.2f} "
        f"{tank / tank_default:6.2f} " + "".join(f" {angle:7.4f}" for angle in own.theta_r)
    )


if __name__ == "__main__":
    main()
