"""The pages of `report` and the paper, beside the site."""

import pathlib
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]


def page(extra):
    """A page that links them."""
    out = extra / "report"
    subprocess.run([ROOT / "build/maxwrench", "report", ROOT / "results", "--out", out], check=True, capture_output=True)
    shutil.copy(ROOT / "build/paper/maxwrench.pdf", out)
    return ("# Report and paper\n\n"
            "* <a href=\"report/report.html\">The benchmark report</a>: all tables with filters, performance profiles and significance tests, as "
            "`maxwrench report results` makes it. It is one file without links to others.\n"
            "* [Its tables](docs/benchmarks.md#reports) are CSV files in [results](folders/results.md).\n"
            "* <a href=\"report/maxwrench.pdf\">The paper</a> (PDF) reads its numbers from `results/`.\n")
