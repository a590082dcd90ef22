// Makes dist/extension.js: the extension and the client of the Language Server Protocol, in one file; and
// dist/licenses.txt, of the packages in it.
import { readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const HERE = dirname(fileURLToPath(import.meta.url));

function license(name) {
  const folder = join(HERE, "node_modules", name);
  const { version } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  const file = readdirSync(folder).find((one) => /^licen[cs]e/i.test(one));
  return `${name} ${version}\n\n${readFileSync(join(folder, file), "utf8").trim()}\n`;
}

const made = await build({
  absWorkingDir: HERE, entryPoints: ["src/extension.ts"], outfile: "dist/extension.js", bundle: true, minify: true,
  platform: "node", format: "cjs", target: "node20", external: ["vscode"], legalComments: "none", metafile: true,
});
const packages = Object.keys(made.metafile.inputs).map((file) => /^node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(file)?.[1]);
const names = [...new Set(packages.filter((name) => name !== undefined))].sort();
writeFileSync(join(HERE, "dist/licenses.txt"), names.map(license).join("\n----\n\n"));
console.log(`dist/extension.js: ${statSync(join(HERE, "dist/extension.js")).size} bytes, with ${names.join(", ")}`);
