"""Bad files and the lines of the command: the package gives the same ones."""

import pathlib

import maxwrench as mw
import pytest

GOOD = [0.1, 0.2]  # theta_r of planar/force


def test_missing_files(tmp_path, problems, command):
    gone = tmp_path / "gone.toml"
    for call in (
        lambda: mw.load(gone),
        lambda: mw.load("planar/nothing"),
        lambda: mw.Robot.from_toml(gone),
        lambda: mw.Robot.from_urdf(gone),
        lambda: mw.Robot.from_urdf(problems / "fixed" / "arm.urdf", srdf=gone),
    ):
        with pytest.raises(mw.MissingFileError) as caught:
            call()
        error = caught.value
        assert isinstance(error, FileNotFoundError) and isinstance(error, mw.InputError)
        assert len(str(error).splitlines()) == 1 and error.file and error.value and error.expected and error.key
        assert error.file in str(error)
    assert isinstance(mw.InputError("a"), ValueError) and mw.InputError("a").key is None


def test_a_file_that_is_there_is_not_missing(rejects, tmp_path):
    for path in (tmp_path, "/dev/null"):
        assert not isinstance(rejects(mw.load, path), mw.MissingFileError)
    (tmp_path / "task.toml").write_text('type = "static')
    assert not isinstance(rejects(mw.load, tmp_path / "task.toml"), mw.MissingFileError)


def test_paths_of_bytes(problems):
    name = str(problems / "fixed" / "push.toml").encode()
    assert mw.load(name).unit == "N"  # os.fspath may return bytes


def test_package_folders_may_be_paths(problems):
    urdf = problems / "fixed" / "arm.urdf"
    assert mw.Robot.from_urdf(urdf, packages=[pathlib.Path("/tmp")]).name == mw.Robot.from_urdf(urdf).name


@pytest.mark.parametrize(
    "old, new, key",
    [
        ("[pose]", "[pose", "line 7"),
        ("c = [1, 0, -0.5, 0, 0, 0]", "c = [1, 0, nan, 0, 0, 0]", "wrench.c"),
        ("c = [1, 0, -0.5, 0, 0, 0]", "c = [1, 0]", "wrench.c"),
        ("c = [1, 0, -0.5, 0, 0, 0]", "c = [0, 0, 0, 0, 0, 0]", "wrench.c"),
        ("c = [1, 0, -0.5, 0, 0, 0]", "", "wrench.c"),
        ("xyz = [0.6, 0.1, 0.5]", 'xyz = "here"', "pose.xyz"),
        ('type = "static"', 'type = "dynamic"', "type"),
        ('robot = "arm.toml"', 'robot = "gone.toml"', "robot"),
        ('joints = ["joint_7"]', 'joints = ["joint_8"]', "theta_r.joints"),
        ("default = [0]", "default = [7]", "theta_r.default"),
        ("[theta_r]", "colour = 1\n[theta_r]", "wrench.colour"),
    ],
)
def test_broken_files_give_the_line_of_the_command(command, rejects, problems, tmp_path, old, new, key):
    for name in ("push.toml", "arm.toml", "arm.urdf"):
        (tmp_path / name).write_bytes((problems / "fixed" / name).read_bytes())
    file = tmp_path / "push.toml"
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))
    error = rejects(mw.load, file)
    printed = command("eval", file)
    assert printed.returncode == 2 and printed.stderr == f"maxwrench: {error}\n"
    assert error.key == key and error.file == str(file)
    assert error.value in str(error) and error.expected in str(error)


@pytest.mark.parametrize(
    "words, call",
    [
        (["eval", "no/no"], lambda: mw.load("no/no")),
        (["eval", "/"], lambda: mw.load("/")),
        (["eval", "uvms/valve", "--limits", "no"], lambda: mw.load("uvms/valve", limits="no")),
        (["eval", "planar/force", "--measure", "no"], lambda: mw.evaluate("planar/force", GOOD, measure="no")),
        (["eval", "planar/force", "--measure", "a\nb"], lambda: mw.evaluate("planar/force", GOOD, measure="a\nb")),
        (["eval", "planar/force", "--solver", "no"], lambda: mw.evaluate("planar/force", GOOD, solver="no")),
        (["eval", "planar/force", "--wrench", "no"], lambda: mw.evaluate("planar/force", GOOD, wrench="no")),
        (["eval", "planar/force", "--measure", "ellipsoid", "--solver", "clp"],
         lambda: mw.evaluate("planar/force", GOOD, measure="ellipsoid", solver="clp")),
        (["eval", "uvms/valve", "--measure", "manipulability", "--wrench", "any"],
         lambda: mw.evaluate("uvms/valve", [0, 0, 0, 0], measure="manipulability", wrench="any")),
        (["eval", "planar/trajectory", "--measure", "ellipsoid"],
         lambda: mw.evaluate("planar/trajectory", GOOD, measure="ellipsoid")),
        (["solve", "planar/force", "--search", "no"], lambda: mw.solve("planar/force", search="no")),
        (["solve", "planar/force", "--search", "cmaes+"], lambda: mw.solve("planar/force", search="cmaes+")),
        (["solve", "planar/trajectory", "--search", "facet_sqp"],
         lambda: mw.solve("planar/trajectory", search="facet_sqp")),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_the_line_is_that_of_the_command(command, rejects, words, call):
    error = rejects(call)
    printed = command(*words)
    assert printed.returncode == 2 and printed.stdout == ""
    # The command names its option where the package has an argument.
    assert printed.stderr.removeprefix("maxwrench: ").removeprefix("--") == f"{error}\n"


def test_what_is_no_task(rejects):
    for call in (mw.solve, mw.certify):
        assert str(rejects(call, None)).startswith("task: got a NoneType, expected a Task")
    assert str(rejects(mw.solve, 3)) == "task: got a int, expected a Task, or the name or the file of one"


def test_a_missing_folder_is_named_as_it_was_given(tmp_path):
    file = str(tmp_path / "none" / "force.proof")
    proof = mw.certify("planar/force", gap=0.01)
    for write in (proof.save, mw.evaluate("planar/force", [0, 0]).view):
        with pytest.raises(FileNotFoundError) as caught:
            write(file)
        assert str(caught.value) == f"path: got {file}, expected a file in a folder that exists"
        assert (caught.value.file, caught.value.key, caught.value.value) == (file, "path", file)
