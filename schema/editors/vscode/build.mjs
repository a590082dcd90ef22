// Makes dist/extension.js: the extension and the client of the Language Server Protocol, in one file.
import { statSync } from "node:fs";
import { dirname } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

await build({
  absWorkingDir: dirname(fileURLToPath(import.meta.url)), entryPoints: ["src/extension.ts"], outfile: "dist/extension.js",
  bundle: true, minify: true, platform: "node", format: "cjs", target: "node20", external: ["vscode"],
  legalComments: "eof",
});
console.log(`dist/extension.js: ${statSync(new URL("dist/extension.js", import.meta.url)).size} bytes`);
