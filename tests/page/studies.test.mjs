// The pages of dispersions and trade-offs, and what a search found on that of its plan.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { launch, open, solution, widths, written } from "./browser.mjs";
import { lies, sheets } from "./screen.mjs";

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

for (const [name, file] of [["dispersed", "dispersion.html"], ["traded", "pareto.html"]]) {
  for (const [size, viewport] of Object.entries(widths)) for (const colorScheme of ["light", "dark"])
    test(`${file}, ${size}, ${colorScheme}: no error, no overhang, no serious fault of accessibility`, async () => {
      const { page, faults, close } = await open(browser, name, { viewport, colorScheme }, file);
      await lies(page, viewport);
      assert.deepEqual(faults, []);
      await close();
    });

  test(`${file} prints to at most four pages`, async () => {
    const { page, close } = await open(browser, name, {}, file);
    const count = await sheets(page);
    assert.ok(count <= 4, `${count} pages`);
    await close();
  });
}

test("every figure of a dispersion has its quantiles, as in the JSON, and its histogram", async () => {
  const { page, close } = await open(browser, "dispersed", {}, "dispersion.html");
  const figures = Object.values(written("dispersed", "dispersion.json").figures);
  const rows = page.locator("section", { has: page.locator("h2", { hasText: "Quantiles" }) }).locator("tbody tr, table > tr");
  assert.equal(await rows.count(), figures.length);
  const charts = page.locator("section", { has: page.locator("h2", { hasText: "Distributions" }) }).locator(".chart > svg");
  assert.equal(await charts.count(), figures.length);
  assert.match(await page.locator("header p").textContent(), /In 99 of 100 replays it stays below \d/);
  await close();
});

test("every point of a trade-off stands in the table, and its curve is had as CSV", async () => {
  const { page, faults, close } = await open(browser, "traded", {}, "pareto.html");
  const { rows } = written("traded", "pareto.json");
  assert.equal(await page.locator("table.numbers tr").count(), rows.length + 1);
  assert.match(await page.locator("header p").textContent(), new RegExp(`^${rows.length} of ${rows.length} points are solved`));
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Download Terms of the cost as CSV" }).click(),
  ]);
  const [head, ...lines] = readFileSync(await download.path(), "utf8").trim().split("\r\n");
  assert.equal(head, '"Joint effort E","base motion B: Base motion B"');
  const numbers = lines.map((line) => line.split(",").map(Number));
  rows.forEach((row, k) => [row.joint_effort, row.base_motion].forEach((value, i) =>
    assert.ok(Math.abs(numbers[k][i] - value) < 1e-5 * Math.abs(value), `${numbers[k]}`)));
  // Nothing here goes by time.
  assert.equal(await page.getByRole("group", { name: "Time shown" }).count(), 0);
  assert.deepEqual(faults, []);
  await close();
});

test("the optima that a search found stand on the page of the best", async () => {
  const { page, close } = await open(browser, "searched");
  const { search: { optima, tried, solved, seed } } = solution("searched");
  const section = page.locator("section", { has: page.locator("h2", { hasText: "Other optima" }) });
  assert.equal(await section.locator("tr").count(), 1 + Math.min(12, optima.length));
  const text = await section.locator("p").first().textContent();
  assert.ok(text.startsWith(`${solved} of ${tried} starts were solved (seed ${seed})`), text);
  await close();
});
