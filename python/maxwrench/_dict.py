"""Results as plain data: what json.dumps takes."""

import math

import numpy as np

from . import _core


def dict_of(self):
    """Returns what a result says, by the names of its attributes: numbers, texts, lists and dicts.

    Arrays become lists, numbers that are not finite None, a Task its name.

    >>> maxwrench.linprog([1, 2], [[1, 1]], [1]).to_dict()["objective"]
    2.0
    """
    return {name: plain(value) for name, value in attributes(self).items()}


def attributes(thing):
    """Returns the attributes of an object of this package by their names.

    >>> sorted(maxwrench._dict.attributes(maxwrench.Pose([1, 2, 3])))[0]
    'R'
    """
    kind = type(thing)
    return {name: getattr(thing, name) for name in dir(kind) if isinstance(getattr(kind, name), property)}


def plain(value):
    """Returns a value of an attribute as json.dumps takes it.

    >>> import numpy
    >>> maxwrench._dict.plain({"t": numpy.array([1.0, numpy.nan])})
    {'t': [1.0, None]}
    """
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if value is None or isinstance(value, (bool, int, str)):
        return value
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, (_core.Task, _core.Robot)):
        return value.name
    return value.to_dict()
