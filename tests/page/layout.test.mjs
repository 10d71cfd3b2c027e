// The page as it lies on a screen, on a telephone and on paper.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launch, names, open, widths } from "./browser.mjs";
import { lies, sheets } from "./screen.mjs";

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

for (const name of names) {
  for (const [size, viewport] of Object.entries(widths)) for (const colorScheme of ["light", "dark"]) {
    test(`${name}, ${size}, ${colorScheme}: no error, no overhang, no serious fault of accessibility`, async () => {
      const { page, faults, close } = await open(browser, name, { viewport, colorScheme });
      await lies(page, viewport);
      assert.deepEqual(faults, []);
      await close();
    });
  }

  test(`${name} prints to at most four pages`, async () => {
    const { page, faults, close } = await open(browser, name);
    const count = await sheets(page);
    assert.ok(count <= 4, `${count} pages`);
    assert.deepEqual(faults, []);
    await close();
  });
}

// Where a PDF's pages have what links lead to: [page, height] by name.
function destinations(pdf) {
  const found = pdf.matchAll(/\/?\(?(mark-\d+-\d+)\)?\s*\[\s*(\d+) 0 R\s*\/XYZ\s+[\d.-]+\s+([\d.-]+)/g);
  return new Map([...found].map(([, name, page, height]) => [name, [Number(page), Number(height)]]));
}

for (const name of names) test(`${name}: no heading is printed below which its page ends`, async () => {
  const { page, close } = await open(browser, name);
  // Links to every heading, and to the first piece of what it stands over.
  const count = await page.evaluate(() => {
    const shown = (node) => node.getClientRects().length && !["SCRIPT", "TABLE", "THEAD", "TBODY"].includes(node.tagName);
    const headings = [...document.querySelectorAll("h2")].filter((node) => node.getClientRects().length);
    const links = document.createElement("div");
    links.style.cssText = "font-size: 1px; line-height: 1px; height: 1px";
    headings.forEach((heading, k) => {
      const printed = (node) => !node.closest(".stages, .controls, .options, #keys, details");
      const rest = [...heading.parentElement.querySelectorAll("p, tr, figure, li")];
      const first = rest.find((node) => shown(node) && printed(node));
      [heading, first].forEach((node, i) => {
        // In tables a cell, for rows are no targets.
        const target = node.tagName === "TR" ? node.firstElementChild : node;
        const mark = document.createElement("span");
        mark.id = `mark-${k}-${i}`;
        target.prepend(mark);
        links.append(Object.assign(document.createElement("a"), { href: `#${mark.id}`, textContent: "." }));
      });
    });
    document.body.append(links);
    return headings.length;
  });
  const places = destinations((await page.pdf({ format: "A4" })).toString("latin1"));
  assert.equal(places.size, 2 * count);
  for (let k = 0; k < count; k += 1) {
    const [[sheet, height], [below, lower]] = [0, 1].map((i) => places.get(`mark-${k}-${i}`));
    const gap = height - lower;
    assert.ok(sheet === below && gap > 0 && gap < 80, `heading ${k}: ${sheet}, ${height} and ${below}, ${lower}`);
  }
  await close();
});

test("the problem stands in a table, in degrees", async () => {
  const { page, close } = await open(browser, "table1-relaxed");
  const row = page.locator("table.joints tr").filter({ has: page.locator("th", { hasText: "elbow" }) });
  assert.deepEqual(await row.locator("td").allTextContents(), ["0°", "60°", "±90°", "±51.566°/s", "±229.18°/s²", "–"]);
  await close();
});

test("what is not checked is said", async () => {
  for (const [name, words] of [["table1-relaxed", "Collisions are not checked"], ["capture", "other collisions are not checked"]]) {
    const { page, close } = await open(browser, name);
    assert.ok((await page.locator("#playback").textContent()).includes(words), name);
    await close();
  }
});

test("six pictures of the motion are printed", async () => {
  const { page, close } = await open(browser, "chaser-7dof");
  await page.emulateMedia({ media: "print" });
  await page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
  const frames = page.locator(".frames canvas");
  assert.equal(await frames.count(), 6);
  const pictures = await frames.evaluateAll((all) => all.map((canvas) => canvas.toDataURL()));
  assert.equal(new Set(pictures).size, 6);
  assert.ok(await frames.first().isVisible());
  assert.ok(!(await page.locator(".stages").isVisible()));
  await close();
});

test("names from files are text wherever they stand", async () => {
  const { page, faults, close } = await open(browser, "hostile-names");
  await page.locator("#charts figure .chart").nth(3).hover();
  assert.equal(await page.locator("#injected").count(), 0);
  const name = "</script><i id=injected>";
  assert.ok((await page.locator("table.joints th").allTextContents()).includes(name));
  const legends = await page.locator(".legend button").allTextContents();
  assert.ok(legends.includes(name) && legends.includes("=1+1\"'<img id=injected>"), legends.join());
  assert.deepEqual(faults, []);
  await close();
});
