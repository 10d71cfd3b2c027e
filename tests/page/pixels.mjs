// Where the joints are drawn, found in the pixels of a canvas alone.

/** Centres of the discs of the joints' colour in the first picture, CSS pixels. */
export const discs = (page) => page.evaluate(() => {
  const canvas = document.querySelector(".stage canvas");
  const { width, height } = canvas;
  const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
  const isJoint = (at) => Math.abs(data[at] - 0xe6) < 12 && Math.abs(data[at + 1] - 0x9f) < 12 && data[at + 2] < 12;
  const seen = new Uint8Array(width * height);
  const found = [];
  for (let first = 0; first < seen.length; first += 1) {
    if (seen[first] || !isJoint(4 * first)) continue;
    // All pixels that hang together.
    const open = [first];
    let [count, x, y] = [0, 0, 0];
    seen[first] = 1;
    while (open.length) {
      const at = open.pop();
      [count, x, y] = [count + 1, x + (at % width) + 0.5, y + Math.floor(at / width) + 0.5];
      for (const next of [at - 1, at + 1, at - width, at + width]) {
        if (next < 0 || next >= seen.length || seen[next] || !isJoint(4 * next)) continue;
        seen[next] = 1;
        open.push(next);
      }
    }
    if (count > 20) found.push([x / count, y / count]);
  }
  const ratio = width / canvas.clientWidth;
  return found.map((point) => point.map((value) => value / ratio));
});

/** Parts of a ring of 7 pixels about a point, and of one of 3, that have the colour of goals. */
export const ring = (page, at) => page.evaluate(([x, y]) => {
  const canvas = document.querySelector(".stage canvas");
  const ratio = canvas.width / canvas.clientWidth;
  const pen = canvas.getContext("2d");
  const isGoal = (px, py) => {
    const { data } = pen.getImageData(Math.round(ratio * px) - 1, Math.round(ratio * py) - 1, 3, 3);
    const near = (k) => data[k + 3] > 120 && data[k] < 80 && data[k + 1] > 80 && data[k + 2] < 140;
    return [...Array(9).keys()].some((k) => near(4 * k));
  };
  const part = (radius) => {
    const angles = [...Array(24).keys()].map((k) => (k * Math.PI) / 12);
    return angles.filter((a) => isGoal(x + radius * Math.cos(a), y + radius * Math.sin(a))).length / 24;
  };
  return { circle: part(7), inside: part(3) };
}, at);

/** Moves the playback to a part of the duration. */
export const seek = (page, part) => page.evaluate((value) => {
  const slider = document.querySelector("#playback .controls input");
  slider.value = value;
  slider.dispatchEvent(new Event("input"));
}, part);
