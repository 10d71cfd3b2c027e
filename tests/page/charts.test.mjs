// What is read off the charts, and what is done with them.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { launch, open, solution } from "./browser.mjs";

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

const NAME = "table1-relaxed";
const chart = (page, heading) => page.locator("#charts figure").filter({ has: page.locator("figcaption", { hasText: heading }) });
const part = (page) => page.locator("#playback .controls input").first().inputValue().then(Number);

// A pointer at that part of the duration, over the middle of the frame.
async function point(page, figure, share) {
  const holder = figure.locator(".chart");
  await holder.scrollIntoViewIfNeeded();
  const box = await holder.boundingBox();
  const [left, , width] = (await holder.getAttribute("data-frame")).split(" ").map(Number);
  return [box.x + box.width * (left + share * width), box.y + box.height / 2];
}

test("at the cursor stand the values of the solution", async () => {
  const { page, faults, close } = await open(browser, NAME);
  const { trajectory } = solution(NAME);
  const figure = chart(page, "Joint angles");
  const last = trajectory.t.length - 1, k = Math.round(last / 2);
  await page.mouse.move(...await point(page, figure, trajectory.t[k] / trajectory.t[last]));
  const lines = await figure.locator(".readout div").allTextContents();
  assert.equal(lines.length, 3);
  const value = (line) => Number(line.match(/[−\d.]+(?= s$|$)/)[0].replace("−", "-"));
  // The pointer stands on whole pixels.
  assert.ok(Math.abs(value(lines[0]) - trajectory.t[k]) < 0.1, lines[0]);
  for (const [j, name] of ["shoulder", "elbow"].entries()) {
    assert.ok(lines[j + 1].trim().startsWith(name), lines[j + 1]);
    const wanted = (180 / Math.PI) * trajectory.joint_position[k][j];
    const slope = (180 / Math.PI) * Math.abs(trajectory.joint_velocity[k][j]);
    assert.ok(Math.abs(value(lines[j + 1]) - wanted) < 0.1 * slope + 0.02, `${lines[j + 1]}, wanted ${wanted}`);
  }
  assert.ok(await figure.locator("i.cursor").isVisible());
  await page.mouse.move(2, 2);
  assert.ok(!(await figure.locator(".readout").isVisible()));
  assert.deepEqual(faults, []);
  await close();
});

test("a click and a drag take the playback to that time", async () => {
  const { page, close } = await open(browser, NAME);
  const figure = chart(page, "Base rate");
  await page.mouse.click(...await point(page, figure, 0.25));
  assert.ok(Math.abs((await part(page)) - 0.25) < 0.01);
  await page.mouse.down();
  await page.mouse.move(...await point(page, figure, 0.75), { steps: 3 });
  await page.mouse.up();
  assert.ok(Math.abs((await part(page)) - 0.75) < 0.01);
  const [now] = await figure.locator("i.now").evaluateAll((lines) => lines.map((line) => line.getBoundingClientRect().x));
  assert.ok(Math.abs(now - (await point(page, figure, 0.75))[0]) < 2);
  await close();
});

test("entries of the legend hide and show their curves, by keys as well", async () => {
  const { page, close } = await open(browser, NAME);
  const figure = chart(page, "Base displacement");
  const button = figure.getByRole("button", { name: "straight joint path" });
  const curves = figure.locator(".chart [data-curve]");
  const displays = () => curves.evaluateAll((parts) => parts.map((one) => getComputedStyle(one).display));
  assert.ok(!(await displays()).includes("none"));
  await button.focus();
  await page.keyboard.press("Enter");
  assert.equal(await button.getAttribute("aria-pressed"), "false");
  // x and y of the straight path, which have one entry.
  assert.equal((await displays()).filter((one) => one === "none").length, 2);
  await page.mouse.move(...await point(page, figure, 0.5));
  assert.equal(await figure.locator(".readout div").count(), 3);
  await button.focus();
  await page.keyboard.press(" ");
  assert.ok(!(await displays()).includes("none"));
  assert.equal(await button.getAttribute("aria-pressed"), "true");
  await close();
});

