#!/usr/bin/env python3
"""What `lockstep verify` says of some trees is what the model checker SPIN says of them.

The meaning of Sequence, Fallback, Parallel and ParallelAbsolute is written here a second time, as a
model in Promela. Each state between two ticks is printed while SPIN searches; their number, and the
results that can come, must be those of verify. So must be whether each fair run ends, which SPIN finds as a property
of linear time. Without spin and gcc the test is skipped.

    spin_test.py LOCKSTEP
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
UNIT = 48  # of progress: 1 as a whole number
IDLE, RUNNING, SUCCESS, FAILURE = range(4)

# A leaf is "a"; "s" if it only succeeds; "w" if it only succeeds by going to the end, from one cut of
# its progress to the next. A Sequence or Fallback with * has memory; barriers are in 48ths.
TREES = [
    ("Sequence", "a"),
    ("Sequence", "a", "a", "a"),
    ("Sequence*", "a", "a", "a"),
    ("Fallback", "a", "a"),
    ("Fallback*", "a", ("Sequence*", "a", "a"), "a"),
    ("Fallback", ("Sequence", "a", "a"), ("Sequence", "a", "a")),
    ("Fallback*", "a", ("Sequence*", "a", "s"), "s"),
    ("Sequence", ("Sequence", "s", "s"), ("Parallel", "s", "s")),
    ("Parallel", "a", "a", "a"),
    ("Parallel", ("Sequence*", "a", "a"), ("Fallback*", "a", "a")),
    ("Sequence*", ("Parallel", "a", "a"), ("Parallel", "a", "a", "a")),
    ("Sequence", ("Fallback", "a", "a"), ("Parallel", "a", "a")),
    ("ParallelAbsolute 24", "a", "a"),
    ("ParallelAbsolute 12 24 36", "a", "a", "a"),
    ("ParallelAbsolute 16 32", ("Parallel", "a", "a"), "a"),
    ("ParallelAbsolute 12 36", ("Sequence*", "a", "a"), "a"),
    ("ParallelAbsolute 12 36", ("Sequence*", "a", "a"), ("Fallback*", "a", "a")),
    ("ParallelAbsolute 12 36", ("Sequence", "a", "a"), "a"),
    ("ParallelAbsolute 24", ("ParallelAbsolute 12 36", "a", "a"), "a"),
    ("ParallelAbsolute 16 32", "s", ("Fallback*", "a", "s"), "s"),
    ("ParallelAbsolute 24", "w", "w"),
    ("ParallelAbsolute 12 24 36", "w", "w", "w"),
    ("ParallelAbsolute 16 32", ("Parallel", "w", "w"), "w"),
    ("ParallelAbsolute 12 36", ("Sequence*", "w", "w"), ("Fallback*", "a", "w")),
    ("ParallelAbsolute 24", ("ParallelAbsolute 12 36", "w", "w"), "w"),
    ("Fallback*", ("ParallelAbsolute 24", "a", "a"), ("Sequence*", "a", "a")),
    ("Sequence*", "a", ("ParallelAbsolute 16 32", "a", "a"), "a"),
]


class Node:
    def __init__(self, tree, nodes):
        self.number = len(nodes)
        nodes.append(self)
        kind, *self.barriers = (tree if isinstance(tree, str) else tree[0]).split()
        self.barriers = [int(it) for it in self.barriers]
        self.kind, self.memory = kind.rstrip("*"), kind.endswith("*")
        self.children = [] if isinstance(tree, str) else [Node(it, nodes) for it in tree[1:]]
        self.levels = {0}

    def below(self):
        for child in self.children:
            yield child
            yield from child.below()

    def cut(self, barriers):
        """Tells leaves apart where the barriers above compare them."""
        barriers = set(barriers) | set(self.barriers)
        for place, child in enumerate(self.children):
            if self.kind == "Sequence":
                count = len(self.children)
                child.cut(it for it in (count * b - place * UNIT for b in barriers) if 0 < it < UNIT)
            else:
                child.cut(barriers)
        if not self.children:
            self.levels |= barriers

    def xml(self):
        if not self.children:
            return f'<Advance name="{self.kind}"/>'
        attributes = ' memory="true"' if self.memory else ""
        if self.barriers:
            attributes += ' barriers="%s"' % ";".join(repr(b / UNIT) for b in self.barriers)
        return f"<{self.kind}{attributes}>{''.join(c.xml() for c in self.children)}</{self.kind}>"

    # --- Promela ---------------------------------------------------------------------------------

    def reset(self):
        return "".join(f"st[{n.number}]=0; lv[{n.number}]=0; " for n in self.below())

    def progress(self):
        """Puts it into p[number]."""
        i = self.number
        if not self.children:
            running = f"p[{i}]=lv[{i}]"
        elif self.kind in ("Sequence", "Fallback"):
            # The child at which the last tick stopped is the one that runs.
            cases = ""
            for place, child in enumerate(self.children):
                value = f"p[{child.number}]"
                if self.kind == "Sequence":
                    value = f"({place * UNIT}+{value})/{len(self.children)}"
                cases += f":: st[{child.number}]==1 -> {child.progress()}; p[{i}]={value} "
            running = f"if {cases}fi"
        else:
            running = f"p[{i}]={UNIT}"
            for child in self.children:
                c = child.number
                running += (f"; {child.progress()}; "
                            f"if :: p[{c}]<p[{i}] -> p[{i}]=p[{c}] :: else fi")
        return (f"if :: st[{i}]==1 -> {running} :: st[{i}]==2 -> p[{i}]={UNIT} "
                f":: else -> p[{i}]=0 fi")

    def tick(self):
        i = self.number
        if not self.children:
            return f"ticked[{i}]=1; {self.tick_leaf()}"
        text = self.tick_ordered() if self.kind in ("Sequence", "Fallback") else self.tick_parallel()
        return f"{text} st[{i}]=r[{i}]; r[{i}]=0; if :: st[{i}]!=1 -> {self.reset()}:: else fi"

    def tick_leaf(self):
        i = self.number
        if self.kind == "w":
            return self.tick_walker()
        goes_on = "".join(f":: lv[{i}]<={it} -> lv[{i}]={it} " for it in sorted(self.levels))
        fails = "" if self.kind == "s" else f":: st[{i}]=3; lv[{i}]=0 "
        return (f"if :: st[{i}]!=1 -> lv[{i}]=0 :: else fi; "
                f"if :: st[{i}]=2; lv[{i}]=0 {fails}:: st[{i}]=1; if {goes_on}fi fi")

    def tick_walker(self):
        i, levels = self.number, sorted(self.levels)
        cases = ""
        for level, after in zip(levels, levels[1:] + [None]):
            step = f"lv[{i}]={after}" if after else f"st[{i}]=2; lv[{i}]=0"
            cases += f":: lv[{i}]=={level} -> if :: skip :: {step} fi "
        return f"if :: st[{i}]!=1 -> lv[{i}]=0 :: else fi; st[{i}]=1; if {cases}fi"

    def tick_ordered(self):
        i = self.number
        goes_on = SUCCESS if self.kind == "Sequence" else FAILURE
        text = ""
        for place, child in enumerate(self.children):
            c = child.number
            later = "".join(f"st[{n.number}]=0; lv[{n.number}]=0; "
                            for it in self.children[place + 1:] for n in (it, *it.below()))
            tick = (f"{child.tick()}; if :: st[{c}]!={goes_on} -> r[{i}]=st[{c}]; {later}"
                    f":: else fi")
            if self.memory:
                tick = f"if :: st[{c}]=={goes_on} -> skip :: else -> {tick} fi"
            text += f"if :: r[{i}]==0 -> {tick} :: else fi; "
        return text + f"if :: r[{i}]==0 -> r[{i}]={goes_on} :: else fi;"

    def tick_parallel(self):
        i = self.number
        text = ""
        if self.barriers:
            text += f"least={UNIT}; "
            for child in self.children:
                c = child.number
                text += (f"{child.progress()}; "
                         f"if :: p[{c}]<least -> least=p[{c}] :: else fi; ")
            text += f"limit[{i}]={UNIT + 1}; "
            for barrier in reversed(self.barriers):
                text += f"if :: least<{barrier} -> limit[{i}]={barrier} :: else fi; "
            # Before any child is ticked: what they tick would write over it.
            for child in self.children:
                c = child.number
                text += f"held[{c}]=(p[{c}]>=limit[{i}]); "
            text += f"limit[{i}]=0; least=0; "
        for child in self.children:
            c = child.number
            text += (f"if :: st[{c}]>1 || held[{c}] -> skip :: else -> {child.tick()} fi; "
                     f"held[{c}]=0; ")
        succeeded = " && ".join(f"st[{c.number}]==2" for c in self.children)
        failed = " || ".join(f"st[{c.number}]==3" for c in self.children)
        return text + f"if :: {succeeded} -> r[{i}]=2 :: {failed} -> r[{i}]=3 :: else -> r[{i}]=1 fi;"


def fairness(leaves):
    """A run is fair if each leaf is at last not ticked any more, or ends again and again, by a result or a halt. From
    some tick on those that are not ticked any more are guessed; the others end in turn, which is accepted."""
    began = " ".join(f"if :: quiet[{i}]=1 :: skip fi;" for i in leaves)
    quiet = " && ".join(f"!(quiet[{i}] && ticked[{i}])" for i in leaves)
    turns = " ".join(f":: turn=={place} && (quiet[{i}] || ended[{i}]) -> turn={place + 1}"
                     for place, i in enumerate(leaves))
    count = len(leaves)
    return f"""
    if :: phase==0 -> skip :: phase==0 -> phase=1; {began} :: phase==1 && ({quiet}) -> if {turns} :: else fi fi;
    if :: turn=={count} -> turn=0; accept_all: skip :: else fi"""


def promela(nodes, liveness):
    root, count = nodes[0], len(nodes)
    shown = ",".join(f"st[{i}],lv[{i}]" for i in range(count))
    clear = "".join(f"p[{i}]=0; " for i in range(count))
    words = " ".join(["%d"] * 2 * count)
    leaves = [it.number for it in nodes if not it.children]
    before, after, fair = "", "".join(f"ticked[{i}]=0; " for i in leaves), ""
    if liveness:  # more states
        before = "".join(f"ticked[{i}]=0; ended[{i}]=(st[{i}]==1); " for i in leaves)
        after = "".join(f"ended[{i}]=((ended[{i}] || ticked[{i}]) && st[{i}]!=1); " for i in leaves)
        fair = ";" + fairness(leaves)
    return f"""byte st[{count}], lv[{count}], r[{count}], p[{count}], limit[{count}]; bit held[{count}];
