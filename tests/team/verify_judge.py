"""What `lockstep verify` says of random teams, against what they do.

For each team, verify says how each robot may end, and whether the team can always end. Then
`lockstep team` plays it with many seeds: the leaves do what the same model allows, by chance, and
words take less time than verify allows. No robot may end in a way that verify excludes, and a team
that can always end has to, since each leaf ends by chance.

usage: verify_judge.py LOCKSTEP TEAMS [FIRST [SEEDS]]
"""
import json
import os
import random
import subprocess
import sys
import tempfile

RATE = 10
LAST = 300  # s
ROWS = """  <leaf of="Sure" result="success" progress="grid:4" step="1..2" finish="full"/>
  <leaf of="Unsure" result="success;failure" progress="grid:4" step="0..2" ticks="1..3"/>
"""


def model(tree):
    rows = [row for row in ROWS.splitlines() if "<" + row.split('"')[1] + "/>" in tree]
    return '<leaves lockstep="1" rate="10">\n' + "\n".join(rows) + "\n</leaves>\n"


class Team:
    """Two or three robots, each with a few nodes in a Sequence."""

    def __init__(self, seed):
        self.chance = random.Random(seed)
        self.names = ["a", "b", "c"][: self.chance.choice([2, 2, 3])]
        self.late = self.chance.choice([0, 1]) if len(self.names) == 2 else 0
        self.teams = ["one", "two"][: self.chance.choice([1, 2])]
        self.has_pool = self.chance.random() < 0.5
        self.repeated = [team for team in self.teams if self.chance.random() < 0.2]
        # Mostly all have the same barriers: else nobody moves.
        self.waits = {team: self.some_waits() for team in self.teams}

    def some_waits(self):
        return self.chance.choice(['barriers="0.5"', 'barriers="0"', 'barriers="0;0.5"',
                                   'delta="0.5"'])

    def leaf(self):
        if self.chance.random() < 0.1:
            return f'<Wait seconds="{self.chance.choice([0.2, 0.5, 0.6])}"/>'
        return "<Sure/>" if self.chance.random() < 0.93 else "<Unsure/>"

    def in_step(self, team, inside):
        waits = self.waits[team] if self.chance.random() < 0.97 else self.some_waits()
        give_up = 'give_up="1"' if self.chance.random() < 0.1 else ""
        node = f'<InStep team="{team}" as="${{me}}" {waits} {give_up}>{inside}</InStep>'
        return f'<Repeat times="2">{node}</Repeat>' if team in self.repeated else node

    def uses(self, inside):
        wanted = self.chance.choice(["x", "y", "x;y"])
        return f'<UseResources pool="pool" resources="{wanted}">{inside}</UseResources>'

    def nodes_of(self):
        nodes = []
        for team in self.teams:
            if self.chance.random() < 0.03:
                continue
            inside = self.leaf()
            if self.has_pool and self.chance.random() < 0.1:
                inside = self.uses(inside)
            node = self.in_step(team, inside)
            if self.has_pool and self.chance.random() < 0.1:
                node = self.uses(node)
            if self.chance.random() < 0.1:
                node = f'<Timeout seconds="{self.chance.choice([0.4, 0.9, 1.5])}">{node}</Timeout>'
            nodes.append(node)
        if self.has_pool and self.chance.random() < 0.97:
            nodes.append(self.uses(self.leaf()))
        if self.chance.random() < 0.3:
            nodes.append(self.leaf())
        if self.chance.random() < 0.93:
            return nodes
        self.chance.shuffle(nodes)
        return nodes

    def tree(self):
        text = '<root lockstep="1" main_tree_to_execute="Main"><arg name="me" default="a"/>'
        members = ";".join(self.names)
        for team in self.teams:
            text += f'<team name="{team}" members="{members}"/>'
        if self.has_pool:  # of which each robot that does not use it is a stranger
            text += f'<resources name="pool" team="{self.teams[0]}" as="${{me}}" resources="x;y"/>'
        text += '<BehaviorTree ID="Main"><SubTree ID="${me}"/></BehaviorTree>'
        for name in self.names:
            nodes = self.nodes_of() or [self.leaf()]
            kind = "Fallback" if self.chance.random() < 0.15 else "Sequence"
            text += (f'<BehaviorTree ID="{name}"><{kind} memory="true">{"".join(nodes)}'
                     f"</{kind}></BehaviorTree>")
        return text + "</root>\n"


def run(lockstep, *arguments):
    done = subprocess.run([lockstep, *arguments], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def robots(tree, names):
    return [f"{tree},me={name}" for name in names]


def judge(lockstep, folder, seed, seeds):
    """None: the team is refused, or too large. Otherwise (is_deadlocked, complaints)."""
    team = Team(seed)
    tree, leaves = os.path.join(folder, "tree.xml"), os.path.join(folder, "leaves.xml")
    text_of_tree = team.tree()
    for path, text in [(tree, text_of_tree), (leaves, model(text_of_tree))]:
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    files = robots(tree, team.names)
    code, out, err = run(lockstep, "verify", *files, "--leaves", leaves, "--late", str(team.late),
                         "--mock", "--json", "--out", folder, "--states", "60000")
    if code in (3, 124):
        return None
    if code not in (0, 1):
        return False, [f"verify: code {code}: {err}"]
    verdict = json.loads(out)
    if not verdict["complete"]:
        return None
    wrong = [it["message"] for it in verdict["findings"] if it["name"] != "deadlock"]
    can_end = verdict["facts"]["can always end"] == "yes"
    for play in range(seeds):
        chance = random.Random(seed * 1000 + play)
        # A word that takes so many periods is heard as many ticks late, or less.
        slowest = team.late / RATE
        latency = slowest * chance.choice([0, 0.2, 0.7, 1])
        jitter = (slowest - latency) * chance.choice([0, 1])
        starts = [chance.choice([0, 0, 0.02, 0.1, 0.35, 0.9]) for _ in team.names]
        code, out, err = run(
            lockstep, "team", *files, "--leaves", leaves, "--mock", "--rate", str(RATE), "--seed",
            str(play), "--latency", str(latency), "--jitter", str(jitter), "--timeout", str(LAST),
            "--json", "--start", *[str(it) for it in starts])
        if code not in (0, 1):
            wrong.append(f"team: code {code}: {err}")
            continue
        for name, robot in json.loads(out)["robots"].items():
            result = robot["result"]
            if result != "stopped" and robot["seconds"] > LAST - 10:
                continue  # the end of another robot by the limit has released it
            if result == "stopped" and can_end:
                wrong.append(f"seed {play}: {name} never ends: {robot.get('why')}")
            if result != "stopped" and result not in verdict["results"][name]:
                wrong.append(f"seed {play}: {name} ends with {result}")
    return not can_end, wrong


def main():
    lockstep, teams = sys.argv[1], int(sys.argv[2])
    first = int(sys.argv[3]) if len(sys.argv) > 3 else 0
    seeds = int(sys.argv[4]) if len(sys.argv) > 4 else 6
    judged = deadlocks = bad = 0
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + teams):
            result = judge(lockstep, folder, seed, seeds)
            if result is None:
                continue
            judged += 1
            deadlocks += result[0]
            for line in result[1]:
                print(f"team {seed}: {line}")
            if result[1]:
                bad += 1
                print(Team(seed).tree())
    print(f"{judged} of {teams} teams judged, {deadlocks} with a deadlock, {bad} wrong")
    # Teams that nobody can judge, or that are all alike, are no judge.
    if bad or judged < teams / 2 or (teams >= 40 and not 0 < deadlocks < judged):
        sys.exit(1)


if __name__ == "__main__":
    main()
