// The pictures of the motions with their controls.

function makePlayback(section, scene, clock) {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const find = (name) => section.querySelector(name);
  const [button, slider, time, speeds] = ["button", "input", "output", "select"].map((name) => find(`.controls ${name}`));
  const shown = new Set();
  let stages = [];
  const camera = makeCamera(scene.planar, () => stages.forEach(draw));
  const paint = makePainter(scene, camera);
  const others = [...scene.motions.slice(1), ...scene.ghosts];

  const element = (name, properties, ...children) => {
    const made = Object.assign(document.createElement(name), properties);
    made.append(...children);
    return made;
  };

  stages = scene.motions.map((motion, number) => {
    const canvas = element("canvas", { tabIndex: 0 });
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `The robot's motion, ${motion.title}`);
    canvas.setAttribute("aria-describedby", "keys");
    const figures = element("output", {});
    const caption = element("figcaption", {}, element("strong", { textContent: motion.title }), figures);
    find(".stages").append(element("figure", { className: "stage" }, canvas, caption));
    handle(canvas, camera);
    return { motion, canvas, figures, isFirst: number === 0 };
  });

  function draw(stage) {
    const { motion, canvas, isFirst } = stage;
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    const pixels = [width, height].map((length) => Math.round(length * ratio));
    if (canvas.width !== pixels[0] || canvas.height !== pixels[1]) [canvas.width, canvas.height] = pixels;
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    const ghosts = others.map((one, index) => ({ one, number: index })).filter(({ number }) => isFirst && shown.has(number));
    paint(pen, [width, height], motion, clock.part, { colours: dark.matches ? ON_BLACK : ON_WHITE, ghosts, marks: isFirst });
    stage.figures.textContent = figuresOf(motion, clock.part);
  }

  // As many decimals as the largest value needs.
  const decimals = (values, least) => {
    const largest = Math.max(...values.map(Math.abs));
    return largest > 0 ? Math.min(20, Math.max(least, 1 - Math.floor(Math.log10(largest)))) : least;
  };
  const number = (value, digits) => (Object.is(+value.toFixed(digits), -0) ? 0 : value).toFixed(digits).replace("-", "−");
  function figuresOf(motion, part) {
    const now = (values, least) => number(between(values, part * (values.length - 1)), decimals(values, least));
    return `base turned ${now(motion.turned, 1)}°, shifted ${now(motion.shifted, 2)} cm`;
  }

  // As fast as it takes to see the whole in some eight seconds, real time among the choices.
  const pace = Math.max(1, 2 ** Math.round(Math.log2(clock.duration / 8)));
  for (const speed of [...new Set([0.25, 0.5, 1, 2, 4, 8, pace])].sort((a, b) => a - b)) {
    const option = new Option(speed === 1 ? "real time" : `${speed} ×`, speed);
    option.selected = speed === pace;
    speeds.add(option);
  }
  clock.speed = pace;
  speeds.addEventListener("change", () => { clock.speed = Number(speeds.value); });
  button.addEventListener("click", () => clock.play(!clock.playing));
  slider.addEventListener("input", () => clock.seek(Number(slider.value)));
  document.addEventListener("keydown", (event) => {
    if (event.key !== " " || event.target.closest("button, input, select, summary, a, [contenteditable]")) return;
    event.preventDefault();
    clock.play(!clock.playing);
  });

  const views = scene.planar ? [["home", "home"]]
    : [["home", "home"], ["front", "front"], ["side", "side"], ["top", "top"]];
  for (const [view, label] of views)
    find(".views").append(element("button", { type: "button", textContent: label, onclick: () => camera.see(view) }));
  for (const [label, name, factor] of [["−", "Zoom out", 1 / ZOOM.step], ["+", "Zoom in", ZOOM.step]]) {
    const made = element("button", { type: "button", textContent: label, onclick: () => camera.scale(factor) });
    made.setAttribute("aria-label", name);
    find(".views").append(made);
  }
  others.forEach((one, index) => {
    const box = element("input", { type: "checkbox", onchange: () => {
      if (box.checked) shown.add(index); else shown.delete(index);
      stages.forEach(draw);
    } });
    find(".ghosts").append(element("label", { className: `ghost ghost-${index % 2}` }, box, ` ${one.title}`));
  });
  if (!others.length) find(".ghosts").remove();

  clock.listen(() => {
    slider.value = clock.part;
    time.textContent = `${(clock.part * clock.duration).toFixed(2)} s`;
    button.textContent = clock.playing ? "❚❚" : "▶";
    stages.forEach(draw);
  });
  window.addEventListener("resize", () => stages.forEach(draw));
  dark.addEventListener("change", () => stages.forEach(draw));

  // Six moments for paper, which nothing moves on.
  window.addEventListener("beforeprint", () => {
    const frames = find(".frames");
    frames.replaceChildren();
    for (let k = 0; k < 6; k += 1) {
      const [width, height, ratio] = [320, 240, 2];
      const canvas = element("canvas", { width: ratio * width, height: ratio * height });
      const pen = canvas.getContext("2d");
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      paint(pen, [width, height], scene.motions[0], k / 5, { colours: ON_WHITE, marks: true });
      const caption = element("figcaption", { textContent: `${((k / 5) * clock.duration).toFixed(1)} s` });
      frames.append(element("figure", {}, canvas, caption));
    }
  });
}
