"""As kept.c: kept.py TREE FILE PERIOD [CUT_AT]. It ticks by itself, and with the environment variable LOOP in run().
RECORD is a file."""
import os
import signal
import sys

import lockstep
from lockstep_leaf import Action

TREE, FILE, PERIOD, *CUT_AT = sys.argv[1:]
NUMBERS = {"idle": 0, "running": 1, "success": 2, "failure": 3, "skipped": 4, "restart": 0, "continues": 1}


class Step(Action):
    "Counts its ticks."
    ticks: int = 1

    def start(self):
        self.done = 0

    def tick(self):
        if CUT_AT and self.now >= float(CUT_AT[0]) - 1e-9:
            os.kill(os.getpid(), signal.SIGKILL)
        self.done += 1
        return True if self.done == self.ticks else None

    def progress(self):
        return self.done / self.ticks

    def save(self):
        return self.done

    def restore(self, kept, cut):
        assert cut.on_resume == "restart" and 0 <= cut.gap < 3600 and not cut.power, vars(cut)
        self.done = kept
        return True


tree = lockstep.Tree(TREE, leaves=[Step], period=float(PERIOD))
numbers = {node.path: index for index, node in enumerate(tree.nodes)}
try:
    resumed = tree.keep(FILE, version=os.environ.get("KEPT_VERSION", ""))
except lockstep.Error as error:
    print(f"error: {error}")
    sys.exit(1)
if resumed:
    print(resumed.text)
    for leaf in resumed.leaves:
        print(f"leaf {numbers[leaf.path]} is {NUMBERS[leaf.does]} at {leaf.progress:.2f}, asked {int(leaf.asked)}")
if "RECORD" in os.environ:
    tree.record(os.environ["RECORD"])


@tree.on_tick
def show(tick, seconds, status):
    nodes = "".join(f" {NUMBERS[it.status]}:{it.progress:.2f}{'h' if it.held else ''}" for it in tree.nodes)
    print(f"{tick}{nodes} n={tree.entries['n']}", flush=True)


if "LOOP" in os.environ:
    result = tree.run().summary["result"]
else:
    while tree.tick() == "running":
        pass
    result = tree.status
sys.exit(0 if result == "success" else 1)
