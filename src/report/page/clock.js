"use strict";

// The moment that pictures and charts show, as a part of the duration.
function makeClock(duration) {
  const listeners = [];
  const clock = { duration, part: 0, playing: false, speed: 1 };
  let last = null;
  const tell = () => listeners.forEach((listener) => listener(clock));
  const step = (now) => {
    if (!clock.playing) return;
    // A frame's time may lie before the call that asked for it: the first frame only sets the clock.
    clock.part += (Math.max(0, now - (last ?? now)) / 1000) * (clock.speed / duration);
    last = now;
    if (clock.part >= 1) {
      clock.part = 1;
      clock.playing = false;
    }
    tell();
    requestAnimationFrame(step);
  };
  clock.listen = (listener) => listeners.push(listener);
  clock.tell = tell;
  clock.play = (on) => {
    clock.playing = on;
    if (on && clock.part >= 1) clock.part = 0;
    last = null;
    tell();
    if (on) requestAnimationFrame(step);
  };
  clock.seek = (part) => {
    clock.playing = false;
    clock.part = Math.max(0, Math.min(1, part));
    tell();
  };
  return clock;
}
