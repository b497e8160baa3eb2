"""Docstrings of the Python package are plain text: lambda_ is a name and |x| a norm, not markup of reStructuredText."""

import re

CODE = re.compile(r"(``.*?``)")


def plain(app, what, name, obj, options, lines):
    for i, line in enumerate(lines):
        if line.lstrip().startswith((">>>", ":", "..")):
            continue
        parts = CODE.split(line)
        parts[::2] = [re.sub(r"([|*]|(?<=\w)_(?!\w))", r"\\\1", part) for part in parts[::2]]
        lines[i] = "".join(parts)


def short(app, what, name, obj, options, arguments, result):
    """Without the name of the compiled part."""
    return tuple(text and text.replace("maxwrench._core.", "") for text in (arguments, result))


def setup(app):
    app.connect("autodoc-process-signature", short)
    app.connect("autodoc-process-docstring", plain, priority=400)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
