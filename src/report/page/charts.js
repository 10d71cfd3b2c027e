// What is read off the charts and done with them.

function makeCharts(section, numbers, clock) {
  const element = (name, properties, ...children) => {
    const made = Object.assign(document.createElement(name), properties);
    made.append(...children);
    return made;
  };
  const span = makeSpan(clock);
  const charts = [...section.querySelectorAll(".chart")].map((holder, k) => makeChart(holder, numbers.charts[k]));
  const options = element("div", { className: "controls options" });
  section.querySelector("h2").after(options);
  if (section.querySelector("[data-divisions]")) {
    const box = element("input", { type: "checkbox", onchange: () => section.classList.toggle("divided", box.checked) });
    options.append(element("label", {}, box, " mesh lines"));
  }
  if (section.querySelector("[data-over-time]")) {
    options.append(spanControls(span, clock));
    const hint = "Click to move the playback. Shift and drag to see a part of the time, in all charts; so do ctrl and the wheel. A double click shows the whole.";
    options.after(element("p", { className: "hint options", textContent: hint }));
  }

  function makeChart(holder, data) {
    const svg = holder.querySelector("svg");
    const frame = holder.dataset.frame.split(" ").map(Number);
    const [left, top, width, height] = frame;
    const isOverTime = "overTime" in holder.dataset;
    const hidden = new Set();
    const original = svg.cloneNode(false);
    const caption = holder.parentElement.querySelector("figcaption");
    const name = data.heading;

    // Entries of the legend as buttons, in words that wrap; the drawn legend is for downloads.
    const entries = [...svg.querySelectorAll("[data-entry]")];
    const legend = element("div", { className: "legend" });
    legend.setAttribute("role", "group");
    legend.setAttribute("aria-label", `Series of ${name}`);
    for (const entry of entries) {
      const sample = svg.cloneNode(false);
      const line = entry.querySelector("path, circle").getBBox();
      sample.setAttribute("viewBox", `${line.x} ${line.y + line.height / 2 - 4} 15 8`);
      sample.setAttribute("width", "22");
      sample.setAttribute("height", "12");
      sample.removeAttribute("role");
      sample.setAttribute("aria-hidden", "true");
      sample.append(...[...entry.children].filter((child) => child.tagName !== "text").map((child) => child.cloneNode(true)));
      const button = element("button", { type: "button" }, sample, entry.querySelector("text").textContent);
      button.setAttribute("aria-pressed", "true");
      button.addEventListener("click", () => {
        const number = Number(entry.dataset.entry), hide = !hidden.has(number);
        if (hide) hidden.add(number); else hidden.delete(number);
        button.setAttribute("aria-pressed", String(!hide));
        for (const part of svg.querySelectorAll(`[data-curve="${number}"], [data-entry="${number}"]`))
          if (hide) part.setAttribute("display", "none"); else part.removeAttribute("display");
        span.tell();
      });
      legend.append(button);
    }
    if (entries.length) holder.before(legend);

    const stretch = isOverTime ? makeStretch(svg, frame, new Set(data.curves.map((curve) => curve.entry)), hidden) : null;

    // Without the drawn legend the picture begins above its frame.
    const [, , wide, high] = svg.getAttribute("viewBox").split(" ").map(Number);
    const above = Math.max(0, top * high - 6), shown = high - above;
    svg.setAttribute("viewBox", `0 ${above} ${wide} ${shown}`);
    svg.setAttribute("height", `${shown}pt`);
    holder.classList.add("live");

    const line = (className) => {
      const made = element("i", { className });
      made.style.top = `${(100 * (top * high - above)) / shown}%`;
      made.style.height = `${(100 * height * high) / shown}%`;
      holder.append(made);
      return made;
    };
    const partOf = (time) => left + (width * (time - span.from)) / (span.to - span.from);
    const put = (made, time) => {
      made.style.left = `${100 * partOf(time)}%`;
      made.style.visibility = time < span.from || time > span.to ? "hidden" : "visible";
    };

    const save = (kind, type, contents) => {
      const button = element("button", { type: "button", textContent: kind.toUpperCase() });
      button.setAttribute("aria-label", `Download ${name} as ${kind.toUpperCase()}`);
      button.addEventListener("click", async () => download(`${slug(name)}.${kind}`, type, await contents()));
      return button;
    };
    const drawing = () => {
      const copy = svg.cloneNode(true);
      for (const { name: key, value } of original.attributes) copy.setAttribute(key, value);
      if (!section.classList.contains("divided"))
        copy.querySelectorAll("[data-divisions]").forEach((part) => part.remove());
      return new XMLSerializer().serializeToString(copy);
    };
    caption.append(element("span", { className: "tools" },
      save("svg", "image/svg+xml", drawing), save("png", "image/png", () => pixels(drawing())), save("csv", "text/csv", () => csv(data, numbers.x))));

    if (!isOverTime) return { now: () => {} };
    const present = line("now"), cursor = line("cursor"), chosen = line("chosen");
    chosen.hidden = true;
    const readout = element("div", { className: "readout" });
    readout.setAttribute("aria-hidden", "true");
    holder.append(readout);
    cursor.hidden = readout.hidden = true;
    const timeAt = (event) => {
      const box = holder.getBoundingClientRect();
      const part = ((event.clientX - box.left) / box.width - left) / width;
      return span.from + Math.max(0, Math.min(1, part)) * (span.to - span.from);
    };
    const show = (event) => {
      const time = timeAt(event);
      put(cursor, time);
      const rows = data.curves.filter((curve) => !hidden.has(curve.entry)).map((curve) => {
        const value = valueAt(numbers.x[curve.x], curve.y, time);
        if (value === undefined) return null;
        const dot = element("span", { className: "dot" });
        dot.style.background = curve.colour === "#000000" ? "var(--ink)" : curve.colour;
        return element("div", {}, dot, `${curve.name} `, element("b", { textContent: told(value, curve.y) }));
      });
      readout.replaceChildren(element("div", { textContent: `${told(time, [clock.duration])} s` }), ...rows.filter(Boolean));
      const part = partOf(time);
      // Beside the line, on the side where there is room.
      readout.style.left = part < 0.5 ? `${100 * part + 2}%` : "auto";
      readout.style.right = part < 0.5 ? "auto" : `${100 * (1 - part) + 2}%`;
      cursor.hidden = readout.hidden = false;
    };
    const seek = (event) => clock.seek(timeAt(event) / clock.duration);
    let first = null;
    holder.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      holder.setPointerCapture(event.pointerId);
      if (event.shiftKey) first = timeAt(event); else seek(event);
      show(event);
    });
    holder.addEventListener("pointermove", (event) => {
      if (first !== null) {
        const ends = [first, timeAt(event)].map(partOf).sort((a, b) => a - b);
        chosen.style.left = `${100 * ends[0]}%`;
        chosen.style.width = `${100 * (ends[1] - ends[0])}%`;
        chosen.hidden = false;
      } else if (holder.hasPointerCapture(event.pointerId)) seek(event);
      show(event);
    });
    for (const name of ["pointerup", "pointercancel"]) holder.addEventListener(name, (event) => {
      if (first !== null && name === "pointerup") span.show(first, timeAt(event));
      first = null;
      chosen.hidden = true;
    });
    holder.addEventListener("wheel", (event) => {
      // Who scrolls down the page is not to be held up; a pinch on a trackpad comes with ctrlKey.
      if (!event.ctrlKey) return;
      event.preventDefault();
      span.zoom(Math.exp(0.003 * event.deltaY), timeAt(event));
    }, { passive: false });
    holder.addEventListener("dblclick", () => span.whole());
    span.listen(() => stretch(span.from, span.to));
    holder.addEventListener("pointerleave", () => { cursor.hidden = readout.hidden = true; });
    return { now: (time) => put(present, time) };
  }

  const present = () => charts.forEach((chart) => chart.now(clock.part * clock.duration));
  clock.listen(present);
  span.listen(present);
}

// The value of a curve at x, undefined where it has none.
function valueAt(xs, ys, x) {
  if (!xs.length || x < xs[0] || x > xs[xs.length - 1]) return undefined;
  let low = 0, high = xs.length - 1;
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if (xs[middle] <= x) low = middle; else high = middle - 1;
  }
  if (low === xs.length - 1) return ys[low] ?? undefined;
  if (ys[low] === null || ys[low + 1] === null) return undefined;
  return ys[low] + ((x - xs[low]) / (xs[low + 1] - xs[low])) * (ys[low + 1] - ys[low]);
}

// Four digits; what is rounding beside the largest of all is zero.
function told(value, all) {
  const largest = all.reduce((most, one) => Math.max(most, Math.abs(one)), 0);
  const near = Math.abs(value) < 1e-6 * largest ? 0 : value;
  return String(Number(near.toPrecision(4))).replace("-", "−");
}
