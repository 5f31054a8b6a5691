#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What can be checked of the recipes in packaging/ without vcpkg, rattler-build and Homebrew: each can be parsed, names every library
that CMake requires, and passes only options that CMake has; the port of vcpkg runs with stubs in place of vcpkg's functions.

Usage: scripts/checks/check_recipes.py
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PACKAGING = ROOT / "packaging"
SOURCES = [ROOT / "nef", ROOT / "apps"]
# What CMake looks for, by the words of find_package and find_path, and its name in vcpkg, conda-forge and Homebrew.
LIBRARIES = {
    "gmpxx.h": ("gmp", "gmp", "gmp"),
    "TBB": ("tbb", "tbb-devel", "tbb"),
    "xxh3.h": ("xxhash", "xxhash", "xxhash"),
    "Eigen3": ("eigen3", "eigen", "eigen"),
    "zip.h": ("libzip", "libzip", "libzip"),
    "expat.h": ("expat", "expat", "expat"),
    "OpenMesh": ("openmesh", "openmesh", "open-mesh"),
    "OpenCV": ("opencv4", "libopencv", "opencv"),
    "fmt": ("fmt", "fmt", "fmt"),
    "PNG": ("libpng", "libpng", "libpng"),
    "matio.h": ("matio", "libmatio", "libmatio"),
    "CLI11": ("cli11", "cli11", "cli11"),
    "nlohmann_json": ("nlohmann-json", "nlohmann_json", "nlohmann-json"),
    "ZLIB": ("zlib", "zlib", "zlib"),
    # Of the planner, which is left out without them.
    "ompl": ("ompl", "ompl", "ompl"),
    "Boost": ("boost-graph", "libboost-devel", "boost"),
    "assimp": ("assimp", "libassimp", "assimp"),
}
# Parts of the compiler, or of programs that no recipe builds.
NO_LIBRARY = {"Threads", "MPI", "PkgConfig", "urdf_parser", "urdf_model", "console_bridge"}
STUBS = """
function(vcpkg_check_features)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "OUT_FEATURE_OPTIONS" "FEATURES;INVERTED_FEATURES")
  list(GET arg_FEATURES 1 option)
  set(${arg_OUT_FEATURE_OPTIONS} "-D${option}=ON" PARENT_SCOPE)
endfunction()
function(vcpkg_cmake_configure)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "SOURCE_PATH" "OPTIONS")
  if(arg_UNPARSED_ARGUMENTS OR NOT EXISTS "${arg_SOURCE_PATH}/CMakeLists.txt")
    message(FATAL_ERROR "no sources in '${arg_SOURCE_PATH}', or unknown arguments: ${arg_UNPARSED_ARGUMENTS}")
  endif()
endfunction()
function(vcpkg_cmake_install)
endfunction()
function(vcpkg_cmake_config_fixup)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "PACKAGE_NAME;CONFIG_PATH" "")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_PACKAGE_NAME STREQUAL "nef")
    message(FATAL_ERROR "the package is nef, not '${arg_PACKAGE_NAME}'")
  endif()
endfunction()
function(vcpkg_fixup_pkgconfig)
endfunction()
function(vcpkg_install_copyright)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "" "FILE_LIST")
  if(NOT EXISTS "${arg_FILE_LIST}")
    message(FATAL_ERROR "no licence in '${arg_FILE_LIST}'")
  endif()
endfunction()
"""


def required() -> set[str]:
    """The keys of LIBRARIES that CMake looks for."""
    found = set()
    for folder in SOURCES:
        for path in folder.rglob("CMakeLists.txt"):
            text = path.read_text(encoding="utf-8")
            found.update(re.findall(r"find_package\((\w+)", text))
            found.update(name.split("/")[0] for name in re.findall(r"find_path\(\w+ ([\w./]+)", text))
    return found - NO_LIBRARY


def cmake_options() -> set[str]:
    found = {"CMAKE_BUILD_TYPE", "CMAKE_INSTALL_PREFIX"}
    for path in (ROOT / "CMakeLists.txt", *(ROOT / "cmake").glob("*.cmake")):
        found.update(re.findall(r"option\((\w+)", path.read_text(encoding="utf-8")))
    return found


def run(*words: str) -> str:
    """What a command complains of; "" if it succeeds."""
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else (done.stdout + done.stderr).strip()


def vcpkg_problems() -> list[str]:
    port = json.loads((PACKAGING / "vcpkg" / "vcpkg.json").read_text(encoding="utf-8"))
    listed = port["dependencies"] + port["features"]["apps"]["dependencies"]
    names = {item if isinstance(item, str) else item["name"] for item in listed}
    problems = [f"vcpkg.json lacks {name}" for name in sorted({LIBRARIES[key][0] for key in required()} - names)]
    with tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(folder) / "port.cmake"
        script.write_text(f'{STUBS}set(CURRENT_PORT_DIR "{PACKAGING / "vcpkg"}")\nset(CURRENT_PACKAGES_DIR "{folder}/packages")\n'
                          f'include("{PACKAGING / "vcpkg" / "portfile.cmake"}")\n', encoding="utf-8")
        complaint = run("cmake", "-P", str(script))
    return problems + ([f"portfile.cmake: {complaint}"] if complaint else [])


def conda_problems() -> list[str]:
    text = (PACKAGING / "conda" / "recipe.yaml").read_text(encoding="utf-8")
    host = re.search(r"host: \[(.*)\]", text)
    names = {name.strip() for name in host.group(1).split(",")} if host else set()
    problems = [f"recipe.yaml lacks {name}" for name in sorted({LIBRARIES[key][1] for key in required()} - names)]
    try:
        import yaml
    except ImportError:
        return problems
    recipe = yaml.safe_load(text)
    if not (PACKAGING / "conda" / recipe["source"]["path"] / "CMakeLists.txt").exists():
        problems.append("recipe.yaml: no sources where source.path says")
    for line in recipe["build"]["script"]:
        complaint = run("bash", "-n", "-c", line)
        problems += [f"recipe.yaml: {complaint}"] if complaint else []
    return problems


def homebrew_problems() -> list[str]:
    path = PACKAGING / "homebrew" / "nef-suite.rb"
    names = set(re.findall(r'depends_on "([\w-]+)"', path.read_text(encoding="utf-8")))
    problems = [f"nef-suite.rb lacks {name}" for name in sorted({LIBRARIES[key][2] for key in required()} - names)]
    complaint = run("ruby", "-c", str(path)) if shutil.which("ruby") else ""
    return problems + ([f"nef-suite.rb: {complaint}"] if complaint else [])


def main() -> int:
    unknown = required() - set(LIBRARIES)
    if unknown:
        print(f"CMake looks for {', '.join(sorted(unknown))}; say in scripts/checks/check_recipes.py what recipes call it")
        return 1
    problems = vcpkg_problems() + conda_problems() + homebrew_problems()
    known = cmake_options()
    for path in sorted(PACKAGING.rglob("*")):
        if path.suffix in (".cmake", ".yaml", ".rb"):
            text = path.read_text(encoding="utf-8")
            problems += [f"{path.name} passes {name}, which CMake does not have"
                         for name in re.findall(r"-D([A-Z]\w+)=", text) if name not in known]
    print("\n".join(problems) or "the recipes name what CMake requires")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
