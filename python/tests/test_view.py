# SPDX-License-Identifier: Apache-2.0
"""Pictures and pages; that pages work in a browser is tested with those of the programs (tests/view)."""
import html
import struct
import webbrowser

import pytest

import nef
from nef import notebook

BOX = nef.box((0, 0, 0), (1, 2, 3))
needs_viewer = pytest.mark.skipif(not nef._nef._has_pages(), reason="built without the viewer: no node, npm or network")


def size_of(png):
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", png[16:24])


def test_pictures():
    assert size_of(BOX._repr_png_()) == (640, 480)
    assert size_of(notebook.picture(BOX, BOX.translate((5, 0, 0)), width=200, height=100)) == (200, 100)
    pictures = [notebook.picture(BOX), notebook.picture(BOX, direction=(1, 1, "1/2")), notebook.picture(BOX, section=(0, 0, 1, "-1/2"))]
    assert len(set(pictures)) == 3
    for wrong in (dict(direction="top"), dict(section=(0, 0, 1))):
        with pytest.raises(nef.InputError):
            notebook.picture(BOX, **wrong)
    for odd in (nef.empty(), nef.everything(), nef.halfspace(1, 2, 3, 4), nef.point((1, 2, 3))):
        size_of(odd._repr_png_())


@needs_viewer
def test_frames():
    frame = BOX._repr_html_()
    assert frame.startswith("<iframe srcdoc=") and frame.count("<iframe") == 1
    page = html.unescape(frame.split('srcdoc="', 1)[1].split('" width', 1)[0])
    assert page.lstrip().lower().startswith("<!doctype html") and "src=\"http" not in page


@needs_viewer
def test_show(tmp_path, monkeypatch):
    opened = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    path = nef.show(BOX, BOX.interior(), names=["closed & <open>", "b"], path=tmp_path / "page.html", title="two")
    assert opened == ["file://" + path] and path == str(tmp_path / "page.html")
    assert "<title>two</title>" in (tmp_path / "page.html").read_text(encoding="utf-8")
    nef.show(BOX, path=tmp_path / "other.html", open_browser=False)
    assert len(opened) == 1
    with pytest.raises(ValueError):
        nef.show(BOX, names=["a", "b"])


def test_text():
    assert repr(BOX) == "<nef.Polyhedron: 8 vertices, 12 edges, 6 facets, 2 volumes, 2 shells>"
    assert "empty" in repr(nef.empty()) and "all of space" in repr(nef.everything())
