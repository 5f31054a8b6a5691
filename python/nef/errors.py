# SPDX-License-Identifier: Apache-2.0
"""The exceptions and warnings of the suite."""


class Error(Exception):
    """Base class of all exceptions of the suite: bad data or bad use, never a bug. The text is one line."""


class InputError(Error, ValueError):
    """The input (a file, a mesh, an array, a number, an expression) is not valid. A ValueError, too.

    Elements at fault are given by their numbers in the input, counted from 0:

    - vertices: tuple of int
    - edges: tuple of (int, int), each as its two vertices
    - faces: tuple of int
    - offset: the place in an expression, in bytes; or None
    - view: the name of a view of a visual hull; or None
    """

    def __init__(self, *arguments, vertices=(), edges=(), faces=(), offset=None, view=None):
        super().__init__(*arguments)
        self.vertices = tuple(vertices)
        self.edges = tuple(tuple(edge) for edge in edges)
        self.faces = tuple(faces)
        self.offset = offset
        self.view = view


class MissingFileError(InputError, FileNotFoundError):
    """There is no such file."""


class UnsupportedError(Error):
    """The request is well formed but cannot be represented: an unbounded solid as a mesh, say."""


class InputWarning(UserWarning):
    """The input was changed, or only interpreted, or the output lacks something. Filter it by this category."""
