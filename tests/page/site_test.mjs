// The site of docs/, as a person has it who has unpacked it and opens its pages as files.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { BUILD, SOURCE, close, open, soon } from "./support.mjs";

const SITE = join(SOURCE, "build/site");
const hasMkdocs = existsSync("/usr/bin/mkdocs");
after(() => close(/^Blocked autofocusing/)); // the recording in the front page would take the keyboard
before(() => {
  if (hasMkdocs && !existsSync(join(SITE, "offline.js")))
    execFileSync(join(SOURCE, "interpreter/packaging/site/build.sh"), [join(BUILD, "lockstep")]);
});

const skip = hasMkdocs ? false : "no mkdocs";
const at = (name) => `file://${join(SITE, name)}.html`;

test("search finds a page, and leads to it", { skip }, async () => {
  const page = await open(at("tutorial"));
  await page.getByRole("textbox", { name: "Search" }).pressSequentially("soname");
  await page.locator(".md-search-result__link", { hasText: "Packages and services" }).click();
  await page.waitForURL(/packages\.html/);
});

for (const [device, width, height] of [["a desktop", 1280, 900], ["a phone", 390, 844]]) {
  test(`pages fit on ${device}, and ask no other host`, { skip }, async () => {
    const page = await open(at("index"), { viewport: { width, height } });
    const others = [];
    page.on("request", (request) => /^(https?|ws):/.test(request.url()) && others.push(request.url()));
    for (const name of ["index", "tutorial", "language", "cli", "glossary", "packages"]) {
      await page.goto(at(name));
      const beyond = () => page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      await soon.equal(page, beyond, 0);
    }
    assert.deepEqual(others, []);
  });
}

test("the front page has a recording that plays", { skip }, async () => {
  const page = await open(at("index"));
  const recording = page.frameLocator("iframe[title]");
  await recording.getByRole("treeitem", { name: /^base[,:]/ }).waitFor();
});
