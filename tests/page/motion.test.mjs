// The pictures of the motion: what is drawn where, and what hands and keys do to it.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launch, open, solution } from "./browser.mjs";
import { discs, ring, seek } from "./pixels.mjs";

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

// Distances of each joint from the one before, as the robots' files have them, m.
const ARMS = { "table1-relaxed": [0.156, 0.506], capture: [0.25, 0.45, 0.4] };

// The joints at node `k`: plain forward kinematics in the plane.
function joints(trajectory, arm, k) {
  let [x, y] = trajectory.base_position[k];
  let [angle] = trajectory.base_attitude[k];
  return arm.map((length, j) => {
    [x, y] = [x + length * Math.cos(angle), y + length * Math.sin(angle)];
    angle += trajectory.joint_position[k][j];
    return [x, y];
  });
}

const orders = (items) => (items.length < 2 ? [items]
  : items.flatMap((item, i) => orders(items.filter((_, k) => k !== i)).map((rest) => [item, ...rest])));
const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;
const off = ([a, b], [c, d]) => Math.hypot(a - c, b - d);

// Scale and offset by which points in metres became points in pixels, without a turn, by least squares.
function fit(metres, pixels) {
  const centre = [0, 1].map((i) => mean(metres.map((point) => point[i])));
  const middle = [0, 1].map((i) => mean(pixels.map((point) => point[i])));
  let [over, under] = [0, 0];
  metres.forEach((point, k) => {
    const [x, y] = [point[0] - centre[0], -(point[1] - centre[1])];
    over += x * (pixels[k][0] - middle[0]) + y * (pixels[k][1] - middle[1]);
    under += x * x + y * y;
  });
  const scale = over / under;
  return ([x, y]) => [middle[0] + scale * (x - centre[0]), middle[1] - scale * (y - centre[1])];
}

// From metres to pixels of the first picture, by the joints at the start; and how far off these are.
async function mapping(page, trajectory, arm) {
  await seek(page, 0);
  const found = await discs(page);
  assert.equal(found.length, arm.length);
  const start = joints(trajectory, arm, 0);
  const fits = orders(found).map((order) => {
    const place = fit(start, order);
    return { place, gap: Math.max(...start.map((point, k) => off(place(point), order[k]))) };
  });
  return fits.reduce((best, one) => (one.gap < best.gap ? one : best));
}

for (const [name, arm] of Object.entries(ARMS)) {
  test(`${name}: the drawn joints are those of the solution to a pixel`, async () => {
    const { page, faults, close } = await open(browser, name);
    const { trajectory } = solution(name);
    const last = trajectory.t.length - 1;
    const at = async (k) => {
      await seek(page, trajectory.t[k] / trajectory.t[last]);
      return discs(page);
    };
    const { place, gap } = await mapping(page, trajectory, arm);
    assert.ok(gap < 1, `${gap} pixels at the start`);
    for (const share of [0.15, 0.3, 0.45, 0.6, 0.8, 1]) {
      const k = Math.round(share * last);
      const drawn = await at(k);
      for (const point of joints(trajectory, arm, k)) {
        const gap = Math.min(...drawn.map((disc) => off(disc, place(point))));
        assert.ok(gap < 1, `${gap} pixels at ${trajectory.t[k]} s`);
      }
    }
    assert.deepEqual(faults, []);
    await close();
  });
}

test("goals and way-points are drawn where the problem has them", async () => {
  // In the base frame of the start, which is not turned; in inertial axes.
  for (const [name, at] of [
    ["capture", ({ base_position: [[x, y]] }) => [x + 0.75, y + 0.65]],
    ["way-point", () => [0.9, -0.1]],
  ]) {
    const { page, close } = await open(browser, name);
    const { trajectory } = solution(name);
    const { place } = await mapping(page, trajectory, ARMS.capture);
    const { circle, inside } = await ring(page, place(at(trajectory)));
    // Within lies an axis of the goal at most.
    assert.ok(circle > 0.7 && inside < 0.5, `${name}: ${circle} of the ring, ${inside} within`);
    await close();
  }
});

test("the plan's arm is at goals and way-points in time", async () => {
  for (const name of ["capture", "way-point", "pose-in-space"]) {
    const { page, close } = await open(browser, name);
    const { motions: [{ frames }], marks, tips: [tip], links, planar } =
      await page.evaluate(() => JSON.parse(document.getElementById("scene").textContent));
    assert.ok(marks.some((mark) => mark.at), name);
    for (const { at, axes, part, within, label } of marks) {
      const frame = frames[Math.round(part * (frames.length - 1))];
      const point = (k) => frame.slice(3 * k, 3 * k + 3);
      // Along each axis of the goal's frame.
      const gap = at ? Math.hypot(...point(tip).map((value, i) => value - at[i])) : 0;
      assert.ok(gap < Math.sqrt(3) * within + 1e-3, `${name}, ${label}: ${gap} m`);
      if (!planar || !axes.length) continue;
      // The hand points along its x axis; 0.05 rad are allowed.
      const [from, to] = links.find(([, end]) => end === tip).map(point);
      const angle = ([x, y]) => Math.atan2(y, x);
      assert.ok(Math.abs(angle([to[0] - from[0], to[1] - from[1]]) - angle(axes[0])) < 0.052, name);
    }
    await close();
  }
});

