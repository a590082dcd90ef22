#!/usr/bin/env python3
"""Judges `lockstep check` with trees that others wrote: it accepts them, and finds and mends one mistake in each.

usage: public_trees.py LOCKSTEP [FOLDER] [--seed N] [--list]

Each folder in FOLDER is a set: checkouts of public repositories, or any files. A tree is an XML file with a BehaviorTree, or such a
text in a JSON file, as data sets for language models have them. The trees of this checkout are one more set. Nothing in FOLDER
changes.

First `check` gets each file as it is. A file that is well-formed may be refused only for a reason in REFUSED, for which
BehaviorTree.CPP 4 refuses it as well, or which is not in the file. Then each accepted file gets one mistake:

  tag      a letter more, less or another one, or two letters swapped, in the name of a node; in the end tag as well
  port     the same in the name of an attribute
  type     a word in place of a number, or another one in place of true or false
  SubTree  a wrong letter in the ID that a SubTree names
  barrier  barriers in the wrong order

A mistake is made only where it can be known as one: a node and its ports that the language has, or that a model in the file declares; a
SubTree whose tree is in the file or in a file of the same folder, which are then checked together; a port of a SubTree that a
model declares. Nobody can know a misspelt leaf without a model, and what a value of text means. A mistake is found if there is a
message that the file did not have. A note does not count without an edit: each leaf without a plugin has one. A mistake is mended if
the first edit of the first such message gives the file back, or one without new messages.

Exit code: 0 if no file is refused for another reason, and of each kind of mistake 95 % are found and 70 % mended, else 1. --list prints
the others."""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import xml.parsers.expat

SOURCE = pathlib.Path(__file__).resolve().parents[2]
OWN = "lockstep's own"
FOUND, MENDED = 0.95, 0.70
KINDS = ("tag", "port", "type", "SubTree", "barrier")
CATEGORIES = {"Action", "Condition", "Control", "Decorator"}
NUMBERS = re.compile(r"(u?int\d*(_t)?|unsigned( int)?|size_t|long|short|double|float|std::size_t|std::u?int\d+_t|number)")
# The ports of BehaviorTree.CPP's nodes that are numbers; `lockstep nodes` has those of lockstep.
NUMBERS_THERE = {"num_attempts", "num_cycles", "msec", "delay_msec", "success_count", "failure_count", "max_failures"}
# A message of an error in a file that is well-formed => why it is right.
REFUSED = {
    r"cannot read|unknown package|ROS package": "an included file is not there",
    r"unknown node 'BlackboardCheck": "a node that version 4 does not have",
    r"unknown node .* write <SubTree ID=": "a tree that is named like a node, as version 2 read it",
    r"'\$\{.*' is not an entry": "an entry as version 2 wrote it",
    r"'Sleep' (needs the port 'msec'|has no port 'time')": "a leaf with the name of a node of version 4",
    r"cannot have an ID": "an ID where the tag is the name of the node",
    r"'' is not a whole number": "a number without a value",
    r"needs .* child|has more than|is empty": "a wrong number of children",
    r"has no port '(success_threshold|failure_threshold|timeout_ms|key)'|needs the port '(msec|output_key)'":
        "a port that the node of version 4 does not have",
    r"error: unknown tree": "a tree that is nowhere",
}


class Element:
    def __init__(self, tag, begin, inside, attributes):
        self.tag, self.begin, self.inside, self.attributes = tag, begin, inside, attributes
        self.is_empty, self.end_tag = False, None  # where the name is

    def value(self, name):
        return self.attributes[name][2] if name in self.attributes else None

    @property
    def id(self):
        return self.value("ID") if self.tag in CATEGORIES else self.tag


ATTRIBUTE = re.compile(rb"\s+([^\s=]+)\s*=\s*(?:\"([^\"]*)\"|'([^']*)')")


def elements_of(text):
    """Those of a well-formed text in UTF-8, with the places of names and values in bytes; raises ExpatError."""
    elements, around, tags = [], [], []

    def start(tag, _):
        begin = parser.CurrentByteIndex
        place, attributes = begin + 1 + len(tag.encode()), {}
        while found := ATTRIBUTE.match(text, place):
            value = found.span(2) if found.group(2) is not None else found.span(3)
            attributes[found.group(1).decode()] = (found.span(1), value, text[slice(*value)].decode())
            place = found.end()
        element = Element(tag, begin, "BehaviorTree" in tags, attributes)
        element.is_empty = re.match(rb"\s*/>", text[place:]) is not None
        elements.append(element)
        around.append(element)
        tags.append(tag)

    def end(tag):
        begin = parser.CurrentByteIndex
        tags.pop()
        element = around.pop()
        if not element.is_empty:
            element.end_tag = (begin + 2, begin + 2 + len(tag.encode()))

    parser = xml.parsers.expat.ParserCreate("UTF-8")
    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.Parse(text, True)
    return elements


