// The part of the time that the charts show.

function makeSpan(clock) {
  // Beyond that curves are drawn from too few points.
  const least = clock.duration / 50;
  const listeners = [];
  const span = { from: 0, to: clock.duration };
  span.listen = (listener) => listeners.push(listener);
  span.tell = () => listeners.forEach((listener) => listener());
  span.show = (one, other) => {
    const [from, to] = one < other ? [one, other] : [other, one];
    // A hand that only trembled chose nothing.
    if (to - from < 0.005 * (span.to - span.from)) return;
    const length = Math.max(least, Math.min(clock.duration, to - from));
    span.from = Math.max(0, Math.min(clock.duration - length, (from + to - length) / 2));
    span.to = span.from + length;
    span.tell();
  };
  // As much longer, what is at `about` staying where it is.
  span.zoom = (factor, about) => {
    const length = Math.max(least, Math.min(clock.duration, factor * (span.to - span.from)));
    const part = (about - span.from) / (span.to - span.from);
    span.show(about - part * length, about + (1 - part) * length);
  };
  span.whole = () => span.show(0, clock.duration);
  return span;
}

// Buttons for it, and what it is in words.
function spanControls(span, clock) {
  const group = document.createElement("span");
  group.className = "span";
  group.setAttribute("role", "group");
  group.setAttribute("aria-label", "Time shown");
  const output = document.createElement("output");
  const button = (text, label, act) => {
    const made = Object.assign(document.createElement("button"), { type: "button", textContent: text, onclick: act });
    made.setAttribute("aria-label", label);
    group.append(made);
    return made;
  };
  // About the moment of the playback, if it is to be seen.
  const middle = () => {
    const now = clock.part * clock.duration;
    return now >= span.from && now <= span.to ? now : (span.from + span.to) / 2;
  };
  button("−", "Show more time", () => span.zoom(2, middle()));
  button("+", "Show less time", () => span.zoom(0.5, middle()));
  const whole = button("all", "Show all of the time", () => span.whole());
  group.append(output);
  span.listen(() => {
    const [from, to] = [span.from, span.to].map((time) => time.toFixed(clock.duration < 10 ? 2 : 1));
    whole.disabled = span.to - span.from >= clock.duration;
    output.textContent = whole.disabled ? "" : `${from} to ${to} s`;
  });
  whole.disabled = true;
  return group;
}
