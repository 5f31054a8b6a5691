# SPDX-License-Identifier: Apache-2.0
import importlib
import pathlib
import warnings

import pytest

import nef


@pytest.fixture(autouse=True)
def no_silent_warnings():
    """What a call warns about is expected by the test, or it fails."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", UserWarning)
        yield


@pytest.fixture
def needs():
    """needs("planner") is the module nef.planner; skips the test where it was left out of the build."""

    def module(name):
        if not list(pathlib.Path(nef.__file__).parent.glob(f"_{name}.*.so")):
            pytest.skip(f"built without nef.{name}")
        return nef if name == "nef" else importlib.import_module("nef." + name)

    return module
