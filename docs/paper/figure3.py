#!/usr/bin/env python3
"""Figure 3 of the paper: the predictability distance of Example 7 by the number of barriers. The more
barriers, the nearer is the action to where the profile expects it.

    python3 docs/paper/figure3.py [RUNS]
"""
import pathlib
import statistics
import sys

import lockstep

TREE = pathlib.Path(__file__).parents[2] / "trees" / "paper" / "example7.xml"
BARRIERS = [0, 5, 10, 20, 50]  # 0: not synchronized
NOISE = [0.02, 0.05]
MEASURE = "predictability:action@0.6=600"

runs = lockstep.study(TREE, runs=int(sys.argv[1]) if len(sys.argv) > 1 else 1000,
                      grid={"noise": NOISE, "barrier_count": BARRIERS}, measure=[MEASURE])
if not isinstance(runs, list):  # a DataFrame
    runs = runs.to_dict("records")
column = next(name for name in runs[0] if name.startswith("predictability"))
for noise in NOISE:
    print(f"noise {noise}: the median of the predictability distance, in ticks")
    for barriers in BARRIERS:
        distances = [run[column] for run in runs
                     if (run["noise"], run["barrier_count"]) == (noise, barriers)]
        middle = statistics.median(distances)
        print(f"{barriers:4} barriers {middle:8.1f} {'*' * round(abs(middle) / 10)}")