bit ticked[{count}], ended[{count}], quiet[{count}], phase;
byte least, turn;
active proctype tree() {{
  do
  :: st[0]<=1 -> atomic {{ printf("state {words}\\n",{shown}); {before}{root.tick()}; {clear}{after} }}{fair}
  :: st[0]==2 -> printf("result success\\n"); break
  :: st[0]==3 -> printf("result failure\\n"); break
  od
}}
"""


def run(command, directory):
    done = subprocess.run(command, cwd=directory, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: {done.stdout}{done.stderr}")
    return done.stdout


def search(nodes, directory, liveness, *options):
    with open(os.path.join(directory, "tree.pml"), "w") as file:
        file.write(promela(nodes, liveness))
    run(["spin", "-a", "tree.pml"], directory)
    run(["gcc", "-w", "-o", "pan", "pan.c", *options], directory)
    said = run(["./pan", "-m1000000", *(["-a", "-E"] if liveness else [])], directory)
    if "search depth too small" in said:
        sys.exit(said)
    return said


def by_spin(tree, directory):
    nodes = []
    Node(tree, nodes).cut([])
    said = search(nodes, directory, False, "-DPRINTF", "-DSAFETY")
    if "errors: 0" not in said:
        sys.exit(said)
    states = set(re.findall(r"^\s*(state .*)$", said, re.M))
    results = sorted(set(re.findall(r"^\s*result (\w+)$", said, re.M)))
    # What blocks is an unfair run.
    return len(states), results, "acceptance cycle" not in search(nodes, directory, True)


def by_verify(tree, directory, lockstep):
    text = Node(tree, []).xml()
    with open(os.path.join(directory, "tree.xml"), "w") as file:
        file.write('<root lockstep="1"><plugin name="motion"/><BehaviorTree ID="T">'
                   f"{text}</BehaviorTree></root>")
    with open(os.path.join(directory, "tree.leaves.xml"), "w") as file:
        rows = '<leaf path="*/s*" result="success"/>' if 'name="s"' in text else ""
        if 'name="w"' in text:
            rows += '<leaf path="*/w*" result="success" finish="full" step="0..1"/>'
        file.write(f'<leaves lockstep="1">{rows}</leaves>')
    done = subprocess.run([lockstep, "verify", "tree.xml", "--leaves", "tree.leaves.xml", "--json",
                           "--no-symmetry"],
                          cwd=directory, capture_output=True, text=True)
    if done.returncode not in (0, 1):
        sys.exit(done.stderr)
    found = json.loads(done.stdout)
    ends = found["facts"]["always ends"] == "yes"
    return found["states"], sorted(it.lower() for it in found["results"]), ends


def main():
    lockstep = os.path.abspath(sys.argv[1])
    missing = [it for it in ("spin", "gcc") if shutil.which(it) is None]
    if missing:
        print(f"skipped: there is no {' and no '.join(missing)}")
        sys.exit(SKIPPED)
    failed = 0
    for tree in TREES:
        with tempfile.TemporaryDirectory() as directory:
            spin, verify = by_spin(tree, directory), by_verify(tree, directory, lockstep)
        print("ok" if spin == verify else "NOT ok", tree, "spin", spin, "verify", verify)
        failed += spin != verify
    sys.exit(1 if failed else 0)


main()
