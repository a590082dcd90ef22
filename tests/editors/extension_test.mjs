// The extension for VS Code: it type checks, is small, names only what there is, and its colors and snippets are right.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";

const FOLDER = new URL("../../schema/editors/vscode/", import.meta.url).pathname;
const LOCKSTEP = process.env.LOCKSTEP;
const require = createRequire(join(FOLDER, "package.json"));
const about = JSON.parse(readFileSync(join(FOLDER, "package.json"), "utf8"));
const sources = readdirSync(join(FOLDER, "src")).map((name) => readFileSync(join(FOLDER, "src", name), "utf8")).join("\n");
const work = mkdtempSync(join(tmpdir(), "lockstep-extension-"));
after(() => rmSync(work, { recursive: true }));

const all = (pattern) => [...sources.matchAll(pattern)].map((it) => it[1]).sort();
const unique = (list) => [...new Set(list)];

test("it type checks", () => {
  execFileSync(join(FOLDER, "node_modules/.bin/tsc"), { cwd: FOLDER, stdio: "inherit" });
});

test("its package is small, has what package.json names, and is the same each time", () => {
  execFileSync("node", ["build.mjs"], { cwd: FOLDER });
  const pack = (name) => {
    execFileSync("/usr/bin/python3", [join(FOLDER, "vsix.py"), join(work, name)]);
    return readFileSync(join(work, name));
  };
  const bytes = pack("a.vsix");
  assert.ok(bytes.length < 200_000);
  assert.ok(bytes.equals(pack("b.vsix")));
  const names = execFileSync("/usr/bin/python3", ["-m", "zipfile", "-l", join(work, "a.vsix")], { encoding: "utf8" });
  const needed = [about.main, "dist/licenses.txt", ...about.contributes.grammars.map((it) => it.path), ...about.contributes.snippets.map((it) => it.path)];
  for (const path of needed) assert.ok(names.includes(join("extension", path)), path);
});

test("each command of package.json is registered, and each that is registered is there", () => {
  const commands = about.contributes.commands.map((it) => it.command);
  assert.deepEqual(all(/registerCommand\("([\w.]+)"/g), [...commands].sort());
  for (const menu of Object.values(about.contributes.menus)) {
    for (const row of menu) assert.ok(commands.includes(row.command), row.command);
  }
});

test("each setting that is read is in package.json, and each there is read", () => {
  const settings = Object.keys(about.contributes.configuration.properties).map((it) => it.replace("lockstep.", ""));
  const read = unique(all(/\.get(?:<[^(]*>)?\("(\w+)"/g));
  assert.deepEqual(read, settings.filter((it) => it !== "trace.server").sort()); // which the client reads
  const restricted = about.capabilities.untrustedWorkspaces.restrictedConfigurations;
  for (const it of restricted) assert.ok(settings.includes(it.replace("lockstep.", "")), it);
  for (const command of about.contributes.commands) {
    const runs = command.command !== "lockstep.restart";
    assert.equal(command.enablement, runs ? "isWorkspaceTrusted" : undefined, command.command);
  }
});

test("the options that it gives to lockstep exist", () => {
  const help = (command) => execFileSync(LOCKSTEP, [...command, command[0] === "run" ? "--help-all" : "--help"], { encoding: "utf8" });
  const options = { run: ["--clock", "--view", "--record", "--monitor", "--monitor-open", "--tree", "--arg", "--plugin", "--plugin-path"],
    test: ["--filter", "--plugin", "--plugin-path"], verify: ["--tree", "--arg", "--plugin", "--plugin-path"], "log page": ["--out"] };
  for (const [command, list] of Object.entries(options)) {
    for (const option of list) assert.match(help(command.split(" ")), new RegExp(`[ ,]${option}[ \\n=]`), `${command} ${option}`);
  }
});

// A grammar of XML as small as can be, with the scopes of that of VS Code.
const XML = {
  scopeName: "text.xml",
  patterns: [{ name: "comment.block.xml", begin: "<!--", end: "-->" },
    { name: "meta.tag.xml", begin: "<[/?!]?[\\w]+", end: ">", patterns: [
      { match: "(?:^|\\s+)[-\\w.:]+\\s*=" },
      { name: "string.quoted.double.xml", begin: "\"", end: "\"" }, { name: "string.quoted.single.xml", begin: "'", end: "'" }] }],
};

async function makeGrammar() {
  const oniguruma = require("vscode-oniguruma");
  const { INITIAL, Registry } = require("vscode-textmate");
  await oniguruma.loadWASM(readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm")).buffer);
  const own = Object.fromEntries(about.contributes.grammars.map((it) => [it.scopeName, JSON.parse(readFileSync(join(FOLDER, it.path), "utf8"))]));
  const registry = new Registry({
    onigLib: Promise.resolve({
      createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns), createOnigString: (text) => new oniguruma.OnigString(text),
    }),
    loadGrammar: async (scope) => (scope === "text.xml" ? XML : own[scope]),
    getInjections: (scope) => about.contributes.grammars.filter((it) => it.injectTo?.includes(scope)).map((it) => it.scopeName),
  });
  const grammar = await registry.loadGrammar("text.xml");
  return (line) => grammar.tokenizeLine(line, INITIAL).tokens.map((it) => [line.slice(it.startIndex, it.endIndex), it.scopes.at(-1)]);
}

const ROWS = [
  ['<Script code="n := n + 1"/>', { "n": "variable.other.lockstep", ":=": "keyword.operator.assignment.lockstep", "1": "constant.numeric.lockstep" }],
  ['<Wait seconds="1" skip_if="open or not a &lt; 3"/>', { open: "variable.other.lockstep", or: "keyword.operator.logical.lockstep", "&lt;": "keyword.operator.lockstep" }],
  ['<Sleep _onSuccess="state = \'done\'"/>', { "'done'": "string.quoted.lockstep", "=": "keyword.operator.assignment.lockstep" }],
  ['<If while="x == true"/>', { "==": "keyword.operator.lockstep", true: "constant.language.lockstep" }],
  ['<Move to="{goal}" speed="${speed}"/>', { "{goal}": "variable.other.lockstep", "${speed}": "variable.parameter.lockstep" }],
];

test("scripts, entries and arguments have colors, and nothing else has", async () => {
  const tokens = await makeGrammar();
  for (const [line, expected] of ROWS) {
    const found = tokens(line);
    for (const [text, scope] of Object.entries(expected)) {
      assert.ok(found.some(([it, its]) => it === text && its === scope), `${line}: ${text}: ${JSON.stringify(found)}`);
    }
    assert.equal(found.at(-1)[1], "meta.tag.xml", line); // the script has ended with its attribute
  }
  for (const line of ['<Move decode="a + 1"/>', '<!-- code="a + 1" {goal} -->', '<Move name="a or b"/>']) {
    assert.ok(tokens(line).every(([, scope]) => !scope.endsWith(".lockstep")), line);
  }
});

// The text of a snippet in which no field was changed.
function expanded(body) {
  return body.join("\n").replace(/\$\{\d+\|([^,|}]*)[^}]*\|\}/g, "$1").replace(/\$\{\d+:([^}]*)\}/g, "$1").replace(/\$\d+/g, "");
}

