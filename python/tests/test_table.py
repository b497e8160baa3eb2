"""Tables of results."""

import gzip
import pathlib
import sys

import maxwrench as mw
import numpy as np
import pytest

RESULTS = pathlib.Path(__file__).parents[2] / "results"
TEXT = 'problem,beta,note\nuvms/valve,35.5,"a, b"\nuvms/lift,,\n'


@pytest.fixture(params=["pandas", "NumPy alone"])
def kind(request, monkeypatch):
    if request.param == "pandas":
        return pytest.importorskip("pandas").DataFrame
    monkeypatch.setitem(sys.modules, "pandas", None)
    return dict


def test_columns(kind, tmp_path):
    plain, packed = tmp_path / "rows.csv", tmp_path / "rows.csv.gz"
    plain.write_text(TEXT)
    packed.write_bytes(gzip.compress(TEXT.encode()))
    for path in (plain, str(packed)):
        columns = mw.table(path)
        assert isinstance(columns, kind)
        np.testing.assert_array_equal(columns["beta"], [35.5, np.nan])
        assert list(columns["problem"]) == ["uvms/valve", "uvms/lift"]
        assert list(columns["note"]) == ["a, b", ""]


def test_shipped_results(kind):
    columns = mw.table(RESULTS / "values.csv.gz")
    beta = np.asarray(columns["beta"])
    here = (columns["problem"] == "uvms/valve") & (columns["measure"] == "linf_polytope") & (columns["wrench"] == "pure")
    # Branch and bound proves that no posture has more than 35.44 N m (results/uvms_static.txt).
    assert 35.3 < np.nanmax(beta[np.asarray(here)]) < 35.44


@pytest.mark.parametrize(
    "content, key",
    [
        (b"", "table"),
        (b"\n1\n", "table"),
        (b"a,a\n1,2\n", "table"),
        (b"a,b\n1,2\n3\n", "row 2"),
        (b'a,b\n"1,2\n', "table"),
        (b"a,b\n\xff\xfe,2\n", "table"),
    ],
)
def test_broken_tables(content, key, tmp_path):
    path = tmp_path / "rows.csv"
    path.write_bytes(content)
    with pytest.raises(mw.InputError) as caught:
        mw.table(path)
    assert caught.value.file == str(path) and caught.value.key == key
    assert "\n" not in str(caught.value) and not isinstance(caught.value, FileNotFoundError)


def test_broken_gzip(tmp_path):
    packed = gzip.compress(TEXT.encode() * 50)
    for content in (b"text", packed[:-20], packed[:30] + bytes(9) + packed[39:]):
        path = tmp_path / "rows.csv.gz"
        path.write_bytes(content)
        with pytest.raises(mw.InputError, match="rows.csv.gz: table: "):
            mw.table(path)


def test_missing_file():
    with pytest.raises(mw.MissingFileError) as caught:
        mw.table("none.csv")
    assert caught.value.file == "none.csv" and isinstance(caught.value, FileNotFoundError)