class File:
    def __init__(self, path):
        self.path, self.text = path, path.read_bytes()
        self.elements = elements_of(self.text)
        self.trees = {it.value("ID") for it in self.elements if it.tag == "BehaviorTree"} - {None}
        self.models = {}  # ID => {port: type}
        model = None
        for it in self.elements:
            if it.inside or it.tag in ("root", "BehaviorTree", "TreeNodesModel"):
                continue
            if it.tag in CATEGORIES or it.tag == "SubTree":
                model = self.models.setdefault(it.value("ID"), {})
            elif it.tag in ("input_port", "output_port", "inout_port") and model is not None and it.value("name"):
                model[it.value("name")] = it.value("type") or ""

    def is_own(self):
        return self.elements[0].value("lockstep") is not None


def collect(folder, out):
    """Copies the XML files of a set with the folders that they are in, and the trees of JSON files, each into a file of its own."""
    for path in sorted(folder.rglob("*")):
        place = out / path.relative_to(folder)
        if not path.is_file() or path.suffix not in (".xml", ".json"):
            continue
        text = path.read_bytes()
        if path.suffix == ".xml":
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(text)
            continue
        if b"<BehaviorTree" not in text:
            continue
        place.mkdir(parents=True, exist_ok=True)
        try:
            texts = list(texts_in(json.loads(text)))
        except ValueError:
            continue
        for number, tree in enumerate(texts):
            one = place / str(number)  # alone: they are no project
            one.mkdir()
            (one / "tree.xml").write_text(tree.strip() + "\n")


def texts_in(value):
    if isinstance(value, str):
        if "<BehaviorTree" in value and value.rstrip().endswith("</root>") and value.lstrip().startswith("<"):
            yield value
    elif isinstance(value, (list, dict)):
        for it in value if isinstance(value, list) else value.values():
            yield from texts_in(it)


class Failed(Exception):
    pass


