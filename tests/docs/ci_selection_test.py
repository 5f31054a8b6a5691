#!/usr/bin/env python3
"""Tests of ci_selection: nothing is left out for more than two runs in a row, with a record and without one."""
import os
import random
import tempfile
import unittest

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

    def test_nothing_is_left_out_three_times_in_a_row(self) -> None:
        rng = random.Random(1)
        costs = {f"item{i}": rng.randint(1, 300) for i in range(40)}
        left_out = dict.fromkeys(costs, 0)
        for _ in range(60):
            self.commits += rng.randint(0, 6)  # several runs of one commit, or few runs of many
            first = {item for item in costs if rng.random() < 0.5}
            chosen = ci_selection.choose(costs, first, rng.choice([0, 100, 1000]))
            if rng.random() < 0.8:  # otherwise the run ended before its end, and nothing was seen
                ci_selection.seen(chosen)
                for item in costs:
                    left_out[item] = 0 if item in chosen else left_out[item] + 1
            self.assertLessEqual(max(left_out.values()), ci_selection.DUE)

    def test_fresh_clones_of_three_successive_commits_see_everything(self) -> None:
        costs = {f"nef/folder/source{i}.cpp": 1 for i in range(300)}
        seen: set[str] = set()
        for _ in range(3):
            if os.path.exists(ci_selection.UNSEEN):
                os.remove(ci_selection.UNSEEN)
            chosen = ci_selection.choose(costs, set(), 0)
            self.assertLess(len(chosen), 150)
            seen.update(chosen)
            self.commits += 1
        self.assertEqual(seen, set(costs))

    def test_what_changed_comes_before_the_rest_and_after_what_is_due(self) -> None:
        costs = {"a": 5, "b": 5, "c": 5}
        ci_selection.record({"a": 2, "b": 0, "c": 1})
        self.assertEqual(ci_selection.choose(costs, {"b"}, 10), ["a", "b"])
        self.assertEqual(ci_selection.recorded(), {"a": 3, "b": 1, "c": 2})
        ci_selection.seen(["a", "b"])
        self.assertEqual(ci_selection.choose(costs, {"b"}, 5), ["c"])

    def test_a_unit_is_as_old_as_its_oldest_part(self) -> None:
        ci_selection.record({"x": 0, "y": 2, "z": 0})
        self.assertEqual(ci_selection.choose({"one": 2, "two": 1}, set(), 0, {"one": ["x", "y"], "two": ["z"]}), ["one"])

    def test_a_damaged_record_counts_as_none(self) -> None:
        os.makedirs(os.path.dirname(ci_selection.UNSEEN))
        with open(ci_selection.UNSEEN, "w", encoding="utf-8") as file:
            file.write("[1, 2")
        self.assertEqual(ci_selection.recorded(), {})


if __name__ == "__main__":
    unittest.main()
