"""Pickled objects: how each was made, and how it is made again."""

from . import _core
from ._errors import InputError


def remake(function, arguments, digest):
    """Calls the function that made the object. Files must be what they were then."""
    if function == "Task.robot":
        return arguments["task"].robot
    maker = _core
    for name in function.split("."):
        maker = getattr(maker, name)
    made = maker(**arguments)
    if digest and made.digest != digest:
        raise InputError(
            f"digest: got {made.digest}, expected {digest}: the files of {made.name} have changed "
            "since it was pickled"
        )
    return made
