"""Arguments of a wrong type: one line that names them, in place of pybind11's several."""

import functools
import inspect
import math
import re

from . import _core
from ._errors import bad_value

_TYPES = {
    "str": (str, "a text"),
    "int": (int, "an integer in its range"),
    "float": ((int, float), "a number"),
    "bool": (bool, "True or False"),
}


def shortened(value):
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else text[:57] + "..."


def _explained(function, text, args, kwargs):
    """The error for arguments that pybind11 rejected with this text."""
    signature = re.search(r"^\s+1\. (.*)$", text, re.MULTILINE).group(1).replace("maxwrench._core.", "maxwrench.")
    try:
        _signature(function).bind(*args, **kwargs)
    except TypeError as error:  # names what is missing or unknown
        return TypeError(f"{function.__name__}: {error}, expected {signature}")
    parameters = re.findall(r"(\w+): ([A-Za-z_][\w.]*)", signature.split(" -> ")[0])
    given = dict(zip((name for name, _ in parameters), args)) | kwargs
    for name, kind in parameters:
        if name not in given or kind == "object":
            continue
        types, expected = _TYPES.get(kind, (None, None))
        if types is None:
            types = getattr(_core, kind.rpartition(".")[2], None)
            expected = f"a maxwrench.{kind.rpartition('.')[2]}" if types else f"a {kind.lower()}"
        value = given[name]
        # An integer that every integer of C++ holds is not what was rejected.
        beyond = types is int and isinstance(value, int) and not 0 <= value < 2**31
        wrong = types is None or not isinstance(value, types) or beyond
        if wrong and not (isinstance(value, bool) and types is bool):
            return bad_value(name, shortened(value), expected)
    return TypeError(f"{function.__name__}: arguments of a wrong type, expected {signature}")


def _signature(function):
    """The signature in the first line of pybind11's docstring."""
    line = function.__doc__.partition("\n")[0]
    scope = {"inf": math.inf}
    exec(f"from __future__ import annotations\ndef {line}: ...", scope)  # noqa: S102
    return inspect.signature(scope[function.__name__])


def checked(function):
    """The function, whose errors about types are one line."""

    @functools.wraps(function)
    def call(*args, **kwargs):
        try:
            return function(*args, **kwargs)
        except TypeError as error:
            text = str(error)
            if "incompatible" not in text.partition("\n")[0]:
                raise
            raise _explained(function, text, args, kwargs) from None

    del call.__wrapped__  # it has no signature for inspect
    call.__signature__ = _signature(function)
    return call


def check_class(cls, *, methods=(), static=()):
    """Does the same for methods of a class."""
    for name in methods:
        setattr(cls, name, checked(getattr(cls, name)))
    for name in static:
        setattr(cls, name, staticmethod(checked(getattr(cls, name))))
