"use strict";
(() => {
  const section = document.getElementById("playback");
  const scene = JSON.parse(document.getElementById("scene").textContent);
  if (!scene.motions.length) return;
  section.hidden = false;
  const [button, slider, clock, speeds] = [".controls button", ".controls input", ".controls output", ".controls select"]
    .map((name) => section.querySelector(name));
  const colours = { base: "#56b4e9", edge: "#1b1f24", link: "#0072b2", joint: "#e69f00", path: "#d55e00", start: "#8a949e", apart: "#cc79a7" };

  // A camera for all stages: the plane face on, or from a corner above.
  const camera = scene.planar ? { turn: -Math.PI / 2, lift: Math.PI / 2 } : { turn: -1.0, lift: 0.45 };
  const seen = (p, k) => {
    const [x, y, z] = [p[3 * k], p[3 * k + 1], p[3 * k + 2]];
    const [st, ct, sl, cl] = [Math.sin(camera.turn), Math.cos(camera.turn), Math.sin(camera.lift), Math.cos(camera.lift)];
    const near = ct * x + st * y;
    return [-st * x + ct * y, cl * z - sl * near, cl * near + sl * z];
  };

  // All motions in one scale, about the middle of all points; in space whatever the view.
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const motion of scene.motions) for (const frame of motion.frames) frame.forEach((value, i) => {
    low[i % 3] = Math.min(low[i % 3], value);
    high[i % 3] = Math.max(high[i % 3], value);
  });
  const middle = low.map((value, i) => (value + high[i]) / 2);
  let reach = 0;
  for (const motion of scene.motions) for (const frame of motion.frames)
    for (let k = 0; k < frame.length; k += 3)
      reach = Math.max(reach, Math.hypot(...middle.map((value, i) => frame[k + i] - value)));
  const size = scene.planar ? [high[0] - low[0], high[1] - low[1]] : [2 * reach, 2 * reach];

  const stages = scene.motions.map((motion) => {
    const figure = document.createElement("figure");
    figure.className = "stage";
    const canvas = document.createElement("canvas");
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `The robot's motion, ${motion.title}`);
    const caption = document.createElement("figcaption");
    const title = document.createElement("strong");
    const figures = document.createElement("output");
    title.textContent = motion.title;
    caption.append(title, figures);
    figure.append(canvas, caption);
    section.querySelector(".stages").append(figure);
    return { motion, canvas, figures };
  });
  const cursors = [...document.querySelectorAll(".chart[data-frame]")].map((chart) => {
    const [left, top, width, height, from, to] = chart.dataset.frame.split(" ").map(Number);
    const line = document.createElement("i");
    line.style.top = `${100 * top}%`;
    line.style.height = `${100 * height}%`;
    chart.append(line);
    return { line, left, width, from, to };
  });

  const between = (rows, at) => {
    const k = Math.min(Math.floor(at), rows.length - 2), part = at - k;
    const mix = (a, b) => a + part * (b - a);
    return Array.isArray(rows[k]) ? rows[k].map((a, i) => mix(a, rows[k + 1][i])) : mix(rows[k], rows[k + 1]);
  };

  function draw(stage, at) {
    const { motion, canvas } = stage;
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (canvas.width !== Math.round(width * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.lineCap = pen.lineJoin = "round";
    const scale = 0.88 * Math.min(width / size[0], height / size[1]);
    const centre = seen(middle, 0);
    const place = (frame) => Array.from({ length: frame.length / 3 }, (_, k) => {
      const [x, y, depth] = seen(frame, k);
      return [width / 2 + scale * (x - centre[0]), height / 2 - scale * (y - centre[1]), depth];
    });
    const stroke = (points, colour, thick, dashes = []) => {
      pen.setLineDash(dashes);
      pen.strokeStyle = colour;
      pen.lineWidth = thick;
      pen.beginPath();
      points.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
      pen.stroke();
      pen.setLineDash([]);
    };
    const frame = place(between(motion.frames, at));
    const start = place(motion.frames[0]);
    const edges = scene.box_edges;
    const until = Math.floor(at);
    for (const tip of scene.tips) {
      const path = motion.frames.slice(0, until + 1).map((row) => place(row.slice(3 * tip, 3 * tip + 3))[0]);
      stroke([...path, frame[tip]], colours.path, 1);
    }
    for (const [a, b] of edges) stroke([start[a], start[b]], colours.start, 1, [4, 4]);

    for (const [a, b] of scene.boxes) stroke([frame[a], frame[b]], colours.apart, 1, [2, 3]);
    for (const [[a, b], radius] of scene.swept_spheres) {
      const [[ax, ay], [bx, by]] = [frame[a], frame[b]];
      const axis = Math.atan2(by - ay, bx - ax);
      pen.setLineDash([2, 3]);
      pen.strokeStyle = colours.apart;
      pen.lineWidth = 1;
      pen.beginPath();
      pen.arc(ax, ay, scale * radius, axis + Math.PI / 2, axis + 1.5 * Math.PI);
      pen.arc(bx, by, scale * radius, axis - Math.PI / 2, axis + Math.PI / 2);
      pen.closePath();
      pen.stroke();
      pen.setLineDash([]);
    }

    // The far before the near.
    const corners = scene.planar ? 4 : 8;
    const faces = scene.planar ? [[0, 1, 2, 3]]
      : [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    const depth = (points) => points.reduce((sum, k) => sum + frame[k][2], 0) / points.length;
    const items = faces.map((face) => ({ depth: depth(face), paint: () => {
      pen.beginPath();
      face.forEach((k, i) => (i ? pen.lineTo(frame[k][0], frame[k][1]) : pen.moveTo(frame[k][0], frame[k][1])));
      pen.closePath();
      pen.globalAlpha = 0.55;
      pen.fillStyle = colours.base;
      pen.fill();
      pen.globalAlpha = 1;
      stroke([...face, face[0]].map((k) => frame[k]), colours.edge, 1);
    } }));
    for (const link of scene.links) {
      const fromBase = link[0] === corners;
      const [colour, thick] = fromBase ? [colours.edge, 1.5] : [colours.link, 5];
      items.push({ depth: depth(link), paint: () => stroke(link.map((k) => frame[k]), colour, thick) });
    }
    for (const k of scene.joints) items.push({ depth: frame[k][2] + 1e-6 * size[0], paint: () => {
      pen.beginPath();
      pen.arc(frame[k][0], frame[k][1], 4.5, 0, 2 * Math.PI);
      pen.fillStyle = colours.joint;
      pen.fill();
      pen.lineWidth = 1;
      pen.strokeStyle = colours.edge;
      pen.stroke();
    } });
    if (!scene.planar) items.sort((a, b) => a.depth - b.depth);
    items.forEach((item) => item.paint());
    const number = (value, digits) => (Object.is(+value.toFixed(digits), -0) ? 0 : value).toFixed(digits).replace("-", "−");
    // As many decimals as the largest value needs.
    const decimals = (values, least) => {
      const largest = Math.max(...values.map(Math.abs));
      return largest > 0 ? Math.min(20, Math.max(least, 1 - Math.floor(Math.log10(largest)))) : least;
    };
    const now = (values, least) => number(between(values, at), decimals(values, least));
    stage.figures.textContent =
      `base turned ${now(motion.turned, 1)}°, shifted ${now(motion.shifted, 2)} cm`;
  }

  let part = 0, playing = false, last = null;
  function show() {
    const time = part * scene.duration;
    slider.value = part;
    clock.textContent = `${time.toFixed(2)} s`;
    for (const stage of stages) draw(stage, part * (stage.motion.frames.length - 1));
    for (const { line, left, width, from, to } of cursors)
      line.style.left = `${100 * (left + (width * (time - from)) / (to - from))}%`;
  }
  function step(now) {
    if (!playing) return;
    // A frame's time may lie before the call that asked for it: the first frame only sets the clock.
    part += (Math.max(0, now - (last ?? now)) / 1000) * (Number(speeds.value) / scene.duration);
    last = now;
    if (part >= 1) { part = 1; play(false); }
    show();
    requestAnimationFrame(step);
  }
  function play(on) {
    playing = on;
    button.textContent = on ? "❚❚" : "▶";
    if (!on) return;
    if (part >= 1) part = 0;
    last = null;
    requestAnimationFrame(step);
  }

  // As fast as it takes to see the whole in some eight seconds, real time among the choices.
  const pace = Math.max(1, 2 ** Math.round(Math.log2(scene.duration / 8)));
  for (const speed of [...new Set([0.25, 0.5, 1, 2, 4, 8, pace])].sort((a, b) => a - b)) {
    const option = new Option(speed === 1 ? "real time" : `${speed} ×`, speed);
    option.selected = speed === pace;
    speeds.add(option);
  }
  button.addEventListener("click", () => play(!playing));
  slider.addEventListener("input", () => { play(false); part = Number(slider.value); show(); });
  document.addEventListener("keydown", (event) => {
    if (event.key !== " " || event.target.closest("button, input, select, summary, a")) return;
    event.preventDefault();
    play(!playing);
  });
  for (const { canvas } of stages) {
    canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      if (!event.buttons) return;
      camera.turn -= 0.01 * event.movementX;
      camera.lift = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, camera.lift + 0.01 * event.movementY));
      if (!playing) show();
    });
  }
  window.addEventListener("resize", show);
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) { part = 1; show(); }
  else { show(); play(true); }
})();
