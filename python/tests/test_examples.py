"""The examples run with small settings, and print what they find."""

import gzip
import os
import pathlib
import re
import subprocess
import sys

import maxwrench as mw
import numpy as np
import pytest

FOLDER = pathlib.Path(__file__).parents[2] / "examples" / "python"
pytestmark = pytest.mark.skipif(not FOLDER.is_dir(), reason="the package is tested without the sources")


def run(tmp_path, script, *words):
    package = pathlib.Path(mw.__file__).parents[1]
    process = subprocess.run(
        [sys.executable, FOLDER / script, *words],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(package), "MPLCONFIGDIR": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert process.returncode == 0, process.stderr
    assert process.stderr == ""
    return process.stdout


def numbers(line):
    return [float(text) for text in re.findall(r"[-+]?\d+\.?\d*(?:e[-+]\d+)?", line)]


def rows(text):
    """The numbers of each line by its first word or words, without those in the words."""
    found = re.findall(r"^(.*?)\s\s+([-\d].*)$", text, re.MULTILINE)
    return {name.strip(): numbers(line) for name, line in found}


def test_every_example_is_run():
    tested = set(re.findall(r'run\(tmp_path, "(.*?)"', pathlib.Path(__file__).read_text()))
    assert tested == {path.name for path in FOLDER.glob("*.py")}


def test_planar(tmp_path):
    text = run(tmp_path, "paper_planar.py", "--budget", "300")
    lines = [line for line in text.splitlines() if line.startswith("beta")]
    assert len(lines) == 12
    # Branch and bound proves 1.9094, 3.4810 and 3.8845 N (results/planar.txt).
    for symbol, bound in (("beta_1", 1.9094), ("beta_2", 3.4810), ("beta_3", 3.8845)):
        values = [float(line.split()[2]) for line in lines if line.startswith(symbol)]
        assert all(0.9 * bound < value <= bound for value in values)


def test_uvms(tmp_path):
    text = run(tmp_path, "paper_uvms.py", "--budget", "2000")
    valve, lift = (rows(part) for part in text.split("uvms/lift"))
    # Proven bounds of results/uvms_static.txt; the virtual tank is asked for 0.5 % less.
    for table, bounds in ((valve, (16.60, 35.44, 96.88)), (lift, (4.30, 11.06))):
        for i, bound in enumerate(bounds, 1):
            own, virtual = table[f"beta_{i}"][0], table[f"beta_{i}"][2]
            assert 0.95 * bound < own <= bound and virtual == pytest.approx(0.995 * own, rel=0.01)
    assert valve["default"][0] == pytest.approx(9, abs=0.005)


def test_dual_arm(tmp_path):
    table = rows(run(tmp_path, "paper_dual_arm.py", "--budget", "1000"))
    one, default, best = (table[f"{name} contact"][0] for name in ("one", "default", "best"))
    assert one < default < best <= 37.982  # the proven bound of results/dual.txt


def test_motion(tmp_path):
    table = rows(run(tmp_path, "paper_motion.py", "--budget", "400"))
    assert table["optimised"][0] > table["fixed"][0] and table["impulse"][0] > table["static"][0]
    assert table["fixed"][2] == pytest.approx(0.995 * table["fixed"][0], rel=0.01)


def test_own_robot(tmp_path):
    text = run(tmp_path, "own_robot.py")
    assert re.search(r"^lift: \d+\.\d N at Pose", text, re.MULTILINE)
    assert (tmp_path / "own_robot.png").stat().st_size > 10000


def test_thruster_sweep(tmp_path):
    text = run(tmp_path, "thruster_sweep.py", "--sizes", "4", "--budget", "1000")
    betas = [numbers(line)[1] for line in text.splitlines() if line.startswith("thrusters")]
    assert len(betas) == 4 and betas == sorted(betas)
    # Branch and bound proves at most 35.44 N m for size 1; the first size is 0.25, the second 1.17.
    assert betas[0] < 35.44
    assert (tmp_path / "thruster_sweep.png").stat().st_size > 5000


def test_robust_postures(tmp_path):
    tasks = [str(FOLDER.parent / "tasks" / f"{name}_guaranteed.toml") for name in ("turn", "lift")]
    run(tmp_path, "robust_postures.py", *tasks, "--draws", "300", "--seeds", "1", "--budget", "3000", "--out", str(tmp_path))
    table = [line.split(",") for line in (tmp_path / "robust_postures.csv").read_text().splitlines()]
    robust, nominal = ([dict(zip(table[0], row)) for row in table[i::2]] for i in (1, 2))
    # The proven bounds of both tasks with this uncertainty, and nominal: docs/algorithms/scenarios.md, results/uvms_static.txt.
    for row, bound in zip(robust, (35.11, 104.5)):
        assert 0.9 * bound < float(row["guaranteed"]) == float(row["worst"]) <= bound
        assert row["below"] == row["infeasible"] == "0"
    for row, best in zip(nominal, robust):
        assert float(row["nominal"]) >= 0.99 * float(best["nominal"])
        assert int(row["drawn"]) == 300 and float(row["least"]) >= float(row["worst"])
    assert (tmp_path / "robust_postures.svg").stat().st_size > 5000


def test_race(tmp_path):
    table = rows(run(tmp_path, "race_scipy.py", "planar/force", "--budget", "1000", "--seeds", "2"))
    assert len(table) == 6
    for name, (worst, median, best, _, used) in table.items():
        assert 3.2 < worst <= median <= best < 3.4811  # proven
        assert used == 1000 if name.startswith("SciPy") else used <= 1000


def test_weakest_posture(tmp_path):
    text = run(tmp_path, "weakest_posture.py", "--samples", "300")
    # The maker promises 3 kg in any posture; joint 2 is strong enough for no more than 87 N m.
    assert 3 < numbers(text.splitlines()[0])[0] < 3.6
    assert re.search(r"panda_joint2 +-?8[67]\.\d+ of 87", text)
    # With a tenth of its effort this joint does not hold the arm.
    text = run(tmp_path, "weakest_posture.py", "--samples", "300", "--effort", "panda_joint2=8.7")
    assert numbers(text.splitlines()[0])[0] == 0 and "does not hold its own weight" in text


def test_one_posture(tmp_path):
    urdf = FOLDER.parents[1] / "tests/data/robots/panda/panda.urdf"
    text = run(tmp_path, "one_posture.py", urdf, "panda_hand_tcp", "--points", "4", "--budget", "400")
    assert text.count("gain: median") == 1
    pairs = re.findall(r"one +([\d.]+) kg  best +([\d.]+|nan) kg", text)
    assert len(pairs) >= 4
    # The tool of the one posture is within 1 mm of the point.
    assert sum(float(best) >= 0.99 * float(one) for one, best in pairs) >= 0.8 * len(pairs)


def test_panda_payload(tmp_path):
    # Maps that found nothing: all masses are those of random postures.
    with gzip.open(tmp_path / "map.csv.gz", "wt") as file:
        file.write("i_x,i_z,beta\n" + "".join(f"{i},{j},\n" for i in range(10) for j in range(19)))
    maps = ["--any", str(tmp_path), "--down", str(tmp_path)]
    text = run(tmp_path, "panda_payload.py", *maps, "--samples", "20000", "--boxes", "60000")
    assert 3 < numbers(text.splitlines()[0])[0] < 3.7
    for line in text.splitlines():
        if re.match(r"  +(9|12|20) ", line):
            _, best, none, undecided, one = numbers(line)
            assert best + none + undecided == pytest.approx(100, abs=0.2)
            assert one <= best + 15
    assert (tmp_path / "panda_payload.csv").read_text().count("\n") == 191
    assert "best posture, tool down" in (tmp_path / "panda_payload.svg").read_text()


def test_ring_proof(tmp_path):
    text = run(tmp_path, "ring_proof.py", "--mass", "20", "--boxes", "600000")
    proven = int(re.search(r"^(\d+) of 264 rings proven", text, re.MULTILINE)[1])
    # Far rings are beyond the arm's reach of 0.95 m from 0.333 m above the floor, near ones are not.
    assert proven >= 10
    grid = [line.split()[-1] for line in text.splitlines() if re.match(r" +-?\d\.\d\d m  ", line)]
    assert len(grid) == 22 and all(row[3] == "?" for row in grid[8:14])


def test_proof_times(tmp_path):
    urdf = FOLDER.parents[1] / "tests/data/robots/panda/panda.urdf"
    text = run(tmp_path, "proof_times.py", urdf, "panda_hand_tcp", "--poses", "3", "--gap", "0.1", "--seconds", "5", "--out", "times.csv")
    assert re.search(r"^panda: \d of 3 poses proven to 10 % within 5 s$", text, re.MULTILINE)
    table = [line.split(",") for line in (tmp_path / "times.csv").read_text().splitlines()]
    assert table[0][:6] == ["pose", "beta", "bound", "gap", "boxes", "status"] and len(table) == 4
    for _, beta, bound, gap, boxes, status, *_ in table[1:]:
        assert 0 < float(beta) <= float(bound) and int(boxes) > 0
        assert (status == "proven") == (float(gap) <= 0.1)


@pytest.fixture
def proof():
    sys.path.insert(0, str(FOLDER))
    yield __import__("ring_proof")
    sys.path.remove(str(FOLDER))


def test_boxes_of_a_proof_hold_their_postures(proof):
    """Radius, height and efforts of postures in boxes, from the package's model, are within the boxes' enclosures."""
    task = mw.Static(mw.Robot.from_urdf(proof.PANDA, tool="panda_hand_tcp"), c="z")
    chain, rng = proof.Chain(proof.PANDA, "panda_hand_tcp"), np.random.default_rng(2)
    lower, upper = chain.limits()
    centre = rng.uniform(lower, upper, (400, 5))
    half = rng.uniform(0, 0.25, (400, 1)) * rng.uniform(0, 1, (400, 5))
    q = np.clip(centre + half * rng.uniform(-1, 1, (400, 5)), lower, upper)
    q[::2] = np.clip(centre + half * rng.choice([-1, 1], (400, 5)), lower, upper)[::2]  # corners
    (near, far), (low, high), slope, _, _ = proof.Enclosure(chain, 9).evaluate(centre, half)
    ends = [rng.uniform(-2.8, 2.8, 400), rng.uniform(-2.8, 2.8, 400)]
    full = np.column_stack([ends[0], q, ends[1]])
    masses = mw.evaluate_joints(task, full, check_collision=False).beta / proof.G
    held = 0
    for i in range(400):
        X = mw.evaluate_joints(task, full[i], check_collision=False).end_effector
        assert near[i] <= np.hypot(*X[:2, 3]) <= far[i]
        assert low[i] <= X[2, 3] <= high[i]
        assert slope[i] <= X[2, 2]
        # A box whose efforts do not suffice for a mass has no posture that holds it.
        mass = masses[i] * 0.999
        enclosure = proof.Enclosure(chain, mass)
        assert enclosure.evaluate(centre[i : i + 1], half[i : i + 1])[3][0]
        # And a small box around a posture that holds far less is refuted.
        small = np.full((1, 5), 1e-4)
        held += not proof.Enclosure(chain, 1.1 * masses[i]).evaluate(q[i : i + 1], small)[3][0]
    assert held > 350


def test_a_proof_leaves_rings_that_hold_the_mass(proof):
    chain, rng = proof.Chain(proof.PANDA, "panda_hand_tcp"), np.random.default_rng(3)
    radii, heights = np.linspace(0, 1.5, 16), np.linspace(-1, 1.8, 29)
    mass, radius, height, slope = proof.held_mass(chain, rng.uniform(*chain.limits(), (50_000, 5)))
    holds = {tilt: np.zeros((15, 28), bool) for tilt in (None, 0.3)}
    for tilt, cells in holds.items():
        fits = (mass >= 12) & (True if tilt is None else slope <= -np.cos(tilt))
        cells[np.digitize(radius[fits], radii) - 1, np.digitize(height[fits], heights) - 1] = True
        empty = proof.refute(chain, 12, radii, heights, np.ones(cells.shape, bool), tilt, 300_000)
        assert cells.any() and empty.any()
        assert not (cells & empty).any()


def test_shares_of_the_panda_are_those_of_its_rings():
    """The table of results/, docs/studies.md and the README, from the rings of the CSV."""
    root = FOLDER.parents[1]
    rings = np.genfromtxt(root / "results/panda_payload.csv", delimiter=",", names=True)
    table = re.findall(r"^ +(9|12|20) +(.*)$", (root / "results/panda_payload.txt").read_text(), re.MULTILINE)
    assert len(table) == 6
    page = (root / "docs/studies.md").read_text()
    for n, (mass, shares) in enumerate(table):
        kind = "any" if n < 3 else "down"
        best, cannot = rings[f"{kind}_kg"], rings[f"{kind}_cannot_kg"]
        volume = rings["radius"] * np.isfinite(best)  # of a ring: 2 pi radius times its section
        held = 100 * volume[best >= float(mass)].sum() / volume.sum()
        none = 100 * volume[cannot <= float(mass)].sum() / volume.sum()
        assert numbers(shares)[:2] == [pytest.approx(held, abs=0.051), pytest.approx(none, abs=0.051)]
        assert f" {held:.1f} " in page and f" {none:.1f} " in page
        assert not (best >= cannot).any()
    readme = (root / "README.md").read_text()
    assert f"{numbers(table[0][1])[0]:.0f} % of the workspace" in readme and f"in {numbers(table[0][1])[1]} % it is proven" in readme
