// What is wrong with a page as it lies on a screen.

import assert from "node:assert/strict";
import { axe } from "./browser.mjs";

// What reaches beyond the window, unless it lies in something that scrolls by itself.
const overhanging = () => {
  const wide = document.documentElement.clientWidth;
  const scrolls = (node) => node && node !== document.body &&
    (["auto", "scroll", "hidden"].includes(getComputedStyle(node).overflowX) || scrolls(node.parentElement));
  return [...document.body.querySelectorAll("*")]
    .filter((node) => node.getBoundingClientRect().right > wide + 0.5 && !scrolls(node.parentElement))
    .map((node) => node.outerHTML.slice(0, 80));
};

/** No overhang, no serious fault of accessibility. */
export async function lies(page, { width }) {
  assert.deepEqual(await page.evaluate(overhanging), []);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => window.axe.run());
  const serious = violations.filter(({ impact }) => ["serious", "critical"].includes(impact));
  const told = serious.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html.slice(0, 120)).join(" | ")}`);
  assert.deepEqual(told, []);
}

/** Sheets of A4 that it prints to. */
export async function sheets(page) {
  const pdf = (await page.pdf({ format: "A4" })).toString("latin1");
  return pdf.match(/\/Type\s*\/Page\b/g).length;
}
