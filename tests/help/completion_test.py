"""lockstep completion in bash, zsh and fish: completion_test.py SHELL LOCKSTEP SOURCE. Skipped (77) without the shell."""
import os
import pty
import select
import shutil
import subprocess
import sys
import tempfile
import time

SHELL, LOCKSTEP, SOURCE = sys.argv[1:4]
if shutil.which(SHELL) is None:
    sys.exit(77)
HOME = tempfile.TemporaryDirectory()  # shells write there
TREES = os.path.join(SOURCE, "trees")
ENVIRONMENT = {"PATH": os.path.dirname(LOCKSTEP) + ":/usr/bin:/bin", "HOME": HOME.name, "TERM": "dumb",
               "LC_ALL": "C.UTF-8", "PS1": "ready> "}
# Line, words that are offered, words that are not. A shell may offer more.
LAWS = [
    ("lockstep ", ["run", "check", "doctor", "help"], ["--help"]),
    ("lockstep re", ["replay"], ["run"]),
    ("lockstep run --over", ["--overrun"], ["--rate"]),
    ("lockstep run --overrun ", ["skip", "catch-up", "fail"], ["run"]),
    ("lockstep run --overrun=c", ["catch-up"], ["skip"]),
    ("lockstep run --clock virtual --vi", ["--view"], ["--clock"]),
    ("lockstep log e", ["events", "export"], ["info"]),
    ("lockstep log events --event ho", ["hold"], ["halt"]),
    ("lockstep nodes Para", ["ParallelAbsolute", "ParallelRelative"], ["Sequence"]),
    ("lockstep help mon", ["monitor"], ["run"]),
    ("lockstep run door_pulling.xml --arg ", ["barriers="], ["skip"]),
    ("lockstep run door_pulling.xml --mock-leaf Pu", ["PullDoor="], ["BackAway="]),
    ("lockstep run door_pull", ["door_pulling.xml"], ["fetch.xml"]),
    ("lockstep check door_pull", ["door_pulling.xml"], ["README.md", "door_pulling.test.json"]),
    ("lockstep run door_pulling.xml --plugin-path ../tr", ["../trees"], ["skip"]),
]


def run(words, text=None):
    return subprocess.run(words, input=text, capture_output=True, text=True, cwd=TREES, env=ENVIRONMENT, timeout=60).stdout


def quoted(line):
    return "'" + line.replace("'", "'\\''") + "'"


def in_bash(line):
    """As readline calls it: words are split at = and : too."""
    words, word = [], ""
    for c in line:
        if c == " ":
            words += [word] if word else []
            word = ""
        elif c in "=:":
            words += [word, c] if word else [c]
            word = ""
        else:
            word += c
    words.append(word)
    if len(words) > 1 and words[-1] == "" and words[-2] in "=:":
        words.pop()
    script = f"""source <({LOCKSTEP} completion bash); compopt() {{ :; }}
COMP_LINE={quoted(line)} COMP_POINT={len(line)} COMP_WORDS=({' '.join(map(quoted, words))}) COMP_CWORD={len(words) - 1}
_lockstep; printf '%s\\n' "${{COMPREPLY[@]}}\""""
    return run(["bash", "--norc", "-c", script]).split("\n")


def in_fish(line):
    script = f"{LOCKSTEP} completion fish | source; complete -C {quoted(line)}"
    return [it.split("\t")[0].split("=", 1)[-1] if "--overrun=" in it else it.split("\t")[0]
            for it in run(["fish", "--no-config", "-c", script]).split("\n")]


def type_and_read(shell, setup, line, expected):
    """The terminal's text after a line and the tab key, until it has what is expected, or 30 s."""
    process, terminal = pty.fork()
    if process == 0:
        os.chdir(TREES)
        os.execvpe(shell[0], shell, ENVIRONMENT)
    seen = ""
    end = time.monotonic() + 30

    def read_until(texts):
        nonlocal seen
        while not all(text in seen for text in texts) and time.monotonic() < end:
            if select.select([terminal], [], [], 1)[0]:
                try:
                    seen += os.read(terminal, 4096).decode(errors="replace").replace("\a", "")
                except OSError:  # it has ended
                    return

    os.write(terminal, (setup + "; echo set''up\n").encode())
    read_until(["setup"])
    seen = ""
    os.write(terminal, (line + "\t\t").encode())
    read_until(expected)
    os.close(terminal)
    os.kill(process, 9)
    os.waitpid(process, 0)
    return seen


wrong = []
for line, offered, not_offered in LAWS:
    if SHELL == "zsh":
        expected = [it.removeprefix("--overrun=") for it in offered]
        setup = f"autoload -U compinit; compinit -u -D; eval \"$({LOCKSTEP} completion zsh)\"; LISTMAX=1000"
        seen = type_and_read(["zsh", "-f", "-i"], setup, line, expected)
        if not all(it in seen for it in expected):
            wrong.append((line, expected, seen))
        continue
    found = {"bash": in_bash, "fish": in_fish}[SHELL](line)
    found = [it.rstrip("/") for it in found]
    if not set(offered) <= set(found) or set(not_offered) & set(found):
        wrong.append((line, offered, found))
if SHELL == "bash":
    setup = f"source <({LOCKSTEP} completion bash); bind 'set enable-bracketed-paste off'"
    for line, expected in [("lockstep run --overrun=ca", "--overrun=catch-up"), ("lockstep re", "lockstep replay"),
                           ("lockstep check door_pull", "door_pulling.")]:
        seen = type_and_read(["bash", "--norc", "-i"], setup, line, [expected])
        if expected not in seen:
            wrong.append((line, expected, seen))
for line, expected, found in wrong:
    print(f"{line!r}: expected {expected}, found {found}")
sys.exit(1 if wrong else 0)
