"""The last stage of the Dockerfile, step by step, in a Debian that debootstrap makes; then what `docker run` would do.

container_test.py SOURCES PACKAGES WORK, as root. It replaces no reading of the Dockerfile: images of Docker leave out manual
pages, for example. What is run sees its own /proc, no other process, and a root of its user's files only."""
import glob
import os
import shlex
import shutil
import subprocess
import sys

from debian import copy_base, make_base

SOURCES, PACKAGES, WORK = sys.argv[1:4]
BASE, ROOT = WORK + "/base", WORK + "/root"
state = {"USER": "0", "WORKDIR": "/", "ENV": {"PATH": "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"}}


def inside(command, stdin=""):
    """The command in the container, by its user: what it ended with, and both outputs."""
    place = f"cd {state['WORKDIR']} && exec \"$@\""
    user = state["USER"]
    words = ["unshare", "--mount", "--pid", "--fork", "--root", ROOT, "--mount-proc=/proc", "setpriv", "--reuid", user,
             "--regid", user, "--clear-groups", "--no-new-privs", "sh", "-c", place, "sh", *command]
    done = subprocess.run(words, env=state["ENV"], input=stdin, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          timeout=600)
    return done.returncode, done.stdout


def must(*command):
    code, output = inside(command)
    assert code == 0, f"{shlex.join(command)}\nended with {code}\n{output}"
    return output


def copy(words):
    source, target = words[-2:]
    files = glob.glob(os.path.join(PACKAGES, os.path.basename(source)))
    assert files, f"no {os.path.basename(source)} in {PACKAGES}: ./dev package"
    for file in files:
        shutil.copy(file, ROOT + target)


def do(instruction, rest):
    if instruction == "RUN":
        must("sh", "-c", rest)
    elif instruction == "COPY":
        copy(rest.split())
    elif instruction == "ENV":
        state["ENV"].update(word.split("=", 1) for word in rest.split())
    elif instruction == "WORKDIR":
        os.makedirs(ROOT + rest, exist_ok=True)
        state[instruction] = rest
    else:
        state[instruction] = rest


def steps_of_last_stage():
    with open(SOURCES + "/Dockerfile", encoding="utf-8") as text:
        lines = "".join(line for line in text if not line.startswith("#")).replace("\\\n", " ").splitlines()
    steps = [line.split(maxsplit=1) for line in lines if line.strip()]
    first = max(i for i, (instruction, _) in enumerate(steps) if instruction == "FROM")
    assert steps[first][1] == "debian:12-slim"
    return steps[first + 1:]


if os.geteuid() != 0 or not shutil.which("debootstrap"):
    sys.exit("container_test: needs root and debootstrap")
os.makedirs(WORK, exist_ok=True)
make_base(BASE)
copy_base(BASE, ROOT)
for step in steps_of_last_stage():
    print("container:", *step, file=sys.stderr)
    do(*step)
ENTRY = ["lockstep"]
assert state["ENTRYPOINT"] == '["lockstep"]' and state["CMD"] == '["--help"]'

assert "usage" in must(*ENTRY, "--help").lower()
assert must("id", "-u").strip() == state["USER"] != "0"
assert must("sh", "-c", "command -v cc gcc g++ cmake || true") == "", "a compiler is in the image"
assert "success" in must(*ENTRY, "run", "trees/door_pulling.xml", "--clock", "virtual", "--view", "none")
must(*ENTRY, "run", "trees/door_pulling.xml", "--clock", "virtual", "--view", "none", "--isolate", "--record", "run.jsonl.zst")
assert "door" in must(*ENTRY, "log", "info", "run.jsonl.zst").lower()
must(*ENTRY, "run", "trees/door_pulling.xml", "--clock", "virtual", "--view", "none", "--monitor", "0.0.0.0:8080", "--monitor-linger", "0")
must(*ENTRY, "new", "plugin", "look", "--lang", "python")
must(*ENTRY, "run", "look/tree.xml", "--plugin-path", "look", "--clock", "virtual", "--view", "none")
code, findings = inside([*ENTRY, "doctor", "--rate", "1"])
assert code == 0 and "--realtime" in findings, findings
print(f"container: all steps succeed; the image has {subprocess.run(['du', '-sm', ROOT], stdout=subprocess.PIPE, text=True).stdout.split()[0]} MB")
