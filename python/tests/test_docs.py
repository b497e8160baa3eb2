"""The code of the pages in docs/ runs, in order, in one namespace for each page."""

import pathlib
import re

import pytest

DOCS = pathlib.Path(__file__).parents[2] / "docs"
PAGES = [page for page in sorted(DOCS.glob("*.md")) if "```python" in page.read_text(encoding="utf-8")]


@pytest.mark.skipif(not DOCS.is_dir(), reason="the package is tested without the sources")
def test_there_are_pages():
    assert DOCS / "python.md" in PAGES


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_code_of_a_page(page, tmp_path, monkeypatch, capsys):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    for folder in ("tests", "problems"):
        (tmp_path / folder).symlink_to(DOCS.parent / folder)  # with the robots of the pages
    monkeypatch.chdir(tmp_path)
    text = page.read_text(encoding="utf-8")
    namespace = {"__name__": "page"}
    for block in re.finditer(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        line = text.count("\n", 0, block.start(1))
        # Empty lines before it let tracebacks name the line of the page.
        exec(compile("\n" * line + block[1], page.name, "exec"), namespace)
    capsys.readouterr()
