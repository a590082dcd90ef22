"""What docs/editors.md says of Neovim, in a headless one: the messages of a tree are those of check, and a refactoring changes
its text. Without Neovim it is skipped: exit code 77. neovim_test.py LOCKSTEP SOURCES"""
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

TREE = """<root lockstep="1">
  <BehaviorTree ID="Main">
    WAIT
  </BehaviorTree>
</root>
"""
# Wraps the first Wait of the file, and writes it.
WRAP = """
vim.cmd("silent edit " .. arg_file)
vim.fn.search("<Wait")
local clients = vim.lsp.get_clients or vim.lsp.get_active_clients
vim.wait(20000, function() return clients()[1] ~= nil and clients()[1].initialized end, 20)
local params = vim.lsp.util.make_range_params(0, "utf-16")
params.context = { diagnostics = {}, only = { "refactor.rewrite" } }
local function wrap()
  local answers = vim.lsp.buf_request_sync(0, "textDocument/codeAction", params, 5000) or {}
  for _, answer in pairs(answers) do
    for _, it in ipairs(answer.result or {}) do
      if it.title == "Wrap in Inverter" then
        vim.lsp.util.apply_workspace_edit(it.edit, "utf-16")
        return true
      end
    end
  end
end
vim.wait(20000, wrap, 20)
vim.cmd("silent write")
vim.cmd("qall!")
"""


def blocks(heading):
    page = (SOURCES / "docs/editors.md").read_text()
    section = page[page.index(f"\n## {heading}\n"):]
    return re.findall(r"```lua\n(.*?)```", section[:section.index("\n## ", 4)], re.DOTALL)


def version():
    text = subprocess.run(["nvim", "--version"], capture_output=True, text=True, check=True).stdout
    return tuple(int(it) for it in re.search(r"v(\d+)\.(\d+)", text).groups())


def neovim(init, ask, work):
    (work / "init.lua").write_text(init)
    (work / "ask.lua").write_text(ask)
    environment = {**os.environ, "PATH": f"{LOCKSTEP.parent}:{os.environ['PATH']}", "XDG_STATE_HOME": str(work),
                   "XDG_CACHE_HOME": str(work), "HOME": str(work)}
    command = ["nvim", "--headless", "-u", str(work / "init.lua"), "-i", "NONE", "-c", f"luafile {work / 'ask.lua'}"]
    subprocess.run(command, env=environment, cwd=work, check=True, timeout=60)


def messages(init, tree, work):
    out = work / "messages.json"
    ask = ASK.replace("arg_file", json.dumps(str(SOURCES / tree))).replace("arg_out", json.dumps(str(out)))
    neovim(init, ask, work)
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
    with tempfile.TemporaryDirectory() as work:
        tree, wait = pathlib.Path(work) / "tree.xml", '<Wait seconds="1"/>'
        tree.write_text(TREE.replace("WAIT", wait))
        neovim(init, WRAP.replace("arg_file", json.dumps(str(tree))), pathlib.Path(work))
        expected = TREE.replace("WAIT", f"<Inverter>\n      {wait}\n    </Inverter>")
        assert tree.read_text() == expected, f"expected {expected}, Neovim has {tree.read_text()}"
    print(f"Neovim {version()}: as check says, and a refactoring")
    return 0


sys.exit(main())