class Judge:
    def __init__(self, lockstep, seed):
        self.lockstep, self.seed = lockstep, seed
        nodes = json.loads(self.run("nodes", "--format", "json").stdout)
        self.ports = {it["id"]: {port["name"]: port["type"] for port in it["parameters"]} for it in nodes}

    def run(self, *command):
        environment = {**os.environ, "NO_COLOR": "1"}
        done = subprocess.run([self.lockstep, *map(str, command)], cwd=SOURCE, capture_output=True, text=True, timeout=120,
                              env=environment)
        return done

    def check(self, path):
        done = self.run("check", "--format", "json", path)
        if done.returncode not in (0, 3):
            raise Failed(f"exit code {done.returncode}\n{path.read_text() if path.is_file() else path}")
        return json.loads(done.stdout or "[]")

    def mistakes(self, file, baseline, neighbors):
        """kind => [(edits, is checked with its folder)]; an edit is (range, maker of the new text)."""
        unknown = {quoted(it["message"]) for it in baseline if it["code"] in ("mocked-node", "tree-elsewhere", "unknown-tree")}
        trees = {id: models for other in neighbors for id, models in ((id, other.models) for id in other.trees)}
        found = collections.defaultdict(list)
        for it in file.elements:
            for name, (_, value_at, value) in it.attributes.items():
                if name == "barriers" and re.fullmatch(r"[\d.]+(;[\d.]+)+", value):
                    found["barrier"].append(([(value_at, lambda old, _: ";".join(reversed(old.split(";"))))], False))
            if not it.inside:
                continue
            if it.tag.startswith("SubTree"):
                id = it.value("ID")
                if id in file.trees or id in trees:
                    found["SubTree"].append(([(it.attributes["ID"][1], misspelt)], id not in file.trees))
                    declared = {**trees.get(id, {}), **file.models}.get(id, {})
                    found["port"] += [([(it.attributes[name][0], misspelt)], id not in file.trees)
                                      for name in it.attributes if name in declared and not name.startswith("_")]
                continue
            id, model = it.id, file.models.get(it.id)
            if id is None or (id in unknown and model is None):
                continue
            explicit = it.tag in CATEGORIES
            place = it.attributes["ID"][1] if explicit else (it.begin + 1, it.begin + 1 + len(it.tag.encode()))
            found["tag"].append(([(at, misspelt) for at in (place, None if explicit else it.end_tag) if at], False))
            for name, (at, value_at, value) in it.attributes.items():
                if name in ("name", "ID") or name.startswith("_") or (id in unknown and name not in model):
                    continue
                found["port"].append(([(at, misspelt)], False))
                kind = model.get(name, "") if id in unknown else self.ports.get(id, {}).get(name, "") if file.is_own() else (
                    "int" if name in NUMBERS_THERE else "")
                if NUMBERS.fullmatch(kind) and re.fullmatch(r"\s*-?\d+(\.\d+)?\s*", value):
                    found["type"].append(([(value_at, lambda *_: "three")], False))
                if kind == "bool" and value in ("true", "false"):
                    found["type"].append(([(value_at, lambda *_: "perhaps")], False))
        return found

    def mistaken(self, file, found, choice):
        """(kind, text, is checked with its folder, what was changed), or None; `found`: see mistakes()."""
        for _ in range(20):
            if not any(found.values()):
                return None
            kind = choice.choice([it for it in KINDS if found[it]])
            edits, together = choice.choice(found[kind])
            seed, text = choice.random(), file.text
            for (begin, end), make in reversed(edits):
                old = text[begin:end].decode()
                new = make(old, random.Random(seed))
                text = text[:begin] + new.encode() + text[end:]
            # Not a name that is one of another node, port or tree by accident.
            is_name = make is not misspelt or (new not in {*self.ports, *file.trees, *file.models} and
                                               (kind == "SubTree" or re.match(r"[A-Za-z_]", new)))
            if new != old and is_name:
                return kind, text, together, f"{old} => {new}"
        return None

    def judge(self, file, baseline, neighbors, of_each_kind):
        """One mistake, or of the few trees of this checkout one of each kind: (kind, outcome, what, messages)."""
        found = self.mistakes(file, baseline, neighbors)
        choice = random.Random(f"{self.seed} {file.text}")
        parts = [{**dict.fromkeys(KINDS, []), kind: found[kind]} for kind in KINDS] if of_each_kind else [found]
        mistakes = [self.mistaken(file, it, choice) for it in parts]
        return [self.outcome(file, baseline, it) for it in mistakes if it]

    def outcome(self, file, baseline, mistake):
        kind, text, together, what = mistake
        with Mutant(file, together) as mutant:
            if together:
                mutant.write(file.text)
                baseline = self.check(mutant.checked)
            mutant.write(text)
            messages = new_messages(self.check(mutant.checked), baseline, mutant)
            is_found = any(it["severity"] != "note" or it["edits"] for it in messages)
            with_edit = [it for it in messages if it["edits"]]
            outcome = "not found" if not is_found else "no edit"
            if with_edit:
                mended = text
                if pathlib.Path(with_edit[0]["file"]).name == mutant.path.name:
                    mended = patched(text, with_edit[0]["edits"][0]["patches"])
                mutant.write(mended)
                outcome = "same bytes" if mended == file.text else "mended" if not new_messages(
                    self.check(mutant.checked), baseline, mutant) else "not mended"
        return kind, outcome, what, [f"{it['severity']}: {it['message']}; {it.get('hint', '')}" for it in messages]


class Mutant:
    """A file next to the one that it is made of, as it may include others; or a copy of the folder, to be checked together."""

    def __init__(self, file, together):
        self.folder = None
        self.path = file.path.with_name(f"{file.path.stem}.mutant.xml")
        self.checked = self.path
        if together:
            self.folder = self.checked = pathlib.Path(tempfile.mkdtemp())
            shutil.copytree(file.path.parent, self.folder, dirs_exist_ok=True, ignore=shutil.ignore_patterns("*.mutant.xml"))
            self.path = self.folder / file.path.name

    def write(self, text):
        self.path.write_bytes(text)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.path.unlink()
        if self.folder:
            shutil.rmtree(self.folder)


def new_messages(messages, baseline, mutant):
    def key(it):
        return it["severity"], it["code"], it["message"], it["file"].replace(".mutant.xml", ".xml")
    before = collections.Counter(map(key, baseline))
    new = []
    for it in messages:
        before[key(it)] -= 1
        if before[key(it)] < 0:
            new.append(it)
    return new


def quoted(message):
    found = re.search("'([^']*)'", message)
    return found.group(1) if found else ""


def patched(text, patches):
    for it in sorted(patches, key=lambda it: -it["begin"]):
        text = text[:it["begin"]] + it["text"].encode() + text[it["end"]:]
    return text


def misspelt(name, choice):
    place = choice.randrange(max(1, len(name) - 1))
    letter = choice.choice("abcdefghijklmnopqrstuvwxyz")
    return choice.choice([
        name[:place] + name[place + 1:place + 2] + name[place:place + 1] + name[place + 2:],
        name[:place + 1] + name[place + 2:],
        name[:place + 1] + letter + name[place + 1:],
        name[:place + 1] + letter + name[place + 2:],
    ])


def reason(messages):
    """Why a file is refused: "" if it is for none that is known."""
    errors = [f"error: {it['message']} {it.get('hint', '')}" for it in messages if it["severity"] == "error"]
    reasons = [next((why for pattern, why in REFUSED.items() if re.search(pattern, it)), "") for it in errors]
    return next((it for it in reasons if it), "") if all(reasons) else ""


