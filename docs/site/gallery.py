"""The gallery: each shipped robot with a picture, its tasks, and their default and best values."""

import pathlib
import subprocess

import maxwrench as mw
import results

COMMAND = pathlib.Path(__file__).resolve().parents[2] / "build/maxwrench"


def plot(task, source):
    """The picture that the command draws; its path from the sources of the site."""
    path = pathlib.Path("figures/gallery") / f"{task.replace('/', '_')}.svg"
    (source / path).parent.mkdir(parents=True, exist_ok=True)
    subprocess.run([COMMAND, "plot", task, "--best", "--out", source / path], check=True, capture_output=True)
    return path


def view(task, extra):
    """The page that the command makes; its address from the root of the site."""
    path = pathlib.Path("gallery") / f"{task.replace('/', '_')}.html"
    (extra / path).parent.mkdir(parents=True, exist_ok=True)
    subprocess.run([COMMAND, "view", task, "--out", extra / path], check=True, capture_output=True)
    return path


def number(value):
    return "-" if value is None or value != value else f"{value:.4g}"


def kind(task):
    return {"static": "one posture"}.get(task.type, task.type)


def row(name):
    task = mw.load(name)
    default = mw.evaluate(task, task.theta_r_default).beta
    best = [results.best(name, wrench=wrench) or mw.solve(task, wrench=wrench, callback=False).beta for wrench in ["pure", "any"]]
    values = " | ".join(number(value) for value in [default, *best])
    return f"| `{name}` | {kind(task)} | {len(task.theta_r_names)} | {task.unit} | {values} |"


def section(robot, names, source, extra):
    static = next(name for name in names if mw.load(name).type == "static")
    family = static.split("/")[0]
    lines = [f"## {robot}", "",
             f"<a href=\"{view(static, extra)}\">Turn it in three dimensions</a>, with its efforts and wrenches (`maxwrench view {static}`). "
             f"Its model and sources are in [problems/{family}](problems/{family}/README.md). `maxwrench plot {static} --best` draws it:", "",
             f"![{robot} in its default posture and in its best one]({plot(static, source)})", ""]
    lines += ["| task | of | redundancy | unit | default posture | best, pure | best, any wrench |", "|---|---|---|---|---|---|---|", *map(row, names), ""]
    return "\n".join(lines)


def pages(source, extra):
    robots = {}
    for name in mw.tasks():
        robots.setdefault(mw.load(name).robot.name, []).append(name)
    families = sorted({name.split("/")[0] for name in mw.tasks()})
    intro = ("# Gallery\n\nThe shipped robots and their tasks. Values are those of `linf_polytope`: at the default posture, computed now, "
             "and the best that any search of the benchmark found (the default search, where the recorded benchmark has no row), with the wrench "
             "along c alone (pure) and with other components free (any).\n\n")
    tree = "\n".join(["```{toctree}", ":hidden:", "", *(f"problems/{family}/README.md" for family in families), "```", ""])
    return {"gallery.md": intro + "\n".join(section(robot, names, source, extra) for robot, names in robots.items()) + tree}
