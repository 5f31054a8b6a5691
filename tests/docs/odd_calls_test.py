#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of odd_calls: what it finds fault with, that it goes on behind a crash, and what it reads in stubs."""
import argparse
import pathlib
import tempfile
import unittest
from unittest import mock

import odd_calls

CHILD = """import os, signal, sys, time
first, last, log = sys.argv[sys.argv.index("--part") + 1:][:3]
with open(log, "a", buffering=1) as file:
    for i in range(int(first), int(last)):
        file.write(f"{i}: f({i})\\n")
        if i == 2:
            file.write("2! refused in 7 lines\\n")
        if i == 3:
            AT_THREE
    file.write("done\\n")
"""


class Nef:
    class Error(Exception):
        pass


class OddCalls(unittest.TestCase):
    def run_with(self, at_three: str) -> list[list[str]]:
        """What is told of the calls 0 to 5, batch by batch, if the fourth one does that."""
        told = []
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "child.py").write_text(CHILD.replace("AT_THREE", at_three))
            options = argparse.Namespace(package=folder, seed=1)
            first = 0
            with mock.patch.object(odd_calls, "__file__", str(folder / "child.py")), mock.patch.object(odd_calls, "LIMIT", 1):
                while first < 6:
                    first, lines = odd_calls.run_batch(options, first, 6, folder)
                    told.append(lines)
        return told

    def test_calls_that_end_well(self) -> None:
        self.assertEqual(self.run_with("pass"), [["0: f(0)", "1: f(1)", "2: f(2)", "2! refused in 7 lines", "3: f(3)", "4: f(4)", "5: f(5)"]])

    def test_a_crash_and_a_hang_are_found_and_calls_go_on_behind_them(self) -> None:
        for at_three, said in (("os.kill(os.getpid(), signal.SIGSEGV)", "3! exit code -11"), ("time.sleep(9)", "3! not done in 1 s")):
            first, second = self.run_with(at_three)
            self.assertTrue(first[-1].startswith(said), first[-1])
            self.assertEqual(second, ["4: f(4)", "5: f(5)"])

    def test_what_is_wrong_with_an_exception(self) -> None:
        for good in (Nef.Error("a mesh needs faces"), TypeError("box() lacks the argument 'high'"), odd_calls.Raised("mine")):
            self.assertIsNone(odd_calls.complaint(Nef, good))
        for bad in (KeyError("name"), RuntimeError("Unable to cast Python instance"), Nef.Error("a\nb\nc"), TypeError(""), MemoryError("std::bad_alloc"),
                    ValueError("internal error, please report: an edge has two ends")):
            self.assertIsNotNone(odd_calls.complaint(Nef, bad), bad)

    def test_parameters_in_stubs(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            stub = pathlib.Path(name, "x.pyi")
            stub.write_text("def f(a: int, b: int = ..., *, c: int, d: int = ...) -> int: ...\nclass A:\n    def g(self, a: int) -> None: ...\n")
            self.assertEqual(odd_calls.parameters_in_stub(stub), {"f": [("a", True, False), ("b", False, False), ("c", True, True), ("d", False, True)],
                                                                  "A.g": [("a", True, False)]})


if __name__ == "__main__":
    unittest.main()
