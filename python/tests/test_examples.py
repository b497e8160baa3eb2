"""The examples run with small settings, and print what they find."""

import os
import pathlib
import re
import subprocess
import sys

import maxwrench as mw
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
