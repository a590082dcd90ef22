// Takes the pictures of the page: node tests/page/pictures.mjs DIRECTORY. docs/monitor.png is the one in light.
import { join } from "node:path";
import { SOURCE, close, goToTick, openRun, record } from "./support.mjs";

const PICTURES = {
  light: { viewport: { width: 1440, height: 900 }, colorScheme: "light" },
  dark: { viewport: { width: 1440, height: 900 }, colorScheme: "dark" },
  phone: { viewport: { width: 400, height: 850 }, colorScheme: "light", hasTouch: true },
};

const directory = process.argv[2] ?? ".";
const recording = record(join(SOURCE, "trees/fetch_and_carry.xml"));
for (const [name, options] of Object.entries(PICTURES)) {
  const page = await openRun(recording, { ...options, reducedMotion: "reduce" });
  await goToTick(page, 1450); // the arm waits for the base
  await page.locator("input.tick").blur();
  await page.waitForTimeout(500);
  await page.screenshot({ path: join(directory, `${name}.png`) });
}
await close();
