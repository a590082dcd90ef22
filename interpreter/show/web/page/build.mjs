// Makes page.html: one file with script, styles and the licenses of what is in it.
//   node build.mjs            writes it
//   node build.mjs --check    compares it with what is there
import { createHash } from "node:crypto";
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const HERE = dirname(fileURLToPath(import.meta.url));
const MOST = 200_000; // bytes, with gzip
const BUNDLED = ["preact", "uplot", "d3-flextree", "d3-hierarchy"];

async function bundled(entry) {
  const result = await build({
    absWorkingDir: HERE, entryPoints: [entry], bundle: true, minify: true, write: false, format: "iife",
    target: "es2022", jsx: "automatic", jsxImportSource: "preact", legalComments: "none", charset: "ascii",
  });
  return result.outputFiles[0].text.trim();
}

// As tests/page/fresh.cmake computes it: of "<sha256>  <name>\n" for each source, in order of the names.
function sourcesHash() {
  const names = readdirSync(join(HERE, "src"), { recursive: true, withFileTypes: true })
    .filter((file) => file.isFile())
    .map((file) => join(file.parentPath ?? file.path, file.name).slice(HERE.length + 1));
  names.push("build.mjs", "package-lock.json", "page.in.html");
  const sha256 = (bytes) => createHash("sha256").update(bytes).digest("hex");
  return sha256(names.sort().map((name) => `${sha256(readFileSync(join(HERE, name)))}  ${name}\n`).join(""));
}

function licenses() {
  return BUNDLED.map((name) => {
    const folder = join(HERE, "node_modules", name);
    const { version } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const file = readdirSync(folder).find((one) => /^licen[cs]e/i.test(one));
    return `${name} ${version}\n\n${readFileSync(join(folder, file), "utf8").trim()}\n`;
  }).join("\n----\n\n").replace(/[^\x00-\x7f]/g, (letter) => `&#${letter.codePointAt(0)};`);
}

const hashOf = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

async function page() {
  const script = await bundled("src/main.tsx");
  const style = await bundled("src/page.css");
  const policy = [
    "default-src 'none'", `script-src ${hashOf(script)}`, `style-src ${hashOf(style)}`, "connect-src 'self'",
    "img-src data:", "base-uri 'none'", "form-action 'none'",
  ].join("; ");
  const parts = { policy, style, script, licenses: licenses().replaceAll("<", "&lt;"), sources: sourcesHash() };
  return readFileSync(join(HERE, "page.in.html"), "utf8").replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
}

const text = await page();
const target = join(HERE, "page.html");
const size = gzipSync(text).length;
if (size > MOST) throw new Error(`page.html has ${size} bytes with gzip, at most ${MOST} are allowed`);
if (process.argv.includes("--check")) {
  if (readFileSync(target, "utf8") !== text) throw new Error("page.html is stale: run `node build.mjs`");
} else {
  writeFileSync(target, text);
}
console.log(`page.html: ${text.length} bytes, ${size} with gzip`);
