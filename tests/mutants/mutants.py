#!/usr/bin/env python3
"""Changes the engine at random places, one change at a time, and counts the changes that a test notices.

usage: mutants.py COUNT|LIST [FOLDER]

It works in a copy of the sources, in FOLDER, build/nightly/mutants when absent. The choice depends on the commit, so a run that
was stopped continues: FOLDER/mutants.txt has a line for each mutant. One that no test notices is a test that is missing, or
a change that makes no difference: read it. The exit code is 1 if the tests fail without a change.

With LIST, such as resume.txt, it makes the changes of that file, and the exit code is 1 if a test notices one of them not. The tests
are those whose names begin with the name of the list: "resume:"."""
import pathlib
import random
import re
import shutil
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
# The fastest first: most mutants die in it.
PROGRAMS = ("nodes", "language", "unit", "property")
CHANGES = [(" == ", " != "), (" != ", " == "), (" < ", " <= "), (" > ", " >= "), (" <= ", " < "), (" >= ", " > "), (" && ", " || "),
           (" || ", " && "), (" + ", " - "), (" - ", " + "), ("true", "false"), ("false", "true"), ("continue;", "break;"),
           ("std::min", "std::max"), ("std::max", "std::min")]
LONGEST = 900  # seconds: a mutant that never ends has been noticed


def mutants_of(text):
    """(line, column, before, after) of each change that can be made."""
    for number, line in enumerate(text.splitlines()):
        code = re.sub(r"//.*", "", line)
        if code.lstrip().startswith(("#", "template", "using", "static_assert")):
            continue
        for before, after in CHANGES:
            pattern = re.escape(before) if before[0] == " " else rf"\b{re.escape(before)}"
            for found in re.finditer(pattern, code):
                if code[:found.start()].count('"') % 2 == 0:  # in no text
                    yield number, found.start(), before, after


def changed(text, mutant):
    number, column, before, after = mutant
    lines = text.splitlines(keepends=True)
    line = lines[number]
    lines[number] = line[:column] + after + line[column + len(before):]
    return "".join(lines)


def chosen(sources, count, seed):
    """`count` of all mutants, as (file, mutant), the same ones for the same seed."""
    every = [(file, mutant) for file, text in sorted(sources.items()) for mutant in mutants_of(text)]
    return random.Random(seed).sample(every, min(count, len(every)))


# A line is "FILE: BEFORE => AFTER", or a comment. BEFORE is in one place.
def listed(file):
    rows = [line for line in file.read_text().splitlines() if line and not line.startswith("#")]
    return [re.fullmatch(r"(\S+): (.+?) => ?(.*)", row).groups() for row in rows]


def copy_sources(to):
    tracked = subprocess.run(["git", "-C", SOURCE, "ls-files", "-z"], capture_output=True, text=True, check=True).stdout
    for file in tracked.split("\0"):
        if file and (SOURCE / file).exists():
            (to / file).parent.mkdir(parents=True, exist_ok=True)
            if not (to / file).exists() or (to / file).read_bytes() != (SOURCE / file).read_bytes():
                shutil.copy2(SOURCE / file, to / file, follow_symlinks=False)


def outcome(copy):
    """What notices the change that is made in the copy, or "survived"."""
    targets = [f"test_{program}" for program in PROGRAMS]
    if subprocess.run(["cmake", "--build", "build/release", "--target", *targets], cwd=copy, capture_output=True).returncode:
        return "the compiler"
    for target in targets:
        try:
            ran = subprocess.run([f"build/release/tests/{target}", "--abort"], cwd=copy, capture_output=True, timeout=LONGEST)
        except subprocess.TimeoutExpired:
            return f"{target}, which never ends"
        if ran.returncode:
            return target
    return "survived"


def outcome_of_list(copy, name):
    targets = ["lockstep", "motion", "btcpp_faulty", "lockstep_embedding", "embedding_kept_c", "embedding_kept_cpp", "torn_writes",
               f"test_{name}"]
    if subprocess.run(["cmake", "--build", "build/release", "--target", *targets], cwd=copy, capture_output=True).returncode:
        return "the compiler"
    ran = subprocess.run(["ctest", "--test-dir", "build/release", "-R", f"^{name}:", "--stop-on-failure", "-j2"], cwd=copy,
                         capture_output=True, text=True)
    failed = re.search(r"^\s*\d+ - (.+) \(", ran.stdout, re.MULTILINE)
    return failed.group(1) if failed else "survived"


def main_of_list(file, folder):
    copy = folder / "source"
    copy_sources(copy)
    subprocess.run(["cmake", "--preset", "dev"], cwd=copy, check=True, capture_output=True)
    rows, survived = listed(file), 0
    for path, before, after in [(None, "", ""), *rows]:  # the first is none
        text = (copy / path).read_text() if path else ""
        if path and text.count(before) != 1:
            sys.exit(f"{path}: '{before}' is in {text.count(before)} places, expected 1")
        try:
            if path:
                (copy / path).write_text(text.replace(before, after))
            found = outcome_of_list(copy, file.stem)
        finally:
            if path:
                (copy / path).write_text(text)
        if not path and found != "survived":
            sys.exit(f"without a change: {found} fails")
        if path:
            print(f"{path}: '{before}' is '{after}': {found}", flush=True)
            survived += found == "survived"
    print(f"{len(rows) - survived} of {len(rows)} mutants were noticed")
    return 1 if survived else 0


def main(count, folder):
    copy = folder / "source"
    commit = subprocess.run(["git", "-C", SOURCE, "rev-parse", "HEAD"], capture_output=True, text=True, check=True).stdout.strip()
    copy_sources(copy)
    subprocess.run(["cmake", "--preset", "dev"], cwd=copy, check=True, capture_output=True)
    unchanged = outcome(copy)
    if unchanged != "survived":
        print(f"without a change: {unchanged} fails", file=sys.stderr)
        return 1
    sources = {file.relative_to(copy): file.read_text() for file in copy.glob("interpreter/**/engine/**/*.cpp")}
    table = folder / "mutants.txt"
    lines = table.read_text().splitlines() if table.exists() else []
    if lines[:1] != [commit]:
        lines = [commit]
    seen = dict(line.rsplit(": ", 1) for line in lines[1:])
    died = 0
    for file, mutant in chosen(sources, count, commit):
        number, column, before, after = mutant
        name = f"{file}:{number + 1}:{column + 1}: '{before.strip()}' is '{after.strip()}'"
        if name not in seen:
            (copy / file).write_text(changed(sources[file], mutant))
            try:
                seen[name] = outcome(copy)
            finally:
                (copy / file).write_text(sources[file])
            lines.append(f"{name}: {seen[name]}")
            table.write_text("\n".join(lines) + "\n")
        print(f"{name}: {seen[name]}", flush=True)
        died += seen[name] != "survived"
    print(f"{died} of {min(count, len(seen))} mutants were noticed")
    return 0


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    where = pathlib.Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else SOURCE / "build/nightly/mutants"
    sys.exit(main(int(sys.argv[1]), where) if sys.argv[1].isdigit() else main_of_list(pathlib.Path(sys.argv[1]).resolve(), where))
