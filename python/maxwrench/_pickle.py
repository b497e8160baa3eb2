"""Pickled objects: how each was made, and how it is made again."""

import importlib

from ._errors import bad_value


def remake(function, arguments, digest):
    """Calls the function that made the object. Files must be what they were then."""
    if function == "Task.robot":
        return arguments["task"].robot
    maker = importlib.import_module("maxwrench")
    for name in function.split("."):
        maker = getattr(maker, name)
    made = maker(**arguments)
    if digest and made.digest != digest:
        expected = f"{digest}: the files of {made.name} have changed since it was pickled"
        raise bad_value("digest", made.digest, expected)
    return made
