"""The errors of the package."""

import json


class InputError(ValueError):
    """A wrong argument or file, in one line that names the key, the value and what was expected.

    Attributes: ``file``, ``key``, ``value`` and ``expected`` are texts, or None where the line does
    not come from a file or a single key. The line is that of the command.

    >>> try:
    ...     maxwrench.load("uvms/valv")
    ... except maxwrench.InputError as error:
    ...     print(error.key)
    problem
    """

    file = key = value = expected = None

    def to_dict(self):
        """Returns the line and its parts by their names.

        >>> maxwrench.InputError("a line").to_dict()["line"]
        'a line'
        """
        return {"line": str(self)} | {name: getattr(self, name) for name in ("file", "key", "value", "expected")}

    def to_json(self):
        """Returns ``to_dict()`` as a text of JSON."""
        return json.dumps(self.to_dict())


class MissingFileError(InputError, FileNotFoundError):
    """A file that is not there; also a FileNotFoundError. It has the attributes of InputError.

    >>> try:
    ...     maxwrench.load("none.toml")
    ... except FileNotFoundError as error:
    ...     print(error.file)
    none.toml
    """


class SearchEnded(BaseException):
    """Ends a search: it used its budget, or the user interrupted it. No Exception, so that a search
    that survives the errors of its own steps by ``except Exception`` ends, too.

    >>> issubclass(maxwrench.SearchEnded, Exception)
    False
    """


for _error in (InputError, MissingFileError, SearchEnded):
    _error.__module__ = "maxwrench"


def bad_value(key, value, expected, file=None, kind=InputError):
    """Returns the error for a wrong value; its line is like those of the compiled part."""
    line = f"{key}: got {value}, expected {expected}"
    error = kind(f"{file}: {line}" if file else line)
    error.file, error.key, error.value, error.expected = file, key, value, expected
    return error
