"""Builds the compiled part of the package by CMake, on the tree that this folder belongs to.

MAXWRENCH_BUILD names the folder of a build that is already configured; without it, one is made.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = Path(__file__).resolve().parent.parent
SOURCES = (".cpp", ".h", ".cmake")  # stand beside the problems and are none of them


def version():
    """The version of the project, which CMakeLists.txt holds."""
    text = (SOURCE / "CMakeLists.txt").read_text()
    return re.search(r"project\(maxwrench VERSION ([0-9.]+)", text).group(1)


class BuildByCMake(build_ext):
    """Builds the module and puts the shipped problems beside it."""

    def build_extension(self, ext):
        build = os.environ.get("MAXWRENCH_BUILD")
        if not build:
            build = str(Path(self.build_temp).resolve())
            self.configure(build)
        subprocess.run(
            ["cmake", "--build", build, "--target", "maxwrench_python", "--parallel"], check=True
        )
        target = Path(self.get_ext_fullpath(ext.name)).resolve()
        target.parent.mkdir(parents=True, exist_ok=True)
        (module,) = Path(build, "python", "maxwrench").glob("_core.*.so")
        shutil.copy2(module, target)
        self.copy_problems(target.parent / "problems")

    def configure(self, build):
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        # Clang takes half of GCC's time.
        clang = shutil.which("clang++") and "CXX" not in os.environ
        compiler = ["-D", "CMAKE_CXX_COMPILER=clang++"] if clang else []
        subprocess.run(
            [
                "cmake", *generator, *compiler, "-S", str(SOURCE), "-B", build,
                "-D", "CMAKE_BUILD_TYPE=Release", "-D", "CMAKE_UNITY_BUILD=ON",
                "-D", "MAXWRENCH_WITH_PYTHON=ON", "-D", f"Python_EXECUTABLE={sys.executable}",
                "-D", "MAXWRENCH_BUILD_COMMAND=OFF", "-D", "MAXWRENCH_BUILD_BENCHMARKS=OFF",
                "-D", "MAXWRENCH_BUILD_EXAMPLES=OFF", "-D", "BUILD_TESTING=OFF",
            ],
            check=True,
        )  # fmt: skip

    @staticmethod
    def copy_problems(target):
        for file in (SOURCE / "problems").rglob("*"):
            if not file.is_file() or file.suffix in SOURCES:
                continue
            copy = target / file.relative_to(SOURCE / "problems")
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(file, copy)


setup(
    version=version(),
    ext_modules=[Extension("maxwrench._core", sources=[])],
    cmdclass={"build_ext": BuildByCMake},
)
