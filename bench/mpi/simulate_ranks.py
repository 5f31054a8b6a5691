#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How long a union takes on many ranks, simulated from the seconds of tasks that a run of nef_mpi has measured.

Usage: simulate_ranks.py TIMES.csv FACETS [--target N] [--message S] [--index S] [--glue S]

TIMES.csv is what `nef_mpi union ... --times TIMES.csv` wrote; FACETS is the number of facets of its result. The model: a
larger problem has more tasks of the same kind, whose seconds are drawn from those measured; rank 0 deals them out in
order, one message after the other, and whoever is free gets the next one; when all is done it reads the index of every
region. With --glue it glues the whole, on one core. Not in the model: a slower file system under more load, and ranks
that share memory bandwidth.

  --target N   facets of the simulated result (default 1e9)
  --message S  seconds of rank 0 for a task (default 2e-5)
  --index S    seconds of rank 0 to read the index of a region (default 1e-4)
  --grain K    tasks K times as large, and as many fewer (default 1)
  --glue S     seconds to glue a million facets (default: tiles are not glued)
"""
import argparse
import csv
import heapq
import random


def simulate(tasks, ranks, message):
    """The seconds until the last task is done: each rank asks the dealer, which answers one at a time."""
    free = [0.0] * min(ranks, len(tasks))
    dealer = 0.0
    for seconds in tasks:
        dealer = max(dealer, heapq.heappop(free)) + message
        heapq.heappush(free, dealer + seconds)
    return max(free)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("times")
    parser.add_argument("facets", type=float)
    parser.add_argument("--target", type=float, default=1e9)
    parser.add_argument("--message", type=float, default=2e-5)
    parser.add_argument("--index", type=float, default=1e-4)
    parser.add_argument("--grain", type=int, default=1)
    parser.add_argument("--glue", type=float)
    arguments = parser.parse_args()
    measured = {}
    with open(arguments.times, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            measured.setdefault(row["phase"], []).append(float(row["seconds"]))
    random.seed(1)
    factor = arguments.target / arguments.facets
    phases = {}
    for name, seconds in measured.items():
        count = max(1, round(len(seconds) * factor / arguments.grain))
        phases[name] = [sum(random.choices(seconds, k=arguments.grain)) for _ in range(count)]
        print(f"{name}: {len(seconds)} tasks measured, {sum(seconds) / len(seconds):.3f} s each; {count} simulated")
    regions = len(phases.get("regions", []))
    tail = regions * arguments.index
    if arguments.glue is not None:
        tail += arguments.glue * arguments.target / 1e6
    whole = sum(sum(tasks) for tasks in phases.values()) + tail
    print(f"on one rank {whole:.0f} s, of which {tail:.0f} s are rank 0 alone at the end")
    print(f"{'ranks':>7} {'seconds':>10} {'speedup':>8} {'efficiency':>10}")
    for ranks in (1, 2, 4, 8, 16, 64, 256, 1024, 4096, 10000):
        seconds = sum(simulate(tasks, ranks, arguments.message) for tasks in phases.values()) + tail
        print(f"{ranks:>7} {seconds:>10.1f} {whole / seconds:>8.1f} {whole / seconds / ranks:>10.2f}")


if __name__ == "__main__":
    main()
