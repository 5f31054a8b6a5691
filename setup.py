# SPDX-License-Identifier: Apache-2.0
"""Builds the Python package by CMake.

The environment variable CMAKE_ARGS holds options for CMake. NEF_BUILD_TREE names a build tree that is there already, and
whose Python package is packed as it is.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

import setuptools
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


class BuildByCMake(build_ext):
    """Builds the target nef_python and puts what its component installs where setuptools collects files."""

    def run(self):
        if self.inplace:
            raise SystemExit("an editable installation is PYTHONPATH=build/release/python; see docs/python.md")
        tree = os.environ.get("NEF_BUILD_TREE")
        if tree is None:
            tree = pathlib.Path(self.build_temp).resolve() / "tree"
            subprocess.run(["cmake", "-S", str(ROOT), "-B", str(tree), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            "-DNEF_BUILD_TESTS=OFF", "-DNEF_BUILD_BENCH=OFF", f"-DNEF_PYTHON={sys.executable}",
                            *shlex.split(os.environ.get("CMAKE_ARGS", ""))], check=True)
            subprocess.run(["cmake", "--build", str(tree), "--target", "nef_python"], check=True)
        installed = pathlib.Path(self.build_temp).resolve() / "installed"
        shutil.rmtree(installed, ignore_errors=True)
        subprocess.run(["cmake", "--install", str(tree), "--component", "python", "--strip", "--prefix", str(installed)],
                       check=True)
        package = pathlib.Path(self.build_lib) / "nef"
        shutil.copytree(next(installed.glob("**/nef/__init__.py")).parent, package, dirs_exist_ok=True)
        bundle_libraries(package)


def bundle_libraries(package):
    """Copies the libraries of the core beside its modules, which look there first, with their licences where Debian has them."""
    found = {}
    for module in package.glob("_*.so"):
        printed = subprocess.run(["ldd", module], capture_output=True, text=True, check=True).stdout
        found.update(re.findall(rf"((?:{'|'.join(BUNDLED)})[0-9]*[.]so\S*) => (/\S+)", printed))
    for name, path in found.items():
        shutil.copy2(path, package / name)
        for notice in pathlib.Path("/usr/share/doc").glob(re.match("[a-z]+", name).group() + "[0-9]*/copyright"):
            (package / "licenses").mkdir(exist_ok=True)
            shutil.copy2(notice, package / "licenses" / f"{notice.parent.name}.txt")


# Of the core; OpenCV, OMPL and assimp, of applications, come from the system.
BUNDLED = ("libgmp", "libtbb", "libzip", "libpng")

VERSION = re.search('define NEF_VERSION "(.*)"', (ROOT / "nef" / "version.h").read_text()).group(1)

# The one extension stands for all that CMake builds; it makes the wheel one for this platform.
setuptools.setup(version=VERSION, packages=[], ext_modules=[setuptools.Extension("nef._nef", [])],
                 cmdclass={"build_ext": BuildByCMake})
