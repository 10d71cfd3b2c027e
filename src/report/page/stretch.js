// A chart drawn anew for a part of its time.

// Even steps of 1, 2 or 5, at most so many.
function ticksBetween(low, high, most) {
  const rough = (high - low) / most;
  const decade = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((digit) => digit * decade).find((one) => one >= rough * (1 - 1e-9));
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1)
    ticks.push([k * step, (k * step).toFixed(Math.min(20, decimals)).replace("-", "−")]);
  return ticks;
}

// A function of the times from and to which `svg` is to show. What is drawn for `entries` are curves, to
// which the heights are fitted; the rest are limits, seen where they are near.
function makeStretch(svg, [left, top, width, height, from, to, low, high], entries, hidden) {
  const [, , wide, high_] = svg.getAttribute("viewBox").split(" ").map(Number);
  const [x0, y0, w, h] = [left * wide, top * high_, width * wide, height * high_];
  const own = [...svg.querySelectorAll("[data-ticks]")];
  const numbersOf = (path) => path.getAttribute("d").slice(1).split("L").map((pair) => pair.split(" ").map(Number));
  const all = (part) => [...svg.querySelectorAll(`[${part}] path`)].map((path) => ({
    path, data: path.getAttribute("d"), points: numbersOf(path), entry: Number(path.parentElement.dataset.curve),
  }));
  const [curves, divisions] = [all("data-curve"), all("data-divisions")];
  const longest = Math.max(...own.flatMap((part) => [...part.querySelectorAll("text[text-anchor=end]")].map((text) => text.textContent.length)));
  let added = [];

  const make = (name, attributes, text = "") => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.textContent = text;
    return made;
  };
  const rule = (points, colour, thick) => make("path", {
    d: `M${points.map((point) => point.map((value) => value.toFixed(2)).join(" ")).join("L")}`, fill: "none", stroke: colour, "stroke-width": thick,
  });

  return (begin, end) => {
    for (const part of added) part.remove();
    added = [];
    const isWhole = end - begin >= (to - from) * (1 - 1e-9);
    for (const part of own) if (isWhole) part.removeAttribute("display"); else part.setAttribute("display", "none");
    if (isWhole) {
      for (const { path, data } of [...curves, ...divisions]) path.setAttribute("d", data);
      return;
    }
    const across = (to - from) / (end - begin), start = x0 + (w * (begin - from)) / (to - from);
    const x = (value) => x0 + across * (value - start);
    // Heights of what is seen, those at the sides included.
    let upper = Infinity, lower = -Infinity;
    const see = (value) => { [upper, lower] = [Math.min(upper, value), Math.max(lower, value)]; };
    for (const { points, entry } of curves) {
      if (!entries.has(entry) || hidden.has(entry)) continue;
      points.forEach(([px, py], k) => {
        const place = x(px);
        if (place >= x0 && place <= x0 + w) see(py);
        if (!k) return;
        const [before, beforeY] = points[k - 1], past = x(before);
        for (const side of [x0, x0 + w])
          if (past < side && place > side) see(beforeY + ((side - past) / (place - past)) * (py - beforeY));
      });
    }
    if (upper > lower) [upper, lower] = [y0, y0 + h];
    const tall = Math.max((lower - upper) * 1.12, h / 50), middle = (upper + lower) / 2;
    const y = (value) => y0 + (h * (value - middle + tall / 2)) / tall;
    for (const { path, points } of curves)
      path.setAttribute("d", `M${points.map(([px, py]) => {
        const [sx, sy] = [x(px), y(py)];
        return `${Math.max(-9e4, Math.min(9e4, sx)).toFixed(2)} ${Math.max(-9e4, Math.min(9e4, sy)).toFixed(2)}`;
      }).join("L")}`);
    for (const { path, points } of divisions)
      path.setAttribute("d", `M${points.map(([px, py]) => `${x(px).toFixed(2)} ${py}`).join("L")}`);

    const valueAt = (place) => high - ((place - y0) / h) * (high - low);
    const heightOf = (value) => y(y0 + (h * (high - value)) / (high - low));
    const [bottom, ceiling] = [middle + tall / 2, middle - tall / 2].map(valueAt);
    const grid = make("g", {}), marks = make("g", {});
    const ys = ticksBetween(bottom, ceiling, Math.max(2, Math.floor(h / 18)));
    // As small as it takes not to reach the label of the axis.
    const size = Math.max(4.5, Math.min(7, (7 * longest) / Math.max(...ys.map(([, label]) => label.length), 1)));
    for (const [value, label] of ys) {
      const at = heightOf(value);
      grid.append(rule([[x0, at], [x0 + w, at]], "#D8D8D8", 0.35));
      marks.append(rule([[x0, at], [x0 + 3, at]], "#000000", 0.6));
      marks.append(make("text", { x: x0 - 3, y: at + 0.36 * size, "font-size": size, "text-anchor": "end" }, label));
    }
    for (const [time, label] of ticksBetween(begin, end, Math.max(2, Math.floor(w / 32)))) {
      const at = x0 + (w * (time - begin)) / (end - begin);
      marks.append(rule([[at, y0 + h], [at, y0 + h - 3]], "#000000", 0.6));
      marks.append(make("text", { x: at, y: y0 + h + 9, "font-size": 7, "text-anchor": "middle" }, label));
    }
    own[0].parentElement.prepend(grid);
    svg.append(marks);
    added = [grid, marks];
  };
}
