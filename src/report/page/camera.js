// From where the pictures are seen, and how a hand changes that.

const QUARTER = Math.PI / 2;
// Where the eye is: turn about the vertical, height above the horizon.
const VIEWS = { front: { turn: 0, lift: 0 }, side: { turn: -QUARTER, lift: 0 }, top: { turn: -QUARTER, lift: QUARTER } };
const ZOOM = { least: 0.2, most: 40, step: 1.25 };

function makeCamera(planar, changed) {
  // The plane face on, or from a corner above.
  const home = planar ? VIEWS.top : { turn: -1.0, lift: 0.45 };
  // The pan is in parts of the scene's size, so that it is the same in pictures of any size.
  const camera = { ...home, zoom: 1, pan: [0, 0] };
  camera.see = (view) => {
    Object.assign(camera, { ...home, zoom: 1, pan: [0, 0] }, VIEWS[view]);
    changed();
  };
  camera.rotate = (turn, lift) => {
    camera.turn += turn;
    camera.lift = Math.max(-QUARTER, Math.min(QUARTER, camera.lift + lift));
    changed();
  };
  camera.move = (x, y) => {
    camera.pan = [camera.pan[0] + x, camera.pan[1] + y];
    changed();
  };
  camera.scale = (factor) => {
    const zoom = Math.max(ZOOM.least, Math.min(ZOOM.most, camera.zoom * factor));
    // What is in the middle of the picture stays there.
    camera.pan = camera.pan.map((value) => (value * zoom) / camera.zoom);
    camera.zoom = zoom;
    changed();
  };
  // Point `k` of a list of coordinates: to the right, upwards, towards the eye.
  camera.seen = (p, k) => {
    const [x, y, z] = [p[3 * k], p[3 * k + 1], p[3 * k + 2]];
    const [st, ct, sl, cl] = [Math.sin(camera.turn), Math.cos(camera.turn), Math.sin(camera.lift), Math.cos(camera.lift)];
    const near = ct * x + st * y;
    return [-st * x + ct * y, cl * z - sl * near, cl * near + sl * z];
  };
  return camera;
}

// Mouse, fingers, wheel and keys on a canvas.
function handle(canvas, camera) {
  const fingers = new Map();
  const apart = () => {
    const [a, b] = [...fingers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  const size = () => Math.min(canvas.clientWidth, canvas.clientHeight);
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  for (const name of ["pointerup", "pointercancel"])
    canvas.addEventListener(name, (event) => fingers.delete(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    const from = fingers.get(event.pointerId);
    if (!from) return;
    const to = { x: event.clientX, y: event.clientY };
    const [dx, dy] = [to.x - from.x, to.y - from.y];
    if (fingers.size === 2) {
      const before = apart();
      fingers.set(event.pointerId, to);
      camera.move(dx / 2 / size(), -dy / 2 / size());
      if (before > 0) camera.scale(apart() / before);
      return;
    }
    fingers.set(event.pointerId, to);
    if (event.shiftKey || event.buttons & 2) camera.move(dx / size(), -dy / size());
    else camera.rotate(-0.01 * dx, 0.01 * dy);
  });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    // Who scrolls down the page is not to be held up; a pinch on a trackpad comes with ctrlKey.
    if (document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    camera.scale(Math.exp(-0.0015 * event.deltaY));
  }, { passive: false });
  const turns = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
  const zooms = { "+": ZOOM.step, "=": ZOOM.step, "-": 1 / ZOOM.step, "−": 1 / ZOOM.step };
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const [turn, zoom] = [turns[event.key], zooms[event.key]];
    if (turn && event.shiftKey) camera.move(-0.5 * turn[0], 0.5 * turn[1]);
    else if (turn) camera.rotate(...turn);
    else if (zoom) camera.scale(zoom);
    else if (event.key === "Home") camera.see("home");
    else return;
    event.preventDefault();
  });
}