test("a chart is had as SVG with its legend and as CSV with its numbers", async () => {
  const { page, faults, close } = await open(browser, NAME);
  const figure = chart(page, "Joint angles");
  const save = async (kind) => {
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      figure.getByRole("button", { name: `Download Joint angles as ${kind}` }).click(),
    ]);
    return [download.suggestedFilename(), readFileSync(await download.path(), "utf8")];
  };
  const [drawingName, drawing] = await save("SVG");
  assert.equal(drawingName, "joint-angles.svg");
  const seen = await page.evaluate((text) => {
    const parsed = new DOMParser().parseFromString(text, "image/svg+xml");
    return [parsed.querySelector("parsererror"), parsed.querySelectorAll("[data-entry] text").length,
      parsed.querySelectorAll("[data-divisions]").length, parsed.documentElement.getAttribute("viewBox").split(" ")[1]];
  }, drawing);
  assert.deepEqual(seen, [null, 3, 0, "0"]);
  const [name, text] = await save("CSV");
  assert.equal(name, "joint-angles.csv");
  const [head, ...rows] = text.trim().split("\r\n");
  assert.equal(head, '"Time (s)","shoulder: Angle (deg)","elbow: Angle (deg)"');
  const { trajectory } = solution(NAME);
  const numbers = rows.map((row) => row.split(",").map(Number));
  for (const [k, t] of trajectory.t.entries()) {
    const row = numbers.reduce((best, one) => (Math.abs(one[0] - t) < Math.abs(best[0] - t) ? one : best));
    if (Math.abs(row[0] - t) > 1e-4) continue;
    trajectory.joint_position[k].forEach((angle, j) => assert.ok(Math.abs(row[j + 1] - (180 / Math.PI) * angle) < 2e-3));
  }
  assert.deepEqual(faults, []);
  await close();
});

test("a chart is had as PNG, four pixels a point", async () => {
  const { page, faults, close } = await open(browser, NAME);
  const figure = chart(page, "Joint angles");
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    figure.getByRole("button", { name: "Download Joint angles as PNG" }).click(),
  ]);
  assert.equal(download.suggestedFilename(), "joint-angles.png");
  const bytes = readFileSync(await download.path());
  assert.equal(bytes.subarray(1, 4).toString(), "PNG");
  const [width, height] = [bytes.readUInt32BE(16), bytes.readUInt32BE(20)];
  assert.ok(width === 4 * 252 && height > width / 3, `${width} by ${height}`);
  // White paper, and curves on it.
  const colours = await page.evaluate(async (text) => {
    const picture = new Image();
    picture.src = `data:image/png;base64,${text}`;
    await picture.decode();
    const canvas = new OffscreenCanvas(picture.width, picture.height);
    const pen = canvas.getContext("2d");
    pen.drawImage(picture, 0, 0);
    const { data } = pen.getImageData(0, 0, picture.width, picture.height);
    const count = (r, g, b) => {
      let found = 0;
      for (let k = 0; k < data.length; k += 4) found += data[k] === r && data[k + 1] === g && data[k + 2] === b;
      return found;
    };
    return [count(255, 255, 255) / (data.length / 4), count(0, 0x72, 0xb2)];
  }, bytes.toString("base64"));
  assert.ok(colours[0] > 0.8 && colours[1] > 300, colours.join());
  assert.deepEqual(faults, []);
  await close();
});

// Times that stand below a chart.
const ticks = (figure) => figure.locator(".chart text[text-anchor=middle]").evaluateAll((texts) => texts
  .filter((text) => text.getClientRects().length && !Number.isNaN(Number(text.textContent)))
  .map((text) => Number(text.textContent)));

