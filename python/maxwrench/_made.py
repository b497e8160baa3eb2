"""Objects as plain data, from which they are made again: what json.dumps takes and ``from_dict`` reads.

A pose and the parts of a robot are their arguments. A task, a robot and a path are the call that made
them: ``by``, a function, and ``with``, its arguments; a task also has the ``digest`` of its files.
"""

from __future__ import annotations

import dataclasses
import json
import math
import os
from typing import Any, TypeVar

import numpy as np

from . import _core
from ._errors import bad_value

_MAKERS = (
    "Impulse",
    "Path.screw",
    "Path.spline",
    "Robot.from_toml",
    "Robot.from_urdf",
    "Static",
    "Task.robot",
    "Task.with_limits",
    "Trajectory",
    "Transfer",
    "load",
    "make_robot",
    "nominal",
)
_Kind = TypeVar("_Kind")


def _call(thing):
    """The call that makes an object of this package again, as plain data; None: it is no such object."""
    if isinstance(thing, _core.Pose):
        return {"class": "Pose", "p": encoded(thing.p), "R": encoded(thing.R)}
    if isinstance(thing, Part):
        fields = dataclasses.fields(thing)  # type: ignore[arg-type]  # all of them are dataclasses
        return {"class": type(thing).__name__} | {field.name: encoded(getattr(thing, field.name), field.name) for field in fields}
    if not isinstance(thing, (_core.Task, _core.Robot, _core.Path)):
        return None
    _, (function, arguments, digest) = thing.__reduce__()
    call = {"class": type(thing).__name__, "by": function, "with": encoded(arguments)}
    return call | {"digest": digest} if digest else call


def encoded(value, key="argument"):
    """Returns an argument as json.dumps takes it.

    >>> maxwrench._made.encoded([1, float("inf")])
    [1, {'float': 'inf'}]
    """
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, float) and not math.isfinite(value):
        return {"float": str(value)}
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, (list, tuple)):
        return [encoded(item, key) for item in value]
    call = _call(value)
    if call is not None:
        return call
    if isinstance(value, dict) or hasattr(value, "items"):
        return {str(name): encoded(item, str(name)) for name, item in value.items()}
    if hasattr(value, "__array__"):
        return encoded(np.asarray(value), key)
    raise bad_value(key, f"a {type(value).__name__}", "what can be written as JSON")


def decoded(value):
    """Returns the argument that ``encoded`` wrote.

    >>> maxwrench._made.decoded({"class": "Pose", "p": [1, 2, 3]})
    Pose([1, 2, 3], rpy=[0, 0, 0])
    """
    if isinstance(value, list):
        return [decoded(item) for item in value]
    if not isinstance(value, dict):
        return value
    if set(value) == {"float"}:
        return float(value["float"])
    if "class" not in value:
        return {name: decoded(item) for name, item in value.items()}
    from . import _parts, _pickle

    name = value["class"]
    if "by" in value:
        maker, arguments = value["by"], value.get("with")
        if maker not in _MAKERS:
            raise bad_value("by", repr(maker), "one of " + ", ".join(_MAKERS))
        if not isinstance(arguments, dict):
            raise bad_value("with", repr(arguments), f"the arguments of {maker}")
        try:
            return _pickle.remake(maker, decoded(arguments), value.get("digest", ""))
        except (KeyError, TypeError) as error:  # an argument is missing or unknown
            raise bad_value("with", str(error), f"the arguments of {maker}") from None
    kind = _core.Pose if name == "Pose" else getattr(_parts, str(name), None)
    if kind is not _core.Pose and not (isinstance(kind, type) and issubclass(kind, Part)):
        raise bad_value("class", repr(name), "a class of maxwrench that can be made again")
    try:
        return kind(**{key: decoded(item) for key, item in value.items() if key != "class"})
    except TypeError as error:  # an argument is missing or unknown
        raise bad_value(name, str(error), f"the arguments of {name}") from None


def dict_of(self) -> dict[str, Any]:
    """Returns the object as plain data, which json.dumps takes and ``from_dict`` makes the object of.

    A Task, a Robot and a Path are written as the call that made them, ``by`` and ``with``, beside what
    their attributes say. A number that is not finite is ``{"float": "inf"}`` where ``from_dict`` reads
    it, and None elsewhere.

    Raises:
        InputError: an argument of that call cannot be written as JSON.

    >>> maxwrench.Pose([0.5, 0, 0.3]).to_dict()["p"]
    [0.5, 0.0, 0.3]
    >>> maxwrench.load("planar/force").to_dict()["with"]
    {'name': 'planar/force', 'limits': ''}
    """
    call = _call(self)
    assert call is not None
    if isinstance(self, (_core.Pose, Part)):
        return call
    from ._dict import attributes, plain

    says = {name: plain(value) for name, value in attributes(self).items()}
    return {"class": call.pop("class")} | says | call


def json_of(self) -> str:
    """Returns ``to_dict()`` as a text of JSON.

    >>> maxwrench.Pose([0.5, 0, 0.3]).to_json()[:39]
    '{"class": "Pose", "p": [0.5, 0.0, 0.3],'
    """
    return json.dumps(self.to_dict(), allow_nan=False)


def maker_of(kind: type[_Kind]):
    """The function ``from_dict`` of a class."""

    def from_dict(data: dict[str, Any]) -> _Kind:
        """Makes the object that ``to_dict`` wrote.

        Args:
            data: what ``to_dict`` returned, or json.loads of what ``to_json`` returned.

        Raises:
            InputError: data is of another class, or as the function that makes such an object; of a task,
                its files have changed.

        >>> pose = maxwrench.Pose([0.5, 0, 0.3])
        >>> maxwrench.Pose.from_dict(pose.to_dict()) == pose
        True
        """
        if not isinstance(data, dict) or data.get("class") != kind.__name__:
            got = repr(data.get("class")) if isinstance(data, dict) else f"a {type(data).__name__}"
            raise bad_value("class", got, repr(kind.__name__))
        made = decoded({key: item for key, item in data.items() if "by" not in data or key in ("class", "by", "with", "digest")})
        if not isinstance(made, kind):
            raise bad_value("by", repr(data["by"]), f"what makes a {kind.__name__}")
        return made

    return staticmethod(from_dict)


class Part:
    """What the parts of robots and tasks have in common."""

    to_dict = dict_of
    to_json = json_of

    @classmethod
    def from_dict(cls: type[_Kind], data: dict[str, Any]) -> _Kind:
        """Makes the part that ``to_dict`` wrote.

        Args:
            data: what ``to_dict`` returned, or json.loads of what ``to_json`` returned.

        Raises:
            InputError: data is of another class, or an argument is missing or unknown.
        """
        return maker_of(cls).__func__(data)
