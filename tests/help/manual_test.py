"""The manual pages: manual_test.py LOCKSTEP WORK. Without mandoc (77) only that part is skipped."""
import os
import re
import shutil
import subprocess
import sys

LOCKSTEP, WORK = sys.argv[1:3]
shutil.rmtree(WORK, ignore_errors=True)


def write(directory, **environment):
    done = subprocess.run([LOCKSTEP, "manual", directory], capture_output=True, text=True, env={**os.environ, **environment})
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


def read(file):
    with open(file, encoding="utf-8") as text:
        return text.read()


files = write(WORK, SOURCE_DATE_EPOCH="86400")
pages = {os.path.basename(it): read(it) for it in files}
commands = re.findall(r"^  ([a-z]+) ", subprocess.run([LOCKSTEP, "--help"], capture_output=True, text=True).stdout.split("Subcommands:")[1], re.M)
assert len(commands) > 15
for command in commands:
    if command == "help":
        continue
    page = pages[f"lockstep-{command}.1"]
    help_text = subprocess.run([LOCKSTEP, command, "--help"], capture_output=True, text=True).stdout
    if "--help-all" in help_text:
        help_text = subprocess.run([LOCKSTEP, command, "--help-all"], capture_output=True, text=True).stdout
        assert command != "run" or "--spin US" in help_text, help_text
    for option in re.findall(r"^  (?:-.,)?--([a-z][a-z0-9-]*)", help_text, re.M):
        assert option in ("help", "help-all") or re.search(rf"Fl -{option}\b", page), f"{command}: no --{option}"
    assert ".Sh EXIT STATUS" in page and ".Sh EXAMPLES" in page, command
assert all(".Dd January 2, 1970" in page for page in pages.values())
assert "Cm \\&ParallelAbsolute" in pages["lockstep-tree.5"] and "Cm \\&rate_hz" in pages["lockstep-recording.5"]
references = {(name, section) for page in pages.values() for name, section in re.findall(r"^\.Xr (\S+) (\d)", page, re.M)}
for name, section in references:
    assert f"{name}.{section}" in pages, f"no page {name}({section})"
again = write(WORK + "-again", SOURCE_DATE_EPOCH="86400")
assert [read(it) for it in again] == [read(it) for it in files]
refused = subprocess.run([LOCKSTEP, "manual", "/proc/nowhere"], capture_output=True, text=True)
assert refused.returncode == 2 and "cannot write '/proc/nowhere/man1/lockstep.1'" in refused.stderr, refused
if shutil.which("mandoc") is None:
    sys.exit(77)
# It looks for the pages that are referred to where those of the system are.
remarks = [line for line in subprocess.run(["mandoc", "-Tlint", *files], capture_output=True, text=True).stdout.splitlines()
           if "referenced manual not found: Xr lockstep" not in line]
assert not remarks, "\n".join(remarks)
