"""tests/change_cost/change_cost.py on a project made for it: change_cost_test.py."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

if shutil.which("git") is None:
    sys.exit(77)
HERE = pathlib.Path(__file__).parent
SCRIPT = HERE / "change_cost.py"
SOURCE = HERE.parents[1]

# Each file that is generated is known: `./dev generate` writes them by > and by check_generated.
known = SCRIPT.read_text()
dev = re.search(r"^  generate\)(.*?)^    ;;", (SOURCE / "dev").read_text(), re.M | re.S).group(1)
for name in re.findall(r">(\S+)", dev):
    assert f'"{name}"' in known, f"{name} is not in {SCRIPT}"
texts = [file.read_text() for file in (SOURCE / "tests").glob("**/*_test.cpp")]
written = {name for text in texts if "check_generated(" in text
           for name in re.findall(r'(?:check_generated\(\s*|kPage = |kReference = |docs = )"([^"]+)"', text)}
assert len(written) == 8, written
for name in written:
    assert f'"{name}"' in known, f"{name} is not in {SCRIPT}"

with tempfile.TemporaryDirectory() as folder:
    root = pathlib.Path(folder)

    def git(*words):
        subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@example.org", *words], cwd=root, check=True,
                       capture_output=True)

    def write(name, text):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)

    def cost(*words, cwd=root):
        return subprocess.run([sys.executable, SCRIPT, *words], cwd=cwd, check=True, capture_output=True, text=True).stdout

    page = "# Studies\n\n| Measure | Of | Meaning |\n|---|---|---|\n| `a` | run | {} |\n\n{}\n"
    git("init", "-q", "-b", "main")
    write("docs/studies.md", page.format("one", "text"))
    write("interpreter/judge/measure/measures.cpp", "a\n")
    git("add", ".")
    git("commit", "-q", "-m", "first")
    assert cost() == "0 by hand: 0 of the program, 0 of tests, 0 of documents; 0 generated\n"

    # A row of a generated table is generated, and files that git does not know yet count.
    write("docs/studies.md", page.format("two", "text"))
    write("interpreter/judge/measure/measures.cpp", "a\nb\n")
    write("interpreter/judge/measure/b.cpp", "b\nb\n")
    write("tests/unit/b_test.cpp", "b\n")
    write("CHANGELOG.md", "b\n")
    expected = """program    interpreter/judge/measure/b.cpp  +2 -0
program    interpreter/judge/measure/measures.cpp  +1 -0
tests      tests/unit/b_test.cpp  +1 -0
generated  docs/studies.md  +1 -1
3 by hand: 2 of the program, 1 of tests, 0 of documents; 1 generated
"""
    assert cost() == expected, cost()
    assert cost(cwd=root / "docs") == expected
    git("add", ".")
    git("commit", "-q", "-m", "a measure")
    assert cost() == "0 by hand: 0 of the program, 0 of tests, 0 of documents; 0 generated\n"
    assert cost("HEAD~1..HEAD") == cost("HEAD~1") == expected

    # A line beside the table is written by hand.
    write("docs/studies.md", page.format("two", "another text"))
    assert cost() == """documents  docs/studies.md  +1 -1
1 by hand: 0 of the program, 0 of tests, 1 of documents; 0 generated
""", cost()
