#!/usr/bin/env python3
"""Tests of ci_selection: nothing is left out for more than three runs in a row, with a record and without one."""
import contextlib
import io
import os
import random
import tempfile
import unittest
from unittest import mock

import ci_selection


class Selection(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.addCleanup(setattr, ci_selection, "UNSEEN", ci_selection.UNSEEN)
        self.addCleanup(setattr, ci_selection, "git", ci_selection.git)
        ci_selection.UNSEEN = os.path.join(self.folder.name, "build", "unseen.json")
        self.commits = 1000
        ci_selection.git = lambda *arguments: str(self.commits)

    def look(self, items: dict[str, list[str]], first: set[str], most: int) -> tuple[list[str], bool]:
        """What is looked at, one after the other, when there is time for so many items that are not due."""
        looked: list[str] = []
        clock = iter([0.0] * (most + 1) + [1.0] * len(items))
        with mock.patch("time.monotonic", lambda: next(clock)), mock.patch("os.cpu_count", lambda: 1), \
                contextlib.redirect_stdout(io.StringIO()):
            complete = ci_selection.look_at(items, first, 0.5, lambda item, _: not looked.append(item))
        return looked, complete

    def test_nothing_is_left_out_four_times_in_a_row_by_runs_that_pass(self) -> None:
        rng = random.Random(1)
        items = {f"item{i}": [f"item{i}"] for i in range(40)}
        left_out = dict.fromkeys(items, 0)
        for _ in range(60):
            self.commits += rng.randint(0, 6)  # several runs of one commit, or few runs of many
            first = {item for item in items if rng.random() < 0.5}
            looked, complete = self.look(items, first, rng.choice([5, 20, 35]))
            for item in items:
                left_out[item] = 0 if item in looked else left_out[item] + 1
            if complete:
                self.assertLessEqual(max(left_out.values()), ci_selection.DUE)

    def test_fresh_clones_of_four_successive_commits_see_everything(self) -> None:
        # A unit of several sources is due by one of them, so not each time.
        items = {f"unit{i}": [f"nef/folder/source{i}{k}.cpp" for k in "abcdefgh"] for i in range(300)}
        seen: set[str] = set()
        for _ in range(4):
            if os.path.exists(ci_selection.UNSEEN):
                os.remove(ci_selection.UNSEEN)
            due = ci_selection.Choice(items, set(), lambda part: int(part[len("nef/folder/source"):-len("a.cpp")])).due
            self.assertLess(len(due), 120)
            seen |= due
            self.commits += 1
        self.assertEqual(seen, set(items))

    def test_what_changed_comes_before_the_rest_and_after_what_is_due(self) -> None:
        items = {"a": ["a"], "b": ["b"], "c": ["c"]}
        ci_selection.record({"a": 3, "b": 0, "c": 2})
        self.assertEqual(self.look(items, {"b"}, 1), (["a", "b"], True))
        self.assertEqual(ci_selection.recorded(), {"a": 0, "b": 0, "c": 3})
        self.assertEqual(self.look(items, {"b"}, 0), (["c"], True))

    def test_what_is_due_is_begun_when_there_is_no_time_for_others(self) -> None:
        ci_selection.record({"a": 3, "b": 4, "c": 0})
        self.assertEqual(self.look({"a": ["a"], "b": ["b"], "c": ["c"]}, set(), 0), (["b", "a"], True))
        self.assertEqual(ci_selection.recorded(), {"a": 0, "b": 0, "c": 1})

    def test_items_are_in_the_quarters_that_are_given(self) -> None:
        items = {"a": ["a"], "b": ["b"], "c": ["c"]}
        for self.commits in range(8):
            if os.path.exists(ci_selection.UNSEEN):
                os.remove(ci_selection.UNSEEN)
            due = []
            with contextlib.redirect_stdout(io.StringIO()):
                ci_selection.look_at(items, set(), 100, lambda item, is_due: due.append(item) or True if is_due else True,
                                     at_once=1, quarters={"a": 0, "b": 1, "c": 1})
            self.assertEqual(sorted(due), {0: [], 1: ["a"], 2: ["b", "c"], 3: []}[self.commits % 4])

    def test_what_does_not_come_to_its_end_was_not_looked_at(self) -> None:
        ci_selection.record({"a": 3})
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertFalse(ci_selection.look_at({"a": ["a"]}, set(), 100, lambda item, _: False))
        self.assertEqual(ci_selection.recorded(), {"a": 4})

    def test_a_unit_is_as_old_as_its_oldest_part(self) -> None:
        ci_selection.record({"x": 0, "y": 3, "z": 0})
        self.assertEqual(ci_selection.Choice({"one": ["x", "y"], "two": ["z"]}, set(), ord).due, {"one"})

    def test_a_damaged_record_counts_as_none(self) -> None:
        os.makedirs(os.path.dirname(ci_selection.UNSEEN))
        with open(ci_selection.UNSEEN, "w", encoding="utf-8") as file:
            file.write("[1, 2")
        self.assertEqual(ci_selection.recorded(), {})


if __name__ == "__main__":
    unittest.main()
