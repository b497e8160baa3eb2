"""Links the first use of each term of docs/glossary.md on every other page to its line there. The Markdown stays as it is."""

import pathlib
import re

from docutils import nodes
from sphinx.util.nodes import make_refnode

GLOSSARY = "docs/glossary"
ROW = re.compile(r"^\| (.+?) \| (.+) \|$", re.MULTILINE)
NO_TEXT = (nodes.reference, nodes.title, nodes.literal, nodes.literal_block, nodes.math, nodes.math_block, nodes.caption)


def anchor(term):
    return "term-" + re.sub(r"\W+", "-", term).strip("-").lower()


def terms():
    """Each term with its anchor and its meaning; a row of the glossary can have several."""
    found = {}
    text = (pathlib.Path(__file__).resolve().parents[1] / "glossary.md").read_text(encoding="utf-8")
    for names, meaning in ROW.findall(text):
        if names in ("term", "---"):
            continue
        names = names.split(", ")
        for name in names:
            found[name] = (anchor(names[0]), meaning.replace("`", "").replace("\\|", "|"))
    return found


def words_of(app):
    """The terms that are words, with a pattern of all of them, longest first; and those that are code."""
    known = {term: entry for term, entry in terms().items() if term not in app.config.glossary_without}
    code = {term.strip("`"): entry for term, entry in known.items() if term.startswith("`") and len(term) > 4}
    words = {term.lower(): entry for term, entry in known.items() if re.fullmatch(r"[A-Za-z][A-Za-z -]{2,}", term)}
    longest = sorted(words, key=len, reverse=True)
    pattern = re.compile(r"\b(" + "|".join(map(re.escape, longest)) + r")(s?)\b", re.IGNORECASE)
    return words, pattern, code


def mark_rows(app, doctree):
    """Gives each row of the glossary its anchor, and each term an entry of the search."""
    if app.env.docname != GLOSSARY:
        return
    known = terms()
    domain = app.env.get_domain("std")
    for row in doctree.findall(nodes.row):
        names = [name for name in known if name.replace("`", "") in row[0].astext().split(", ")]
        for name in names:
            row["ids"] = [known[name][0]]
            domain.note_object("term", name.strip("`"), known[name][0], location=row)


def link_terms(app, doctree, docname):
    if docname == GLOSSARY or docname.startswith(("reference/", "CHANGELOG", "folders/")):
        return
    words, pattern, code = words_of(app)
    used = set()

    def link(entry, child):
        used.add(entry[0])
        found = make_refnode(app.builder, docname, GLOSSARY, entry[0], child, entry[1])
        found["classes"].append("term")
        return found

    for node in list(doctree.findall(lambda node: isinstance(node, (nodes.Text, nodes.literal)))):
        ancestor, inside = node.parent, False
        while ancestor is not None:
            inside = inside or isinstance(ancestor, NO_TEXT)
            ancestor = ancestor.parent
        if inside:
            continue
        if isinstance(node, nodes.literal):
            entry = code.get(node.astext())
            if entry and entry[0] not in used:
                node.parent.replace(node, link(entry, node.deepcopy()))
            continue
        text, parts, at = node.astext(), [], 0
        for match in pattern.finditer(text):
            entry = words[match[1].lower()]
            if entry[0] in used:
                continue
            parts += [nodes.Text(text[at:match.start()]), link(entry, nodes.Text(match[0]))]
            at = match.end()
        if parts:
            node.parent.replace(node, [*parts, nodes.Text(text[at:])])


def setup(app):
    app.add_config_value("glossary_without", [], "env")
    app.connect("doctree-read", mark_rows)
    app.connect("doctree-resolved", link_terms)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
