#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of odd_commands: what it finds fault with, that a seed gives the same commands, and that it looks where commands end."""
import pathlib
import random
import stat
import tempfile
import unittest
from unittest import mock

import odd_commands
import paths_corpus


class OddCommands(unittest.TestCase):
    def test_what_is_wrong_with_an_end(self) -> None:
        for code in (0, 1, 3, 4, 5):
            self.assertIsNone(odd_commands.complaint(code, ""))
        for code in (-11, 6, 124, 134):
            self.assertIn(str(code), odd_commands.complaint(code, "nef: no"))
        self.assertIsNone(odd_commands.complaint(2, "nef: a.off: no such file; check the path\n"))
        self.assertIsNone(odd_commands.complaint(2, "nef: note: a face is bent\nnef: b.off: line 2: not a number\n"))
        for error in ("", "a\nb\nc\n", "terminate called after throwing an instance of 'std::out_of_range'\n"):
            self.assertIsNotNone(odd_commands.complaint(2, error), error)

    def test_a_seed_gives_the_same_commands_and_the_first_words_stay(self) -> None:
        command = ["nef", "convert", "a.off", "-o", "b.nef"]
        options = [("--json", None), ("--format", ["nef", "off"])]
        made = [odd_commands.nearly(random.Random(seed), command, options) for seed in range(200)]
        self.assertEqual(made, [odd_commands.nearly(random.Random(seed), command, options) for seed in range(200)])
        self.assertTrue(all(words[:2] == command[:2] for words in made))
        self.assertGreater(len({tuple(words) for words in made}), 100)

    def test_a_crash_and_a_hang_are_found(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for program, text in (("crash", "kill -SEGV $$"), ("hang", "exec sleep 5"), ("good", "exit 0")):
                path = folder / program
                path.write_text(f"#!/bin/sh\n{text}\n")
                path.chmod(path.stat().st_mode | stat.S_IXUSR)
            limit, odd_commands.LIMIT = odd_commands.LIMIT, 1
            self.addCleanup(setattr, odd_commands, "LIMIT", limit)
            as_it_is = mock.patch.object(odd_commands, "nearly", lambda _, command, __: command)
            for program, word, found in (("crash", "a", "exit code"), ("hang", "a", "not done in"), ("good", "a", None),
                                         ("hang", "--time", None)):  # it was asked to take long
                case = paths_corpus.Case(program, [[program, word, "9"]])
                with as_it_is, mock.patch.object(odd_commands, "options_of", lambda *_: []):
                    _, wrong = odd_commands.attempt(1, 1, folder, [case], folder)
                if found is None:
                    self.assertIsNone(wrong)
                else:
                    self.assertIn(found, wrong)


if __name__ == "__main__":
    unittest.main()