test("hands and keys zoom, move and turn the view, and home takes it back", async () => {
  const { page, faults, close } = await open(browser, "capture");
  const canvas = page.locator(".stage canvas").first();
  await seek(page, 0);
  await canvas.scrollIntoViewIfNeeded();
  const box = await canvas.boundingBox();
  const middle = [box.x + box.width / 2, box.y + box.height / 2];
  const home = await discs(page);
  const width = (points) => Math.max(...points.map(([x]) => x)) - Math.min(...points.map(([x]) => x));
  const same = (a, b, message) => a.forEach((point, k) => assert.ok(off(point, b[k]) < 0.6, message));

  await canvas.focus();
  await page.keyboard.press("+");
  const larger = await discs(page);
  assert.ok(Math.abs(width(larger) / width(home) - 1.25) < 0.02);
  await page.keyboard.press("-");
  same(await discs(page), home, "zoomed out again");

  await page.keyboard.down("Shift");
  await page.mouse.move(...middle);
  await page.mouse.down();
  await page.mouse.move(middle[0] + 40, middle[1] - 25, { steps: 4 });
  await page.mouse.up();
  await page.keyboard.up("Shift");
  same(await discs(page), home.map(([x, y]) => [x + 40, y - 25]), "moved with the mouse");
  await page.keyboard.press("Home");
  same(await discs(page), home, "home by key");
  await page.keyboard.press("Shift+ArrowUp");
  (await discs(page)).forEach(([x, y], k) => assert.ok(Math.abs(x - home[k][0]) < 0.6 && y < home[k][1] - 5, "moved up"));
  await page.keyboard.press("Shift+ArrowDown");
  same(await discs(page), home, "moved down again");

  await page.mouse.wheel(0, -200);
  assert.ok(width(await discs(page)) > 1.2 * width(home));
  await page.getByRole("button", { name: "home" }).click();
  same(await discs(page), home, "home by button");
  await canvas.focus();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowLeft");
  same(await discs(page), home, "turned there and back");
  await page.keyboard.press("ArrowDown");
  assert.ok((await discs(page)).some((point, k) => off(point, home[k]) > 2));
  assert.deepEqual(faults, []);
  await close();
});

test("two fingers zoom", async () => {
  const { page, close } = await open(browser, "capture", { hasTouch: true });
  await seek(page, 0);
  const spread = async () => {
    const points = await discs(page);
    return Math.max(...points.map(([x]) => x)) - Math.min(...points.map(([x]) => x));
  };
  const before = await spread();
  await page.locator(".stage canvas").first().evaluate((canvas) => {
    canvas.setPointerCapture = () => {};
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const [x, y] = [left + width / 2, top + height / 2];
    const tell = (type, pointerId, clientX) =>
      canvas.dispatchEvent(new PointerEvent(type, { pointerId, clientX, clientY: y, pointerType: "touch", buttons: 1 }));
    tell("pointerdown", 11, x - 40);
    tell("pointerdown", 12, x + 40);
    tell("pointermove", 11, x - 60);
    tell("pointermove", 12, x + 60);
    tell("pointerup", 11, x - 60);
    tell("pointerup", 12, x + 60);
  });
  assert.ok(Math.abs((await spread()) / before - 1.5) < 0.03);
  await close();
});

test("in space there are views from the front, the side and above", async () => {
  const { page, close } = await open(browser, "chaser-7dof");
  const picture = () => page.evaluate(() => document.querySelector(".stage canvas").toDataURL());
  const pictures = new Set([await picture()]);
  for (const view of ["front", "side", "top"]) {
    await page.getByRole("button", { name: view, exact: true }).click();
    pictures.add(await picture());
  }
  assert.equal(pictures.size, 4);
  await page.getByRole("button", { name: "home" }).click();
  assert.ok(pictures.has(await picture()));
  await close();
});

test("the space bar plays and pauses", async () => {
  const { page, close } = await open(browser, "capture");
  const part = () => page.locator("#playback .controls input").first().inputValue().then(Number);
  await seek(page, 0);
  await page.keyboard.press(" ");
  await page.waitForFunction(() => Number(document.querySelector("#playback .controls input").value) > 0.02);
  await page.keyboard.press(" ");
  const paused = await part();
  await page.waitForTimeout(200);
  assert.equal(await part(), paused);
  await close();
});

test("the straight joint path and MATPM are drawn into the picture when asked for", async () => {
  const { page, close } = await open(browser, "table1-relaxed");
  await seek(page, 0.5);
  const picture = () => page.evaluate(() => document.querySelector(".stage canvas").toDataURL());
  const alone = await picture();
  const pictures = new Set([alone]);
  for (const name of ["straight joint path", "MATPM"]) {
    await page.getByLabel(name, { exact: true }).check();
    pictures.add(await picture());
  }
  assert.equal(pictures.size, 3);
  for (const name of ["straight joint path", "MATPM"]) await page.getByLabel(name, { exact: true }).uncheck();
  assert.equal(await picture(), alone);
  await close();
});
