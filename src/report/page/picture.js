// One picture of a motion at one moment, drawn on a canvas.

const ON_WHITE = {
  paper: "#ffffff", base: "#56b4e9", edge: "#1b1f24", link: "#0072b2", outline: "#003f8f", joint: "#e69f00", path: "#d55e00", start: "#8a949e",
  apart: "#cc79a7", mark: "#00704f", ghosts: ["#7a5195", "#8c6d1f"],
};
const ON_BLACK = {
  ...ON_WHITE, paper: "#14181d", edge: "#d6dce2", link: "#4ba6e0", outline: "#1d4f70", path: "#ff8a3c", start: "#78828c", mark: "#3fcf9f",
  ghosts: ["#c4a0dd", "#d9bd66"],
};

// The values between two rows.
function between(rows, at) {
  const k = Math.min(Math.floor(at), rows.length - 2), part = at - k;
  const mix = (a, b) => a + part * (b - a);
  return Array.isArray(rows[k]) ? rows[k].map((a, i) => mix(a, rows[k + 1][i])) : mix(rows[k], rows[k + 1]);
}

// All motions in one scale, about the middle of all points; in space whatever the view.
function extentOf(scene) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  const frames = [...scene.motions, ...scene.ghosts].flatMap((motion) => motion.frames);
  frames.push(...scene.marks.map((mark) => mark.at).filter(Boolean));
  const boxes = scene.solids.map((solid) => [solid.body, cornersOf(solid)]);
  if (boxes.length) for (const motion of scene.motions) motion.poses.forEach((_, k) => {
    const poses = posesAt(motion, k);
    frames.push(...boxes.map(([body, corners]) => poses[body](corners)));
  });
  for (const frame of frames) frame.forEach((value, i) => {
    low[i % 3] = Math.min(low[i % 3], value);
    high[i % 3] = Math.max(high[i % 3], value);
  });
  const middle = low.map((value, i) => (value + high[i]) / 2);
  let reach = 0;
  for (const frame of frames) for (let k = 0; k < frame.length; k += 3)
    reach = Math.max(reach, Math.hypot(...middle.map((value, i) => frame[k + i] - value)));
  return { middle, size: scene.planar ? [high[0] - low[0], high[1] - low[1]] : [2 * reach, 2 * reach] };
}

