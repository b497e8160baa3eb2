"""Files: whole or not at all."""

import os
import tempfile

from ._errors import MissingFileError, bad_value


def write_bytes(path, content):
    """Writes a file under a temporary name and renames it."""
    folder, name = os.path.split(os.path.abspath(path))
    if not os.path.isdir(folder):
        error = bad_value("path", os.fspath(path), "a file in a folder that exists", kind=MissingFileError)
        error.file = error.value
        raise error
    with tempfile.NamedTemporaryFile(dir=folder, prefix=f".{name}.", delete=False) as file:
        try:
            file.write(content)
            file.close()
            os.replace(file.name, path)
        except BaseException:
            os.unlink(file.name)
            raise
