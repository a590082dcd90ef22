#!/usr/bin/env python3
"""The progress distance of the paper's Example 5 by the number of barriers, as in its Figure 3: the more
barriers, the less the three tasks are apart.

    python3 docs/paper/figure3.py [RUNS]
"""
import pathlib
import statistics
import sys

import lockstep

TREE = pathlib.Path(__file__).parents[2] / "trees" / "paper" / "example5.xml"
BARRIERS = [0, 1, 2, 5, 10, 20]
NOISE = [0.01, 0.05]

runs = lockstep.study(TREE, runs=int(sys.argv[1]) if len(sys.argv) > 1 else 1000,
                      grid={"noise": NOISE, "barrier_count": BARRIERS}, measure=["progress-distance"])
if not isinstance(runs, list):  # a DataFrame
    runs = runs.to_dict("records")
for noise in NOISE:
    print(f"noise {noise}: the median of the progress distance")
    for barriers in BARRIERS:
        distances = [run["progress-distance Example5/parallel"] for run in runs
                     if (run["noise"], run["barrier_count"]) == (noise, barriers)]
        middle = statistics.median(distances)
        print(f"{barriers:4} barriers {middle:8.2f} {'*' * round(middle)}")