test("a part of the time is seen in all charts, by buttons, hand and wheel", async () => {
  const { page, faults, close } = await open(browser, NAME);
  const { trajectory } = solution(NAME);
  const [figure, other] = [chart(page, "Joint angles"), chart(page, "Base rate")];
  const group = page.getByRole("group", { name: "Time shown" });
  const seen = async () => {
    const text = await group.locator("output").textContent();
    return text ? text.match(/[\d.]+/g).map(Number) : [0, 20];
  };
  const path = (one) => one.locator(".chart [data-curve] path").first().getAttribute("d");
  const whole = [await path(figure), await path(other)];
  assert.deepEqual(await ticks(figure), [0, 5, 10, 15, 20]);

  await page.keyboard.down("Shift");
  await page.mouse.move(...await point(page, figure, 0.25));
  await page.mouse.down();
  await page.mouse.move(...await point(page, figure, 0.5), { steps: 3 });
  await page.mouse.up();
  await page.keyboard.up("Shift");
  const [from, to] = await seen();
  assert.ok(Math.abs(from - 5) < 0.1 && Math.abs(to - 10) < 0.1, `${from} to ${to}`);
  for (const one of [figure, other]) {
    const labels = await ticks(one);
    assert.ok(labels.every((label) => label >= from - 0.1 && label <= to + 0.1), labels.join());
  }
  // The cursor's line and the curve under it are at the time and value of the solution.
  const k = trajectory.t.findIndex((t) => t > 7);
  await page.mouse.move(...await point(page, figure, (trajectory.t[k] - from) / (to - from)));
  const [time, , elbow] = await figure.locator(".readout div").allTextContents();
  assert.ok(Math.abs(parseFloat(time) - trajectory.t[k]) < 0.06, time);
  const wanted = (180 / Math.PI) * trajectory.joint_position[k][1];
  assert.ok(Math.abs(Number(elbow.match(/[−\d.]+$/)[0].replace("−", "-")) - wanted) < 0.5, elbow);
  // So is the curve itself, by the labels beside it.
  const drawn = await figure.evaluate((node, at) => {
    const labels = [...node.querySelectorAll(".chart text[text-anchor=end]")].filter((text) => text.getClientRects().length);
    const [a, b] = labels.map((text) => [Number(text.textContent.replace("−", "-")), Number(text.getAttribute("y")) - 0.36 * Number(text.getAttribute("font-size"))]);
    const line = node.querySelectorAll(".chart [data-curve] path")[1];
    const points = line.getAttribute("d").slice(1).split("L").map((pair) => pair.split(" ").map(Number));
    const svg = node.querySelector(".chart > svg > svg");
    const [x, w] = ["x", "width"].map((name) => Number(svg.getAttribute(name)));
    const place = x + at * w, next = points.findIndex(([px]) => px > place), [p, q] = [points[next - 1], points[next]];
    const y = p[1] + ((place - p[0]) / (q[0] - p[0])) * (q[1] - p[1]);
    return a[0] + ((y - a[1]) / (b[1] - a[1])) * (b[0] - a[0]);
  }, (trajectory.t[k] - from) / (to - from));
  assert.ok(Math.abs(drawn - wanted) < 0.5, `${drawn}, wanted ${wanted}`);

  assert.notEqual(await path(figure), whole[0]);
  await group.getByRole("button", { name: "Show all of the time" }).click();
  assert.deepEqual([await path(figure), await path(other)], whole);
  await group.getByRole("button", { name: "Show less time" }).click();
  assert.ok(Math.abs((await seen())[1] - (await seen())[0] - 10) < 0.1);
  await page.mouse.move(...await point(page, figure, 0.5));
  await page.keyboard.down("Control");
  await page.mouse.wheel(0, -300);
  await page.keyboard.up("Control");
  const shorter = await seen();
  assert.ok(shorter[1] - shorter[0] < 5, shorter.join());
  await page.mouse.dblclick(...await point(page, figure, 0.5));
  assert.deepEqual([await path(figure), await path(other)], whole);
  assert.deepEqual(faults, []);
  await close();
});

test("a name that a spreadsheet would compute is quoted for it", async () => {
  const { page, close } = await open(browser, "hostile-names");
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    chart(page, "Joint angles").getByRole("button", { name: "as CSV" }).click(),
  ]);
  const [head] = readFileSync(await download.path(), "utf8").split("\r\n");
  assert.ok(head.endsWith(`,"'=1+1""'<img id=injected>: Angle (deg)"`), head);
  await close();
});

test("mesh lines are drawn when asked for", async () => {
  const { page, close } = await open(browser, NAME);
  const shown = () => page.locator("#charts [data-divisions]").first().evaluate((part) => getComputedStyle(part).display);
  assert.equal(await shown(), "none");
  await page.getByLabel("mesh lines").check();
  assert.equal(await shown(), "inline");
  await close();
});

test("accelerations are in degrees, and limits that differ have the colours of their joints", async () => {
  const { page, close } = await open(browser, NAME);
  const figure = chart(page, "Controls u");
  assert.ok((await figure.locator(".chart text").allTextContents()).includes("Acceleration (deg/s²)"));
  await page.mouse.move(...await point(page, figure, 0));
  const button = figure.getByRole("button", { name: "limits, each in its colour" });
  assert.equal(await button.count(), 1);
  const colours = await figure.locator(".chart [data-curve] path[stroke-dasharray]").evaluateAll((lines) => lines.map((line) => line.getAttribute("stroke")));
  assert.ok(!colours.includes("#808080"), colours.join());
  await close();
});

test("limits that some joints share name them", async () => {
  const { page, close } = await open(browser, "dual-arm");
  const legends = await chart(page, "Joint angles").locator(".legend button").allTextContents();
  const limits = legends.filter((text) => text.startsWith("limit of "));
  assert.ok(limits.length > 1, legends.join("; "));
  const named = limits.flatMap((text) => text.replace("limit of ", "").replace(" (beyond the axis)", "").split(", "));
  assert.deepEqual(named.sort(), ["left_elbow", "left_roll", "left_yaw", "right_elbow", "right_roll", "right_yaw"]);
  await close();
});
