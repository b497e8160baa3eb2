"""Makes the sources of the site, in build/docs/source: the pages of the repository, and those that are computed."""

import pathlib
import re
import subprocess

import gallery
import reference
import reports
import strategies

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCE, EXTRA = ROOT / "build/docs/source", ROOT / "build/docs/extra"
COPIED = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "CITATION.cff", "docs", "problems", "results", "examples", "benchmarks/suites",
          "benchmarks/slurm", "view/engine/README.md"]
FOLDERS = ["examples", "results"]
LINK = re.compile(r"(?<=\]\()([^)#: ]+)(?=[)#])")


def tracked():
    """The files of the repository that the site needs, by their paths from the root."""
    names = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", *COPIED], cwd=ROOT, check=True, capture_output=True, text=True)
    return [pathlib.PurePosixPath(name) for name in names.stdout.splitlines()
            if not name.startswith("docs/site/") and (ROOT / name).exists()]


def with_known_links(text, page):
    """Folders have a page that lists them, and the README is the first page."""

    def target(link):
        path = (ROOT / page).parent.joinpath(link[1]).resolve()
        up = "../" * (len(page.parts) - 1)
        if path == ROOT / "README.md":
            return up + "index.md"
        if path.is_dir():
            return up + f"folders/{path.relative_to(ROOT).as_posix().replace('/', '_')}.md"
        return link[1]

    return LINK.sub(target, text)


def listed(page, text, files):
    """With a hidden table of contents: the pages of the folder of the same name, in the order of their links."""
    folder = page.with_suffix("")
    if not any(file.is_relative_to(folder) for file in files):
        return text
    links = [link for link in LINK.findall(text) if link.startswith(folder.name + "/") and link.endswith(".md")]
    return text + toctree(dict.fromkeys(links))


def toctree(entries, caption="", hidden=True):
    options = [f":caption: {caption}"] * bool(caption) + [":hidden:"] * hidden
    return "\n".join(["", "```{toctree}", *options, "", *entries, "```", ""])


def folder_page(folder, files):
    inside = [file for file in files if file.is_relative_to(folder) and file.suffix != ".md"]
    lines = [f"* [{file.relative_to(folder)}](../{file})" for file in inside]
    return "\n".join(["---", "orphan: true", "---", "", f"# Files of {folder}/", "", *lines, ""])


def first_page(readme):
    """The start of the README, and the table of contents. The rest of the README is the page overview."""
    start, rest = readme.split("\n## ", 1)
    contents = {
        "Use it": ["overview.md", "docs/install.md", "docs/command.md", "docs/python.md", "docs/own_robot.md",
                   "docs/robot_files.md", "docs/tank.md", "docs/view.md", "docs/studies.md", "docs/questions.md",
                   "gallery.md"],
        "How it works": ["docs/glossary.md", "docs/algorithms.md", "docs/benchmarks.md"],
        "Reference": ["reference/python.md", "reference/cpp.md"],
        "Project": ["CONTRIBUTING.md", "CHANGELOG.md", "view/engine/README.md", "reports.md"],
    }
    trees = "".join(toctree(pages, caption) for caption, pages in contents.items())
    return start + "\n" + trees, "# Overview\n\n## " + rest


def write(path, content):
    """Only what is new, so that Sphinx reads only that."""
    path = SOURCE / path
    path.parent.mkdir(parents=True, exist_ok=True)
    data = content if isinstance(content, bytes) else content.encode()
    if not path.exists() or path.read_bytes() != data:
        path.write_bytes(data)
    return path


def main():
    files = tracked()
    pages = {file: (ROOT / file).read_text() for file in files if file.suffix == ".md"}
    strategies.require_pages(pages)
    strategies.draw_figures(SOURCE)
    start, overview = first_page(pages.pop(pathlib.PurePosixPath("README.md")))
    texts = {page: strategies.completed(page, listed(page, text, files)) for page, text in pages.items()}
    texts |= {pathlib.PurePosixPath("index.md"): start, pathlib.PurePosixPath("overview.md"): overview}
    computed = reference.pages() | gallery.pages(SOURCE, EXTRA) | {"reports.md": reports.page(EXTRA)}
    for folder in FOLDERS:
        computed[f"folders/{folder}.md"] = folder_page(pathlib.PurePosixPath(folder), files)
    written = {write(page, with_known_links(text, page).replace("```math\n", "```{math}\n")) for page, text in texts.items()}
    written |= {write(page, text) for page, text in computed.items()}
    written |= {write(file, (ROOT / file).read_bytes()) for file in files if file.suffix != ".md"}
    for old in set(SOURCE.rglob("*.md")) - written:
        old.unlink()


if __name__ == "__main__":
    main()
