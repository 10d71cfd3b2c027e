// Robots whose files say what they look like.

import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { launch, open, solution } from "./browser.mjs";
import { seek } from "./pixels.mjs";

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

// How many pixels of the first picture have a blue of the base or of the links, in any light.
const blue = (page) => page.evaluate(() => {
  const canvas = document.querySelector(".stage canvas");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let [links, base] = [0, 0];
  for (let k = 0; k < data.length; k += 4) {
    if (data[k + 3] < 200 || data[k + 2] < data[k] + 30) continue;
    // The links have hardly any red in them.
    if (data[k] < 0.35 * data[k + 2]) links += 1; else base += 1;
  }
  return { links, base };
});

// How many have the orange of the panels, in any light.
const orange = (page) => page.evaluate(() => {
  const canvas = document.querySelector(".stage canvas");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let count = 0;
  for (let k = 0; k < data.length; k += 4) {
    const [red, green, blue, opaque] = data.subarray(k, k + 4);
    // Joints are yellower, paths redder.
    if (opaque > 200 && blue > 15 && green > 0.58 * red && green < 0.72 * red && blue < 0.4 * red) count += 1;
  }
  return count;
});

test("solids stand where the solution has their bodies", async () => {
  const { page, faults, close } = await open(browser, "shaped");
  const { motions: [{ frames, poses }], solids, joints } =
    await page.evaluate(() => JSON.parse(document.getElementById("scene").textContent));
  assert.deepEqual(solids.map((solid) => solid.body), [0, 0, 0, 0, 1, 1, 2]);
  assert.equal(poses.length, frames.length);
  const { trajectory } = solution("shaped");
  const [first, last] = [poses[0], poses[poses.length - 1]];
  // Bodies one and two are moved by the first and the last joint: their origins are there.
  for (const [pose, frame] of [[first, frames[0]], [last, frames[frames.length - 1]]])
    for (const [body, joint] of [[1, joints[0]], [2, joints[2]]])
      for (const i of [0, 1, 2]) assert.ok(Math.abs(pose[7 * body + i] - frame[3 * joint + i]) < 2e-3);
  // The base begins without a turn, and ends with that of the solution.
  const angle = (pose) => 2 * Math.acos(Math.min(1, Math.abs(pose[6])));
  assert.ok(angle(first) < 1e-5);
  const { final_base_attitude: turned } = solution("shaped").metrics;
  assert.ok(Math.abs(angle(last) - turned) < 1e-4, `${angle(last)}, ${turned}`);
  assert.equal(trajectory.joint_position[0].length, 3);
  assert.deepEqual(faults, []);
  await close();
});

test("base and links are seen from every side", async () => {
  const { page, faults, close } = await open(browser, "shaped");
  await seek(page, 0.5);
  for (const view of ["home", "front", "side", "top"]) {
    await page.getByRole("button", { name: view, exact: true }).click();
    const { links, base } = await blue(page);
    assert.ok(links > 150 && base > 2000, `${view}: ${links}, ${base}`);
  }
  assert.deepEqual(faults, []);
  await close();
});

test("what the file gives a colour has it", async () => {
  for (const [name, least] of [["shaped", 2000], ["chaser-7dof", 0]]) {
    const { page, faults, close } = await open(browser, name);
    await page.getByRole("button", { name: "top", exact: true }).click();
    const count = await orange(page);
    assert.ok(least ? count > least : count < 50, `${name}: ${count}`);
    assert.deepEqual(faults, []);
    await close();
  }
});

test("the page says how the robot is drawn", async () => {
  for (const [name, words] of [
    ["shaped", "The base is drawn as the robot's file has it. Links are drawn as the robot's file has them, those without a shape as capsules"],
    ["chaser-7dof", "The base is drawn as the robot's file has it. Links are drawn as capsules"],
    ["capture", "The base is drawn as the block of even density with its mass and inertia. Links are drawn as capsules"],
  ]) {
    const { page, close } = await open(browser, name);
    const text = await page.locator("#playback").textContent();
    assert.ok(text.includes(words), text);
    assert.equal(text.includes("What could not be drawn"), name === "shaped");
    await close();
  }
  const { page, close } = await open(browser, "shaped");
  const lines = await page.locator("#playback details li").allTextContents();
  assert.equal(lines.length, 1);
  assert.ok(lines[0].startsWith("link 'hand': package://shaped/missing.stl: not found"), lines[0]);
  await close();
});

test("pages stay below three megabytes", () => {
  for (const name of ["shaped", "chaser-7dof", "table1-relaxed"]) {
    const { size } = statSync(join(process.env.FFSM_PAGES, name, "report.html"));
    assert.ok(size < 3e6, `${name}: ${size} bytes`);
  }
});