function makePainter(scene, camera) {
  const { middle, size } = extentOf(scene);
  const corners = scene.planar ? 4 : 8;
  const faces = scene.planar ? [[0, 1, 2, 3]]
    : [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];

  // `ghosts` are the motions to be drawn thinly as well, in the colours of their numbers.
  return function paint(pen, [width, height], motion, part, { colours, ghosts = [], marks = false }) {
    pen.clearRect(0, 0, width, height);
    pen.lineCap = pen.lineJoin = "round";
    const room = Math.min(width, height);
    const scale = 0.94 * camera.zoom * Math.min(width / size[0], height / size[1]);
    const centre = camera.seen(middle, 0);
    const place = (points) => Array.from({ length: points.length / 3 }, (_, k) => {
      const [x, y, depth] = camera.seen(points, k);
      return [
        width / 2 + room * camera.pan[0] + scale * (x - centre[0]),
        height / 2 - room * camera.pan[1] - scale * (y - centre[1]), depth,
      ];
    });
    const trace = (points) => {
      pen.beginPath();
      points.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
    };
    const stroke = (points, colour, thick, dashes = []) => {
      pen.setLineDash(dashes);
      pen.strokeStyle = colour;
      pen.lineWidth = thick;
      trace(points);
      pen.stroke();
      pen.setLineDash([]);
    };
    const frameOf = (one, where) => place(between(one.frames, where * (one.frames.length - 1)));
    const skeleton = (one, where, colour, dashes = []) => {
      const frame = frameOf(one, where);
      for (const [a, b] of scene.box_edges) stroke([frame[a], frame[b]], colour, 1, dashes);
      for (const [a, b] of scene.links) stroke([frame[a], frame[b]], colour, 2.5, dashes);
    };

    const frame = frameOf(motion, part);
    const start = place(motion.frames[0]);
    const until = Math.floor(part * (motion.frames.length - 1));
    for (const tip of scene.tips) {
      const path = motion.frames.slice(0, until + 1).map((row) => place(row.slice(3 * tip, 3 * tip + 3))[0]);
      stroke([...path, frame[tip]], colours.path, 1);
    }
    for (const [a, b] of scene.box_edges) stroke([start[a], start[b]], colours.start, 1, [4, 4]);
    if (marks) for (const mark of scene.marks) {
      pen.globalAlpha = 0.55;
      if (mark.of_joints) skeleton(motion, mark.part, colours.mark, [1, 4]);
      pen.globalAlpha = 1;
    }

    // The far before the near.
    const depth = (points) => points.reduce((sum, k) => sum + frame[k][2], 0) / points.length;
    const items = (scene.has_block ? faces : []).map((face) => ({ depth: depth(face), paint: () => {
      trace(face.map((k) => frame[k]));
      pen.closePath();
      pen.globalAlpha = 0.55;
      pen.fillStyle = colours.base;
      pen.fill();
      pen.globalAlpha = 1;
      stroke([...face, face[0]].map((k) => frame[k]), colours.edge, 1);
    } }));
    items.push(...facesOf(scene, motion, part * (motion.frames.length - 1), place, scale, pen, colours));
    // Seen along any line a capsule is a line with round ends.
    const capsule = Math.max(5, 2 * scale * scene.radius);
    scene.links.forEach((link, number) => {
      const ends = link.map((k) => frame[k]);
      if (scene.bare[number]) items.push({ depth: depth(link), paint: () => {
        stroke(ends, colours.outline, capsule + 1.5);
        stroke(ends, colours.link, capsule);
      } });
      else if (link[0] === corners && scene.has_block) items.push({ depth: depth(link), paint: () => stroke(ends, colours.edge, 1.5) });
    });
    // A joint is seen upon the capsules that meet there; in the plane whatever lies upon it.
    const jointDepth = (k) => (scene.planar ? Infinity : Math.max(frame[k][2], ...scene.links
      .filter((link, number) => scene.bare[number] && link.includes(k)).map(depth)) + 1e-6 * size[0]);
    for (const k of scene.joints) items.push({ depth: jointDepth(k), paint: () => {
      pen.beginPath();
      pen.arc(frame[k][0], frame[k][1], 4.5, 0, 2 * Math.PI);
      pen.fillStyle = colours.joint;
      pen.fill();
      pen.lineWidth = 1;
      pen.strokeStyle = colours.edge;
      pen.stroke();
    } });
    if (!scene.planar || scene.solids.length) items.sort((a, b) => (a.depth === b.depth ? 0 : a.depth - b.depth));
    items.forEach((item) => item.paint());

    // Upon the robot, which would hide them.
    // The second is dashed: they may lie upon each other.
    for (const { one, number } of ghosts)
      skeleton(one, part, colours.ghosts[number % colours.ghosts.length], number % 2 ? [6, 6] : []);
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

    if (marks) for (const mark of scene.marks) {
      const then = frameOf(motion, mark.part);
      // Without a position of its own it stands where the plan's arm ends then.
      const at = mark.at ? place(mark.at)[0] : then[scene.tips[0]];
      if (!at) continue;
      const foot = mark.at ?? between(motion.frames, mark.part * (motion.frames.length - 1)).slice(3 * scene.tips[0], 3 * scene.tips[0] + 3);
      const long = 0.09 * Math.max(...size);
      for (const axis of mark.axes) {
        const end = place(foot.map((value, i) => value + long * axis[i]))[0];
        stroke([at, end], colours.mark, 2);
      }
      pen.beginPath();
      pen.arc(at[0], at[1], Math.max(7, scale * mark.within), 0, 2 * Math.PI);
      pen.lineWidth = 1.5;
      pen.strokeStyle = colours.mark;
      pen.stroke();
      pen.fillStyle = colours.mark;
      pen.font = "12px system-ui, sans-serif";
      // Read upon the robot as well.
      pen.lineWidth = 3;
      pen.strokeStyle = colours.paper;
      pen.strokeText(mark.label, at[0] + 10, at[1] - 9);
      pen.fillText(mark.label, at[0] + 10, at[1] - 9);
    }
  };
}
