# SPDX-License-Identifier: Apache-2.0
"""Sets in notebooks, and as pages in a browser."""
import os
from typing import Any, Optional, Sequence, Union

from . import _nef
from ._nef import Polyhedron
from .errors import InputError

#: above this number of vertices a notebook shows a picture instead of a page, which would contain every number
PAGE_LIMIT = 20000


def _names(sets, names):
    if names is None:
        return [f"set {i + 1}" for i in range(len(sets))]
    names = [str(name) for name in names]
    if len(names) != len(sets):
        raise InputError(f"{len(sets)} sets need as many names, not {len(names)}")
    return names


def _checked(sets):
    for a in sets:
        if not isinstance(a, Polyhedron):
            hint = "; nef.read reads a file" if isinstance(a, (str, os.PathLike)) else "; several are a, b or *list"
            raise TypeError(f"sets must be of type Polyhedron, not {type(a).__name__}{hint}")
    return list(sets)


def page(*sets: Polyhedron, names: Optional[Sequence[str]] = None, title: str = "nef") -> str:
    """The viewer page of some sets, each a layer, as text: one HTML file that needs nothing else.

    Raises UnsupportedError if the package was built without the viewer.
    """
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "page.html")
        _nef._write_page(_checked(sets), _names(sets, names), path, title)
        with open(path, encoding="utf-8") as file:
            return file.read()


def picture(*sets: Polyhedron, width: int = 640, height: int = 480, direction: Optional[Sequence[Any]] = None,
            section: Optional[Sequence[Any]] = None) -> bytes:
    """A picture of some sets: the bytes of a PNG.

    - direction: three numbers, from the middle of the sets to the eye; from the right, the front and above if None
    - section: four numbers a, b, c, d: only what has a x + b y + c z + d <= 0 is shown, cut exactly
    """
    return _nef._picture(_checked(sets), width, height, direction, section)


def show(*sets: Polyhedron, names: Optional[Sequence[str]] = None, title: str = "nef",
         path: Union[str, "os.PathLike[str]", None] = None, open_browser: bool = True) -> str:
    """Opens a page that shows some sets, each a layer that can be switched and cut; returns the page's path.

    - path: where the page is written; a file in the folder for temporary files if None
    - open_browser: False: only write the page
    """
    import tempfile

    names = _names(sets, names)
    if path is None:
        handle, path = tempfile.mkstemp(prefix="nef-", suffix=".html")
        os.close(handle)
    _nef._write_page(_checked(sets), names, os.fspath(path), title)
    if open_browser:
        import webbrowser

        webbrowser.open("file://" + os.path.abspath(path))
    return os.fspath(path)


def html_of(self):
    """The viewer page in a frame, for notebooks; None if there is no viewer or the set is too large."""
    import html

    if not _nef._has_pages() or sum(self.counts()[:3]) > PAGE_LIMIT:
        return None
    frame = html.escape(page(self), quote=True)
    return f'<iframe srcdoc="{frame}" width="100%" height="480" style="border: 0" sandbox="allow-scripts"></iframe>'


def png_of(self):
    """A picture, for notebooks that run no scripts."""
    return picture(self)
