// One Chromium for the tests of a file, and pages of it that write down what goes wrong.

import { createRequire } from "node:module";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const { FFSM_PAGE_HOME: home, FFSM_PAGES: pages, FFSM_CHROMIUM: chromium } = process.env;
// Packages are installed below target/, where the resolution of imports does not look.
const require = createRequire(pathToFileURL(join(home, "package.json")));
const playwright = require("playwright-core");

export const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");
export const names = readdirSync(pages).filter((name) => existsSync(join(pages, name, "report.html")));
export const widths = { narrow: { width: 400, height: 800 }, wide: { width: 1280, height: 900 } };

export const launch = () => playwright.chromium.launch({
  executablePath: chromium,
  args: [
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
  ],
});

/** What a command wrote as JSON beside its page. */
export const written = (name, file) => JSON.parse(readFileSync(join(pages, name, file), "utf8"));
export const solution = (name) => written(name, "solution.json");

/** The page of a problem, or another in its folder; `faults` collects errors of the console and requests to anywhere else. */
export async function open(browser, name, options = {}, file = "report.html") {
  const context = await browser.newContext({
    viewport: widths.wide, reducedMotion: "reduce", acceptDownloads: true, ...options,
  });
  const page = await context.newPage();
  const faults = [];
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  page.on("pageerror", (error) => faults.push(error.message));
  const address = pathToFileURL(join(pages, name, file)).href;
  page.on("request", (request) => {
    const url = request.url();
    if (url !== address && !url.startsWith("data:") && !url.startsWith("blob:")) faults.push(`asks for ${url}`);
  });
  await page.goto(address);
  return { page, faults, close: () => context.close() };
}
