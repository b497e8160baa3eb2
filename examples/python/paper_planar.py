"""The paper's planar example: the largest forces by three measures, as `maxwrench reproduce` prints them.

python3 paper_planar.py [--budget N]   N: at most so many evaluations for each row
"""

import argparse

import maxwrench as mw

# symbol, the paper's value [N], measure, wrench, solvers of the lower level
VALUES = [
    ("beta_1", 1.91, "ellipsoid", "pure", ["none"]),
    ("beta_2", 3.47, "linf_polytope", "pure", ["facets", "simplex", "ipopt"]),
    ("beta_3", 3.88, "linf_polytope", "any", ["simplex", "ipopt"]),
]
BUDGETS = {"grid+cmaes": 400000, "annealing+cmaes": 40000}
IPOPT_BUDGET = 3000  # an interior point solve takes a thousand times as long


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--budget", type=int, default=max(BUDGETS.values()))
    most = parser.parse_args().budget
    task = mw.load("planar/force")
    print("         paper      ours  deviation  solver   search           evaluations   gap")
    for symbol, paper, measure, wrench, solvers in VALUES:
        for solver in solvers:
            for search, usual in BUDGETS.items():
                budget = min(most, IPOPT_BUDGET if solver == "ipopt" else usual)
                answer = mw.solve(
                    task,
                    measure=measure,
                    wrench=wrench,
                    solver=solver,
                    search=search,
                    budget=budget,
                )
                print(
                    f"{symbol}  {paper:6.2f}  {answer.beta:8.4f}  {100 * (answer.beta / paper - 1):+8.2f} %  "
                    f"{solver:<7}  {search:<15}  {answer.evaluations:11}   {answer.residual['gap']:.1e}"
                )


if __name__ == "__main__":
    main()