def judge_set(judge, name, folders):
    """(counts of files, outcomes by kind, lines about what is not as it should be)."""
    counts, outcomes, lines = collections.Counter(), collections.defaultdict(collections.Counter), []
    files, seen = [], set()
    for path in sorted(it for folder in folders for it in folder.rglob("*.xml") if it.is_file()):
        text = path.read_bytes()
        if b"<BehaviorTree" not in text or text in seen:
            continue
        seen.add(text)
        try:
            file = File(path)
        except (xml.parsers.expat.ExpatError, UnicodeDecodeError):
            counts["not well-formed"] += 1
            continue
        if file.elements[0].tag == "root" and any(it.tag == "BehaviorTree" for it in file.elements):
            files.append(file)
    neighbors = collections.defaultdict(list)
    for file in files:
        neighbors[file.path.parent].append(file)

    def run(file):
        try:
            return judged(file)
        except (Failed, subprocess.TimeoutExpired) as why:
            return file, [], str(why)

    def judged(file):
        baseline = judge.check(file.path)
        if any(it["severity"] == "error" for it in baseline):
            return file, baseline, []
        others = [it for it in neighbors[file.path.parent] if it is not file]
        return file, baseline, judge.judge(file, baseline, others, name == OWN)

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for file, baseline, result in pool.map(run, files):
            errors = [it for it in baseline if it["severity"] == "error"]
            if isinstance(result, str):
                counts["refused"] += 1
                lines.append(f"{file.path}: {result}")
                continue
            if errors and name == OWN:
                counts["needs options"] += 1
                continue
            if errors:
                why = reason(baseline)
                counts[why or "refused"] += 1
                lines += [] if why else [f"refused: {file.path}:{it['line']}: {it['message']}" for it in errors]
                continue
            counts["accepted"] += 1
            if not result:
                counts["without a place for a mistake"] += 1
            for kind, outcome, what, messages in result:
                outcomes[kind][outcome] += 1
                if outcome in ("not found", "no edit", "not mended"):
                    lines.append(f"{outcome}: {file.path}: {kind}: {what}: {' | '.join(messages)}")
    return counts, outcomes, lines


def share(part, whole):
    return f"{100 * part / whole:.1f} %" if whole else ""


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lockstep")
    parser.add_argument("folder", type=pathlib.Path, nargs="?")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args(arguments)
    judge = Judge(str(pathlib.Path(options.lockstep).resolve()), options.seed)
    sets = {it.name: [it] for it in sorted(options.folder.resolve().iterdir()) if it.is_dir()} if options.folder else {}
    sets[OWN] = [SOURCE / "trees", SOURCE / "tests/trees/good", SOURCE / "tests/trees/btcpp/good"]
    total, refused, lines, rows = collections.defaultdict(collections.Counter), 0, [], []
    print("| Set | Mistake | Number | Found | Mended | Same bytes |\n|---|---|---:|---:|---:|---:|")
    for name, folders in sets.items():
        with tempfile.TemporaryDirectory() as copies:
            copied = []
            for folder in folders:
                copied.append(pathlib.Path(copies) / folder.relative_to(folder.parents[1]))
                collect(folder, copied[-1])
            counts, outcomes, more = judge_set(judge, name, copied)
            lines += [it.replace(copies, name) for it in more]
        rows.append((name, counts))
        refused += counts["refused"]
        for kind in KINDS:
            if outcomes[kind]:
                print(row(name, kind, outcomes[kind]))
            total[kind] += outcomes[kind]
    for kind in KINDS:
        print(row("all", kind, total[kind]))
    print("\n| Set | Trees | Number |\n|---|---|---:|")
    for name, counts in rows:
        for what, number in sorted(counts.items()):
            print(f"| {name} | {what} | {number} |")
    if options.list or refused:
        print("", *lines, sep="\n")
    numbers = [numbers_of(it) for it in total.values()]
    count, found, mended, _ = map(sum, zip(*numbers))
    print(f"\n{found} of {count} mistakes found, {mended} mended; {refused} files refused without a known reason")
    is_enough = all(found >= FOUND * count and mended >= MENDED * count for count, found, mended, _ in numbers)
    return 0 if is_enough and not refused else 1


def numbers_of(outcomes):
    """All, those that are found, those that are mended, and those with the same bytes."""
    count, same = sum(outcomes.values()), outcomes["same bytes"]
    return count, count - outcomes["not found"], same + outcomes["mended"], same


def row(name, kind, outcomes):
    count, *parts = numbers_of(outcomes)
    return f"| {name} | {kind} | {count} | {' | '.join(share(it, count) for it in parts)} |"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
