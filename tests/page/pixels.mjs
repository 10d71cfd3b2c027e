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

/** Moves the playback to a part of the duration. */
export const seek = (page, part) => page.evaluate((value) => {
  const slider = document.querySelector("#playback .controls input");
  slider.value = value;
  slider.dispatchEvent(new Event("input"));
}, part);
