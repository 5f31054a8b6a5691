# SPDX-License-Identifier: Apache-2.0
"""The exceptions of the suite."""


class Error(Exception):
    """What every exception of the suite is: bad data or bad use, never a bug. The text is one line for people."""


class InputError(Error, ValueError):
    """The input (a file, a mesh, a number, an expression) cannot mean what it should.

    Where single elements are guilty, they are named by their numbers in the input, counted from 0:

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


class UnsupportedError(Error):
    """The request is well formed but cannot be represented: an unbounded solid as a mesh, say."""
