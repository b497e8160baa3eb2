"""What the tests of the package share."""

import os
import pathlib
import signal
import subprocess

import maxwrench
import pytest

# A shell without job control starts what it runs in the background with SIGINT ignored, and Python then handles no Ctrl-C.
signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def command():
    """Runs the command of the same build, on the package's own copy of the problems, and returns the finished process."""
    package = pathlib.Path(maxwrench.__file__).parent
    beside = package.parents[1] / "maxwrench"
    program = os.environ.get("MAXWRENCH_COMMAND", str(beside))
    if not os.access(program, os.X_OK):
        pytest.fail(f"there is no command at {program}; MAXWRENCH_COMMAND names it")

    environment = dict(os.environ)
    if (package / "problems").is_dir():
        environment["MAXWRENCH_PROBLEMS"] = str(package / "problems")

    def run(*words):
        return subprocess.run([program, *map(str, words)], capture_output=True, text=True, timeout=60, env=environment)

    return run


@pytest.fixture(scope="session")
def problems(command):
    """The folder of the shipped robots and tasks, as the command lists it."""
    first = command("list").stdout.splitlines()[0]
    return pathlib.Path(first[first.index("(in ") + 4 : first.rindex(")")])


@pytest.fixture
def rejects():
    """Calls a function that must raise an InputError of one line, and returns the error."""

    def call(function, *arguments, **named):
        with pytest.raises(maxwrench.InputError) as caught:
            function(*arguments, **named)
        line = str(caught.value)
        assert isinstance(caught.value, ValueError)
        assert line.strip() and len(line.splitlines()) == 1, line
        return caught.value

    return call
