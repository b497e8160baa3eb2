"""What a Panda holds beyond its rating of 3 kg, ring by ring of its workspace: in the best posture, and in just one.

python3 panda_payload.py [--any FOLDER --down FOLDER] [--budget N] [--samples N] [--boxes N] [--out PREFIX]

The folders are those of `maxwrench map` with examples/tasks/panda_payload.toml and panda_payload_down.toml; without them the
maps are computed here. Random postures improve the rings; each value is that of a posture which the package has evaluated,
collisions included. `ring_proof.py` proves rings that no posture can load.
"""

import argparse
import csv
import gzip
import pathlib

import matplotlib
import maxwrench as mw
import numpy as np
from ring_proof import G, Chain, held_mass, refute
from weakest_posture import weakest

matplotlib.use("Agg")
matplotlib.rcParams.update({"svg.hashsalt": "maxwrench", "svg.fonttype": "none"})

ROOT = pathlib.Path(__file__).parents[2]
URDF = ROOT / "problems/gallery/panda/example-robot-data/robots/panda_description/urdf/panda.urdf"
TASKS = {"any": "panda_payload.toml", "down": "panda_payload_down.toml"}
TILT = {"any": None, "down": np.radians(15)}
RADII, HEIGHTS = np.linspace(0, 1, 11), np.linspace(-0.6, 1.3, 20)  # edges of the rings [m]
OVER = {"x": (-0.45, 0.45, 10), "z": (-0.95, 0.85, 19)}  # their middles, from the pose of the tasks, x 0.5 and z 0.4
MASSES = (9, 12, 20)  # kg: three, four and nearly seven times the rating
READY = np.array([0, -0.25, 0, -0.75, 0, 0.5, 0.25]) * np.pi
CERTAINLY_LESS = 0.85  # only rings whose best known mass is below this share of a mass are tried in a proof


def evaluated(task, q, **options):
    """The answer in postures of the arm (7) or (N, 7), the fingers closed."""
    robot = task.robot
    joints = np.zeros((*np.shape(q)[:-1], len(robot.joint_names)))
    joints[..., [robot.joint_names.index(f"panda_joint{k}") for k in range(1, 8)]] = q
    return mw.evaluate_joints(task, joints, **options)


def mapped(task, folder, budget):
    """The best masses of a map [kg] (R, Z); NaN: none was found."""
    if folder is None:
        return mw.map(task, OVER, budget=budget).grid / G
    values = np.full((len(RADII) - 1, len(HEIGHTS) - 1), np.nan)
    with gzip.open(pathlib.Path(folder) / "map.csv.gz", "rt") as file:
        for row in csv.DictReader(file):
            values[int(row["i_x"]), int(row["i_z"])] = float(row["beta"] or "nan") / G
    return values


def sampled(task, chain, values, count, rng):
    """Improves the masses of both kinds of rings by random postures, in each ring the three that seem best."""
    lower, upper = chain.limits()
    best = {kind: np.zeros((3, *values[kind].shape)) for kind in values}
    postures = {kind: np.zeros((3, *values[kind].shape, 7)) for kind in values}
    for _ in range(0, count, 100_000):
        q = rng.uniform(lower, upper, (min(count, 100_000), len(lower)))
        mass, radius, height, slope = held_mass(chain, q)
        i, j = np.digitize(radius, RADII) - 1, np.digitize(height, HEIGHTS) - 1
        inside = (i < len(RADII) - 1) & (j >= 0) & (j < len(HEIGHTS) - 1)
        for kind, tilt in TILT.items():
            fits = np.flatnonzero(inside if tilt is None else inside & (slope <= -np.cos(tilt)))
            fits = fits[mass[fits] > best[kind][0, i[fits], j[fits]]]
            for n in fits[np.argsort(mass[fits])]:
                place = (0, i[n], j[n])
                if mass[n] <= best[kind][place]:
                    continue
                for a in (best[kind], postures[kind]):
                    a[1:, i[n], j[n]] = a[:-1, i[n], j[n]]
                best[kind][place], postures[kind][place][1:6] = mass[n], q[n]
    for kind in values:
        kept = best[kind] > 0
        beta = np.full(kept.shape, np.nan)
        beta[kept] = evaluated(task, postures[kind][kept]).beta / G
        values[kind] = np.fmax(values[kind], np.fmax.reduce(beta))
    values["any"] = np.fmax(values["any"], values["down"])
    return values


def one_posture(task, place, down):
    """The mass [kg] that one IK solution holds, from the ready posture by damped least squares; NaN: it did not converge."""
    robot, q = task.robot, READY.copy()
    for _ in range(300):
        answer = evaluated(task, q, check_collision=False)
        X = answer.end_effector
        error, J = place - X[:3, 3], answer.J[:3, :7]
        if down:
            error, J = np.r_[error, np.cross(X[:3, 2], [0, 0, -1])], answer.J[:, :7]
        if np.linalg.norm(error) < 1e-3:
            answer = evaluated(task, q)
            return answer.beta / G if answer.has_value else np.nan
        step = J.T @ np.linalg.solve(J @ J.T + 1e-4 * np.eye(len(J)), error)
        q = np.clip(q + 0.3 * step, robot.q_min[:7], robot.q_max[:7])
    return np.nan


def proven(chain, values, boxes, kind):
    """By mass, the rings in which no posture holds it (R, Z)."""
    empty, known = {}, np.zeros(values.shape, bool)
    for mass in MASSES:
        wanted = (values < CERTAINLY_LESS * mass) & ~known  # NaN: not reached, and not counted
        known = known | refute(chain, mass, RADII, HEIGHTS, wanted, TILT[kind], boxes)
        assert not (known & (values >= mass)).any(), "a ring both holds a mass and is proven not to"
        empty[mass] = known
    return empty


