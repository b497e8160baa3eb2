"""Tables of results."""

import csv
import gzip
import os
import zlib

import numpy as np

from ._errors import MissingFileError, bad_value


def table(path):
    """Reads a CSV table of results, such as those that ``maxwrench run`` and ``compare`` write.

    Args:
        path: the CSV file; one whose name ends in .gz is unpacked.

    Returns:
        pandas.DataFrame: the columns, if pandas is installed; otherwise a dict of arrays (rows) by
        name. A column of numbers is float64, and NaN where it is empty. Any other column is text.

    Raises:
        MissingFileError: there is no such file.
        InputError: it is not a table.

    >>> import pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp(), "rows.csv")
    >>> _ = path.write_text("problem,beta\\nuvms/valve,35.4\\nuvms/lift,\\n")
    >>> float(maxwrench.table(path)["beta"][0])
    35.4
    """
    file = os.fspath(path)
    columns = {name: _column(texts) for name, texts in _read(file).items()}
    try:
        import pandas
    except ImportError:
        return columns
    return pandas.DataFrame(columns)


def _read(file):
    """The texts of each column, by name."""
    open_text = gzip.open if file.endswith(".gz") else open
    try:
        with open_text(file, "rt", encoding="utf-8", newline="") as stream:
            rows = list(csv.reader(stream, strict=True))
    except FileNotFoundError:
        raise bad_value("table", "no such file", "a CSV table", file, MissingFileError) from None
    except (OSError, EOFError, zlib.error, UnicodeDecodeError, csv.Error) as error:
        raise bad_value("table", f"a file that cannot be read ({error})", "a CSV table", file) from None
    if not rows or not rows[0]:
        raise bad_value("table", "an empty file", "names of columns in the first line", file)
    names = rows[0]
    if len(set(names)) < len(names):
        raise bad_value("table", f"columns {', '.join(names)}", "each name once", file)
    for number, row in enumerate(rows[1:], 1):
        if len(row) != len(names):
            raise bad_value(f"row {number}", f"{len(row)} cells", f"{len(names)}", file)
    return {name: [row[i] for row in rows[1:]] for i, name in enumerate(names)}


def _column(texts):
    try:
        return np.array([float(text) if text else np.nan for text in texts])
    except ValueError:
        return np.array(texts, dtype=str)
