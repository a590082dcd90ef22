"""What docs/editors.md says of Neovim, in a headless one: the messages of a tree are those of check. Without Neovim it is
skipped: exit code 77. neovim_test.py LOCKSTEP SOURCES"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

LOCKSTEP, SOURCES = (pathlib.Path(it) for it in sys.argv[1:])
TREES = ["tests/trees/bad/arg_not_closed.xml", "tests/trees/bad/unknown_node.xml"]

# Writes the messages of the file, when there are some, and completions behind the first '<' of a new line.
ASK = """
local file = arg_file
vim.cmd("edit " .. file)
vim.wait(20000, function() return #vim.diagnostic.get(0) > 0 end, 20)
local found = {}
for _, it in ipairs(vim.diagnostic.get(0)) do table.insert(found, { it.lnum + 1, it.message }) end
vim.fn.writefile({ vim.json.encode(found) }, arg_out)
vim.cmd("qall!")
"""


def blocks(heading):
    page = (SOURCES / "docs/editors.md").read_text()
    section = page[page.index(f"\n## {heading}\n"):]
    return re.findall(r"```lua\n(.*?)```", section[:section.index("\n## ", 4)], re.DOTALL)


def version():
    text = subprocess.run(["nvim", "--version"], capture_output=True, text=True, check=True).stdout
    return tuple(int(it) for it in re.search(r"v(\d+)\.(\d+)", text).groups())


def messages(init, tree, work):
    out = work / "messages.json"
    ask = ASK.replace("arg_file", json.dumps(str(SOURCES / tree))).replace("arg_out", json.dumps(str(out)))
    (work / "init.lua").write_text(init)
    (work / "ask.lua").write_text(ask)
    environment = {**os.environ, "PATH": f"{LOCKSTEP.parent}:{os.environ['PATH']}", "XDG_STATE_HOME": str(work),
                   "XDG_CACHE_HOME": str(work), "HOME": str(work)}
    command = ["nvim", "--headless", "-u", str(work / "init.lua"), "-i", "NONE", "-c", f"luafile {work / 'ask.lua'}"]
    subprocess.run(command, env=environment, cwd=work, check=True, timeout=60)
    return {(line, text.split("\n")[0]) for line, text in json.loads(out.read_text())}


def checked(tree):
    run = subprocess.run([LOCKSTEP, "check", "--format", "json", SOURCES / tree], capture_output=True, text=True)
    return {(it["line"], it["message"]) for it in json.loads(run.stdout)}


def main():
    if shutil.which("nvim") is None:
        print("no nvim: apt-get install neovim")
        return 77
    newer, older = blocks("Neovim")
    init = newer if version() >= (0, 8) else older
    for tree in TREES:
        with tempfile.TemporaryDirectory() as work:
            found, expected = messages(init, tree, pathlib.Path(work)), checked(tree)
        assert expected and expected <= found, f"{tree}: expected {expected}, Neovim has {found}"
    print(f"Neovim {version()}: as check says")
    return 0


sys.exit(main())
