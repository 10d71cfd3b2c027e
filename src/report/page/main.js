// What the page has is brought to life.
(() => {
  const data = (name) => JSON.parse(document.getElementById(name)?.textContent ?? "null");
  const [scene, numbers] = [data("scene"), data("numbers")];
  const isMoving = Boolean(scene?.motions.length);
  const clock = makeClock(scene?.duration || 1);
  const section = document.getElementById("playback");
  if (isMoving) {
    section.hidden = false;
    makePlayback(section, scene, clock);
  }
  if (numbers) makeCharts(document.getElementById("charts"), numbers, clock);
  if (!isMoving) return;
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) clock.seek(1);
  else clock.play(true);
})();