def draw(values, empty, file):
    import matplotlib.pyplot as plt

    colours = ["#d9d9d9", "#f2c14e", "#f78154", "#b4436c", "#5b2333"]  # below 3, 9, 12, 20 kg and above
    panels = {"one": "one posture per ring", "any": "best posture", "down": "best posture, tool down within 15°"}
    figure, axes = plt.subplots(1, 3, figsize=(10.5, 6.7), sharey=True)
    figure.subplots_adjust(left=0.06, right=0.99, top=0.95, bottom=0.13, wspace=0.05)
    for panel, (kind, title) in zip(axes, panels.items()):
        for (i, j), value in np.ndenumerate(values[kind]):
            if not np.isfinite(value):
                continue
            level = int(np.searchsorted((3, *MASSES), value, "right"))
            corner = RADII[i], HEIGHTS[j]
            panel.add_patch(plt.Rectangle(corner, 0.1, 0.1, facecolor=colours[level], edgecolor="white", linewidth=0.5))
            sure = kind in empty and level < 4 and empty[kind][max(9, (3, *MASSES)[level])][i, j]
            panel.text(
                corner[0] + 0.05, corner[1] + 0.05, f"{min(value, 99):.0f}", ha="center", va="center", fontsize=6.5,
                color="white" if level > 2 else "black", weight="bold" if sure else "normal",
            )  # fmt: skip
        panel.set(title=title, xlabel="radius [m]", xlim=(0, 1), ylim=(HEIGHTS[0], HEIGHTS[-1]), aspect="equal")
        panel.title.set_fontsize(9)
        panel.axhline(0, color="black", linewidth=0.6)
    axes[0].set_ylabel("height above the base [m]")
    names = ["below 3 kg", "3 to 9 kg", "9 to 12 kg", "12 to 20 kg", "20 kg and more"]
    patches = [plt.Rectangle((0, 0), 1, 1, color=colour) for colour in colours]
    figure.legend(patches, names, loc="lower center", ncol=5, frameon=False, fontsize=8)
    figure.savefig(file, metadata={"Date": None})


def write(values, empty, file):
    with open(file, "w") as out:
        print("radius,height,one_kg,any_kg,down_kg,any_cannot_kg,down_cannot_kg", file=out)
        for i, j in np.ndindex(values["any"].shape):
            row = [f"{RADII[i] + 0.05:.2f}", f"{HEIGHTS[j] + 0.05:.2f}"]
            row += [f"{v:.4f}" if np.isfinite(v := values[kind][i, j]) else "" for kind in ("one", "any", "down")]
            row += [str(next((m for m in MASSES if empty[kind][m][i, j]), "")) for kind in empty]
            print(",".join(row), file=out)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for kind in TASKS:
        parser.add_argument(f"--{kind}", help="folder of its map")
    parser.add_argument("--budget", type=int, default=3000, help="evaluations of a cell of the coarse grid of the maps")
    parser.add_argument("--samples", type=int, default=3_000_000, help="random postures")
    parser.add_argument("--boxes", type=int, default=20_000_000, help="boxes of each proof")
    parser.add_argument("--out", default="panda_payload", help="writes PREFIX.csv and PREFIX.svg")
    options = parser.parse_args()

    tasks = {kind: mw.load(ROOT / "examples/tasks" / file) for kind, file in TASKS.items()}
    chain, rng = Chain(URDF, "panda_hand_tcp"), np.random.default_rng(1)
    values = {kind: mapped(task, getattr(options, kind), options.budget) for kind, task in tasks.items()}
    values = sampled(tasks["any"], chain, values, options.samples, rng)
    places = np.stack(np.meshgrid((RADII[:-1] + RADII[1:]) / 2, [0], (HEIGHTS[:-1] + HEIGHTS[1:]) / 2, indexing="ij"), -1)
    for kind, name in (("any", "one"), ("down", "one_down")):
        values[name] = np.full(values[kind].shape, np.nan)
        for i, j in zip(*np.isfinite(values[kind]).nonzero()):
            values[name][i, j] = one_posture(tasks["any"], places[i, 0, j], kind == "down")
    empty = {kind: proven(chain, values[kind], options.boxes, kind) for kind in TASKS}

    def masses(q):
        return evaluated(tasks["any"], q, check_collision=False).beta / G

    limits = tasks["any"].robot.q_min[:7], tasks["any"].robot.q_max[:7]
    least = weakest(masses, *limits, options.samples // 30 + 100, rng)[0]
    print(f"weakest posture found: {least:.2f} kg (rated: 3 kg)")
    volume = np.diff(RADII**2)[:, None] * np.ones(values["any"].shape)
    for kind, one in (("any", "one"), ("down", "one_down")):
        reached = np.isfinite(values[kind])
        print(f"{kind}: {reached.sum()} rings reached; share of their volume [%]")
        print("  mass   best posture   proven: none   open   one posture")
        for mass in MASSES:
            share = [
                100 * (volume * (reached & which)).sum() / (volume * reached).sum()
                for which in (values[kind] >= mass, empty[kind][mass], values[one] >= mass)
            ]
            print(f"  {mass:4}   {share[0]:12.1f}   {share[1]:12.1f}   {100 - share[0] - share[1]:4.1f}   {share[2]:11.1f}")
    write(values, empty, f"{options.out}.csv")
    draw(values, empty, f"{options.out}.svg")


if __name__ == "__main__":
    main()
