"""The pages of the C++ and the Python reference, by subjects.toml."""

import pathlib
import re
import tomllib

import maxwrench

ROOT = pathlib.Path(__file__).resolve().parents[2]


def subjects(language, names):
    """The subjects of a language, with each of the names once."""
    with open(ROOT / "docs/site/subjects.toml", "rb") as file:
        found = tomllib.load(file)[language]
    listed = sorted(name for entries in found.values() for name in entries)
    if listed != sorted(names):
        wrong = sorted(set(listed) ^ set(names)) or "a name stands twice"
        raise SystemExit(f"docs/site/subjects.toml: [{language}]: {wrong}")
    return found


def slug(title):
    return re.sub(r"\W+", "_", title.lower())


def toctree(entries):
    return "\n".join(["", "```{toctree}", ":hidden:", "", *entries, "```", ""])


def brief(header):
    """The first sentence of the comment of a header."""
    return re.search(r"^/// @file\n/// (.*)$", (ROOT / "include/maxwrench" / header).read_text(), re.MULTILINE)[1]


def cpp_pages():
    headers = [path.name for path in (ROOT / "include/maxwrench").glob("*.h")]
    index = ["# C++ reference", "", "The public headers, by subject. `examples/` has programs that use them.", ""]
    pages, entries = {}, []
    for title, names in subjects("cpp", headers).items():
        index += [f"## {title}", "", *(f"* [{name}](cpp/{name[:-2]}.md): {brief(name)}" for name in names), ""]
        entries += [f"cpp/{name[:-2]}" for name in names]
        for name in names:
            pages[f"reference/cpp/{name[:-2]}.md"] = "\n".join(
                [f"# {name}", "", "```{eval-rst}", f".. doxygenfile:: {name}", "   :project: maxwrench", "```", ""])
    return pages | {"reference/cpp.md": "\n".join(index) + toctree(entries)}


def sentence(name):
    """The first line of the docstring of a function or class of the package."""
    text = getattr(maxwrench, name).__doc__ or ""
    lines = [line for line in text.splitlines() if line and not line.startswith(name + "(")]
    return ": " + lines[0].replace("|", "\\|") if lines and name[0] != "_" else ""


def python_pages():
    index = ["# Python reference", "", "The package `maxwrench`, by subject. [Python in ten minutes](../docs/python.md) is a tour of it.", ""]
    pages, entries = {}, []
    for title, names in subjects("python", maxwrench.__all__).items():
        page = f"python/{slug(title)}"
        index += [f"## {title}", "", "```{eval-rst}", *(f"* :py:obj:`maxwrench.{name}`{sentence(name)}" for name in names), "```", ""]
        entries.append(page)
        body = [f"# {title}", "", "```{eval-rst}", ".. currentmodule:: maxwrench", ""]
        for name in names:
            value = getattr(maxwrench, name)
            if isinstance(value, type):
                body += [f".. autoclass:: {name}", "   :members:", ""]
            else:
                body += [f".. autofunction:: {name}" if callable(value) else f".. autodata:: {name}", ""]
        pages[f"reference/{page}.md"] = "\n".join([*body, "```", ""])
    return pages | {"reference/python.md": "\n".join(index) + toctree(entries)}


def pages():
    return cpp_pages() | python_pages()
