"""lockstep doctor and --version --verbose: doctor_test.py LOCKSTEP."""
import json
import os
import re
import subprocess
import sys

LOCKSTEP = sys.argv[1]


def run(*words, **environment):
    return subprocess.run([LOCKSTEP, *words], capture_output=True, text=True, env={"PATH": "/usr/bin:/bin", **environment})


def findings(*words, **environment):
    done = run("doctor", "--json", *words, **environment)
    found = json.loads(done.stdout)["findings"]
    assert all(it["grade"] in ("ok", "note", "problem") for it in found)
    assert all(it["remedy"] for it in found if it["grade"] == "problem"), found
    assert done.returncode == (1 if any(it["grade"] == "problem" for it in found) else 0), done
    return found


# At one tick in 20 s, nothing of a machine that is busy is late.
quiet = findings("--rate", "0.05")
subjects = [it["subject"] for it in quiet]
for subject in ("governor", "clock source", "timers", "kernel", "load", "lateness", "--realtime", "plugin path", "isolation",
                "gnuplot", "python3"):
    assert subject in subjects, subject
missing = findings("--rate", "0.05", LOCKSTEP_PLUGIN_PATH="/nowhere/plugins")
assert {"subject": "plugin path", "grade": "problem", "found": "/nowhere/plugins: there is no such directory",
        "remedy": "mend --plugin-path or LOCKSTEP_PLUGIN_PATH"} in missing, missing
alone = findings("--rate", "0.05", PATH="/nowhere")
assert [it["grade"] for it in alone if it["subject"] == "gnuplot"] == ["note"]
assert [it["remedy"] for it in alone if it["subject"] == "gnuplot"] == ["sudo apt-get install gnuplot-nox"]
# Without rights, --realtime is a problem for those who want it only.
limited = ["prlimit", "--rtprio=0", "--memlock=0", "setpriv", "--reuid=65534", "--clear-groups", "--bounding-set=-all",
           "--inh-caps=-all", LOCKSTEP, "doctor", "--json", "--rate", "0.05"]
if os.geteuid() == 0:
    for more, grade in ([], "note"), (["--realtime"], "problem"):
        done = subprocess.run(limited + more, capture_output=True, text=True, cwd="/")
        grades = [it["grade"] for it in json.loads(done.stdout)["findings"] if it["subject"] == "--realtime"]
        # Of the priority and of memory, which a sanitizer does not lock.
        assert grades == [grade] * (1 if os.environ.get("LOCKSTEP_SANITIZE") else 2), done
        advice = "docker run --ulimit rtprio=90 --ulimit memlock=-1"
        if not any(map(os.path.exists, ("/.dockerenv", "/run/.containerenv"))) and "container" not in os.environ:
            assert advice not in done.stdout
        boxed = subprocess.run(limited + more, capture_output=True, text=True, cwd="/", env={**os.environ, "container": "podman"})
        assert [it["grade"] for it in json.loads(boxed.stdout)["findings"] if it["remedy"] == advice] == [grade], boxed
text = run("doctor", "--rate", "0.05").stdout
assert all(re.match(r"(ok|note|problem) +\S|  +-> ", line) for line in text.splitlines()), text
assert run("doctor", "--rate", "0").returncode == 2

about = run("--version", "--verbose")
assert about.returncode == 0 and about.stdout.startswith(run("--version").stdout.strip() + "\nparts "), about
for row in ("plugin contract   1.", "semantics  ", "recordings  ", "compiler  ", "program  ", "lockstep-leafhost ", "plugins  "):
    assert "\n" + row in about.stdout, row
assert "plugins           /nowhere (not there)" in run("--version", "--verbose", LOCKSTEP_PLUGIN_PATH="/nowhere").stdout
assert run("--verbose").returncode == 2
