# SPDX-License-Identifier: Apache-2.0
"""The reference of the Python package, by Sphinx from the docstrings: cmake --build build/release -t python_reference."""
import importlib.util

project = "nef"
author = "nef suite maintainers"
extensions = ["sphinx.ext.autodoc", "sphinx.ext.napoleon"]
html_theme = "alabaster"
html_theme_options = {"description": "Exact solid geometry", "nosidebar": False}
autodoc_member_order = "bysource"
autodoc_default_options = {"members": True, "undoc-members": False}
napoleon_google_docstring = False
# Applications whose libraries were missing at the build are documented all the same.
autodoc_mock_imports = [f"nef._{name}" for name in ("minkowski", "planner", "remeshing", "visual_hull")
                        if importlib.util.find_spec(f"nef._{name}") is None]
