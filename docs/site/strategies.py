"""The pages of measures, solvers and searches: whether each name of the tables has one, their figures and their measured results."""

import functools
import hashlib
import multiprocessing
import pathlib
import subprocess

import measured
from figures import measures, searches, solvers

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMAND = ROOT / "build/maxwrench"
FAMILIES = {"measures": measures, "solvers": solvers, "searches": searches}


@functools.cache
def tables():
    """The line about each name, by family, as `list` prints them."""
    found, family = {name: {} for name in FAMILIES}, None
    for line in subprocess.run([COMMAND, "list"], check=True, capture_output=True, text=True).stdout.splitlines():
        if not line.startswith(" "):
            family = next((name for name in FAMILIES if name in line), None)
        elif family:
            name, text = line.split(maxsplit=1)
            found[family].setdefault(name, text)
    return found


def require_pages(pages):
    """Each name has a page, and no page is about a name that is gone."""
    for family, names in tables().items():
        written = {page.stem for page in pages if str(page.parent) == f"docs/algorithms/{family}"}
        for name in sorted(set(names) ^ written):
            state = "has no page" if name in names else "is in no table, but has a page"
            raise SystemExit(f"docs/algorithms/{family}/{name}.md: '{name}' {state}")


def figure_of(page, source):
    return source / "figures" / page.parent.name / f"{page.stem}.svg"


def draw(job):
    family, name, path = job
    FAMILIES[family].draw(name, path)


def draw_figures(source):
    """Draws all figures anew if the package, the results or the code of the figures have changed."""
    made_of = [*sorted((ROOT / "build/python/maxwrench").glob("*.so")), *sorted((ROOT / "docs/site").glob("**/*.py")),
               *sorted((ROOT / "results/report").glob("*.csv"))]
    digest = hashlib.sha1(b"".join(path.read_bytes() for path in made_of)).hexdigest()
    known = source / "figures/digest"
    if known.exists() and known.read_text() == digest:
        return
    jobs = [(family, name, figure_of(pathlib.PurePosixPath(family) / name, source)) for family, names in tables().items() for name in names]
    with multiprocessing.Pool() as pool:
        pool.map(draw, jobs, chunksize=1)
    known.write_text(digest)


def completed(page, text):
    """A page of a name, with its line of the table, its figure below the title and what was measured at the end. The page of searches compares stages."""
    family = page.parent.name
    if str(page) == "docs/algorithms/searches.md":
        return text + measured.stages()
    if page.parent.parent.name != "algorithms" or family not in FAMILIES:
        return text
    title, rest = text.split("\n", 1)
    line = tables()[family][page.stem].replace("|", "\\|")
    figure = f"![What {page.stem} does](../../../figures/{family}/{page.stem}.svg)"
    return f"{title}\n\n**{line}**\n\n{figure}\n{rest}{measured.SECTIONS[family](page.stem)}"
