"""./dev release refuses what is not ready, before it builds anything, and says what to do: release_test.py SOURCES WORK.

Each row is a small change of a clone of the sources. Without git, the test is skipped."""
import os
import shutil
import subprocess
import sys

SOURCES, WORK = sys.argv[1:3]
CLONE = WORK + "/clone"
ENVIRONMENT = {name: value for name, value in os.environ.items() if not name.startswith(("DEB", "GIT_", "EMAIL"))}
ENVIRONMENT.update(HOME=WORK, GIT_CONFIG_GLOBAL=WORK + "/gitconfig", GIT_CONFIG_SYSTEM="/dev/null", LC_ALL="C")


def run(*command, **environment):
    return subprocess.run(command, cwd=CLONE, env={**ENVIRONMENT, **environment}, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, timeout=60)


def must(*command):
    done = run(*command)
    assert done.returncode == 0, done.stdout


def edit(name, old, new):
    with open(f"{CLONE}/{name}", encoding="utf-8") as text:
        content = text.read()
    assert old in content, (name, old)
    with open(f"{CLONE}/{name}", "w", encoding="utf-8") as text:
        text.write(content.replace(old, new, 1))


def make_clone():
    """A repository of what a release reads, as it is here, also what is not committed. Its change log is ready."""
    shutil.rmtree(WORK, ignore_errors=True)
    os.makedirs(CLONE)
    with open(WORK + "/gitconfig", "w", encoding="utf-8") as text:
        text.write("[user]\n  name = A tester\n  email = tester@localhost\n")
    files = subprocess.run(["git", "-C", SOURCES, "ls-files", "-z", "--cached"], stdout=subprocess.PIPE, check=True).stdout
    kept = [name for name in files.decode().split("\0") if name.startswith("interpreter/packaging/") or
            name.endswith(("package.xml", "pyproject.toml", "vscode/package.json")) or "/" not in name and name]
    for name in kept:
        os.makedirs(os.path.dirname(f"{CLONE}/{name}"), exist_ok=True)
        shutil.copy(f"{SOURCES}/{name}", f"{CLONE}/{name}")
    shutil.copytree(SOURCES + "/tests/frozen", CLONE + "/tests/frozen")
    with open(CLONE + "/CMakeLists.txt", encoding="utf-8") as cmake:
        version = cmake.read().split("project(lockstep VERSION ")[1].split()[0]
    with open(CLONE + "/CHANGELOG.md", "w", encoding="utf-8") as text:
        text.write(f"## Unreleased\n\n## {version}\n")
    must("git", "init", "--quiet")
    must("git", "add", "--all", "--force")
    must("git", "commit", "--quiet", "--message", "the sources")
    return version


def release(*words, **environment):
    return run("./dev", "release", "--dry-run", *words, **environment)


if not shutil.which("git") or not os.path.exists(SOURCES + "/.git"):
    sys.exit(77)
VERSION = make_clone()
TAG = "v" + VERSION

ready = release()
assert ready.returncode == 0, ready.stdout
assert "would make" in ready.stdout and f"the tag {TAG}" in ready.stdout, ready.stdout
assert "warning: the packages name a maintainer who is nobody" in ready.stdout and "set DEBFULLNAME and DEBEMAIL" in ready.stdout
assert "warning" not in release(DEBEMAIL="packages@robots.example").stdout

ROWS = [  # what is done to the clone, what undoes it, what is said
    (lambda: edit("README.md", "lockstep", "Lockstep"), "git checkout --quiet README.md", "commit them, or git stash"),
    (lambda: open(CLONE + "/notes", "w").close(), "rm notes", "commit them, or git stash"),
    (lambda: must("git", "tag", TAG), f"git tag --delete {TAG}", f"git tag --delete {TAG}"),
    (lambda: edit("CHANGELOG.md", "\n\n", "\n\n- a new line\n\n"), "git checkout --quiet .", f"move them under '{VERSION}'"),
    (lambda: edit("package.xml", VERSION, "0.0.7"), "git checkout --quiet .", f"expected <version>{VERSION}</version>"),
    (lambda: shutil.move(WORK + "/gitconfig", WORK + "/away"), f"mv {WORK}/away {WORK}/gitconfig", "git config user.name NAME"),
    (lambda: shutil.move(CLONE + "/.git", WORK + "/git"), f"mv {WORK}/git .git", "clone the sources with git"),
]
for spoil, mend, message in ROWS:
    spoil()
    # Without an identity in its configuration, git would take one from the name of the machine.
    refused = release(GIT_CONFIG_COUNT="1", GIT_CONFIG_KEY_0="user.useConfigOnly", GIT_CONFIG_VALUE_0="true")
    assert refused.returncode == 1 and message in refused.stdout, f"expected: {message}\n{refused.stdout}"
    must("bash", "-c", mend)
assert release("9.9.9").returncode == 1
assert "expected [VERSION]" in release("soon").stdout
assert release("--arch").returncode == 2, "an architecture is missing"
assert release().returncode == 0
assert not os.path.exists(CLONE + "/build"), "a dry run makes nothing"
