"""A page whose commands are tested, from its first line to its last: tutorial_test.py PAGE BUILD WORK [--write].

The commands of each ```console block run in one directory, and what they print is compared; a line … stands for any lines,
and … in a line for any text.
A run may fail where it prints so, which the page then shows. A block behind <!-- file NAME --> is that file. A command in a
row of README.md's table must succeed. --write puts what is printed into the page."""
import os
import re
import shlex
import shutil
import subprocess
import sys

PAGE, BUILD, WORK = sys.argv[1:4]
shutil.rmtree(WORK, ignore_errors=True)
os.makedirs(WORK)
ENVIRONMENT = {**os.environ, "PATH": BUILD + ":" + os.environ["PATH"], "NO_COLOR": "1", "TERM": "dumb", "LC_ALL": "C.UTF-8",
               "HOME": WORK, "lockstep_DIR": BUILD + "/cmake/lockstep"}
place = WORK
SOURCE = os.path.abspath(os.path.join(os.path.dirname(__file__), "../.."))
if os.path.basename(PAGE) in ("README.md", "guards.md", "road.md"):  # whose commands run in a clone
    os.symlink(os.path.join(SOURCE, "trees"), WORK + "/trees")
LEAST = {"tutorial.md": 16, "recipes.md": 10, "guards.md": 18, "from-behaviortree-cpp.md": 12,
         "language.md": 9, "road.md": 5, "deadlocks.md": 4, "verify.md": 1, "team.md": 5}  # commands, so that a page is not skipped unseen
QUIET = ("cmake ", "cd ")  # what they print is not ours


def run(command):
    """Its output, as on a terminal. The directory stays."""
    global place
    done = subprocess.run(["bash", "-c", f"cd {shlex.quote(place)} && {command} && pwd > {WORK}/.place"], env=ENVIRONMENT,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=250)
    failed = done.returncode == 1 and re.search(r"^(failure|skipped) after", done.stdout, re.M)
    assert done.returncode == 0 or failed, f"{command}\nended with {done.returncode}\n{done.stdout}"
    if not failed:  # else `pwd` did not run
        with open(WORK + "/.place", encoding="utf-8") as text:
            place = text.read().strip()
    return "" if command.startswith(QUIET) else done.stdout.replace(f" -Dlockstep_DIR={BUILD}/cmake/lockstep", "")


def same(expected, printed):
    lines = expected.splitlines()
    pattern = "".join(".*" if line == "…" else re.escape(line).replace("…", "[^\n]*") + "\n" for line in lines)
    pattern = re.sub(r"passed,\\ \d+\\\.\d+\\ s", r"passed,\\ \\d+\\.\\d+\\ s", pattern)  # how long it took
    return re.fullmatch(pattern, printed, re.S) is not None


with open(PAGE, encoding="utf-8") as text:
    page = text.read()
wrong = []
commands = 0


def play(block):
    global commands
    marker, language, body = block.group(1) or "", block.group(2), block.group(3)
    if named := re.search("<!-- file ([^ ]+) -->", marker):
        with open(os.path.join(place, named[1]), "w", encoding="utf-8") as file:
            file.write(body)
    if language != "console":
        assert marker or language not in ("sh", "bash"), "a block of commands is not run, and does not say so"
        return block.group(0)
    text = marker + "```console\n"
    for command, expected in re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", body, re.M):
        commands += 1
        printed = run(command)
        if not same(expected, printed):
            wrong.append(f"$ {command}\nexpected:\n{expected}printed:\n{printed}")
        text += f"$ {command}\n" + (expected if same(expected, printed) else printed)
    return text + "```\n"


written = re.sub(r"((?:<!-- [^\n]* -->\n)*)```(\w+)\n(.*?)```\n", play, page, flags=re.S)
if PAGE.endswith("README.md"):
    for command in re.findall(r"^\| .* \| `(lockstep [^`]*)` \|", page, re.M):
        commands += 1
        run(command)
assert commands >= LEAST.get(os.path.basename(PAGE), 5), f"only {commands} commands"
if "--write" in sys.argv:
    with open(PAGE, "w", encoding="utf-8") as text:
        text.write(written)
elif wrong:
    sys.exit("\n".join(wrong))