test("what snippets insert is right as it stands", () => {
  const snippets = Object.fromEntries(Object.values(JSON.parse(readFileSync(join(FOLDER, about.contributes.snippets[0].path), "utf8")))
    .map((it) => [it.prefix, expanded(it.body)]));
  const check = (name, text) => {
    writeFileSync(join(work, `${name}.xml`), text);
    const result = spawnSync(LOCKSTEP, ["check", "--strict", join(work, `${name}.xml`)], { encoding: "utf8" });
    assert.equal(result.status, 0, result.stderr);
  };
  check("tree", snippets["lockstep-tree"]);
  check("btcpp", snippets["lockstep-btcpp"]);
  for (const name of ["lockstep-barriers", "lockstep-delta"]) {
    const waits = '<Wait seconds="1"/><Wait seconds="2"/></Parallel';
    check(name, `<root lockstep="1"><BehaviorTree ID="Main">${snippets[name].replace("</Parallel", waits)}</BehaviorTree></root>`);
  }
  writeFileSync(join(work, "tree.test.xml"), snippets["lockstep-scenarios"]);
  execFileSync(LOCKSTEP, ["test", join(work, "tree.test.xml")]);
  writeFileSync(join(work, "slip.xml"), '<root lockstep="1"><BehaviorTree ID="Main"><Wait name="arm" seconds="1"/></BehaviorTree></root>');
  writeFileSync(join(work, "slip.test.xml"), `<scenarios lockstep="1" tree="slip.xml">${snippets["lockstep-scenario"]}</scenarios>`);
  assert.match(spawnSync(LOCKSTEP, ["test", "--list", join(work, "slip.test.xml")], { encoding: "utf8" }).stdout, /the arm slips/);
  assert.equal(snippets["lockstep-plugin"], '<plugin name=""/>');
  assert.equal(Object.keys(snippets).length, 7);
});

test("only files of lockstep are given to the server", async () => {
  const { build } = require("esbuild");
  const made = await build({ entryPoints: [join(FOLDER, "src/trees.ts")], format: "esm", bundle: true, write: false });
  const { isLockstep, isTree } = await import(`data:text/javascript,${encodeURIComponent(made.outputFiles[0].text)}`);
  for (const text of ["", "<", '<?xml version="1.0"?>', '<root lockstep="1">', '<!-- <project> --><root BTCPP_format="4">', "<scenarios>", "<leaves/>"]) {
    assert.ok(isLockstep(text), text);
  }
  for (const text of ["<project/>", '<?xml version="1.0"?><package format="3">', "<rooted/>", "x".repeat(5000)]) assert.ok(!isLockstep(text), text);
  assert.ok(isTree("<root>") && !isTree("<scenarios>") && !isTree("<!-- <root> --><a/>"));
});
