"""docs/tutorial.md or docs/recipes.md, from its first line to its last: tutorial_test.py PAGE BUILD WORK [--write].

The commands of each ```console block run in one directory, and what they print is compared; a line … stands for any lines.
A block behind <!-- file NAME --> is that file. --write puts what is printed into the page."""
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
QUIET = ("cmake ", "cd ")  # what they print is not ours


def run(command):
    """Its output, as on a terminal. The directory stays."""
    global place
    done = subprocess.run(["bash", "-c", f"cd {shlex.quote(place)} && {command} && pwd > {WORK}/.place"], env=ENVIRONMENT,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=250)
    with open(WORK + "/.place", encoding="utf-8") as text:
        place = text.read().strip()
    assert done.returncode == 0, f"{command}\nended with {done.returncode}\n{done.stdout}"
    return "" if command.startswith(QUIET) else done.stdout.replace(f" -Dlockstep_DIR={BUILD}/cmake/lockstep", "")


def same(expected, printed):
    pattern = "".join(".*" if line == "…" else re.escape(line) + "\n" for line in expected.splitlines())
    pattern = re.sub(r"passed,\\ \d+\\\.\d+\\ s", r"passed,\\ \\d+\\.\\d+\\ s", pattern)  # how long it took
    return re.fullmatch(pattern, printed, re.S) is not None


with open(PAGE, encoding="utf-8") as text:
    page = text.read()
wrong = []
commands = 0


def play(block):
    global commands
    marker, language, body = block.group(1) or "", block.group(2), block.group(3)
    if marker.startswith("<!-- file "):
        with open(os.path.join(place, marker.split()[2]), "w", encoding="utf-8") as file:
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
        text += f"$ {command}\n" + printed
    return text + "```\n"


written = re.sub(r"(<!-- [^\n]* -->\n)?```(\w+)\n(.*?)```\n", play, page, flags=re.S)
assert commands > (15 if "tutorial" in PAGE else 9)
if "--write" in sys.argv:
    with open(PAGE, "w", encoding="utf-8") as text:
        text.write(written)
elif wrong:
    sys.exit("\n".join(wrong))
