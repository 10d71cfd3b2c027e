// What the robot's file draws of its bodies.

// The poses between two frames: origin and quaternion of each body.
function posesAt(motion, at) {
  const { poses } = motion;
  const k = Math.min(Math.floor(at), poses.length - 2), part = at - k;
  const mixed = poses[k].map((value, i) => value + part * (poses[k + 1][i] - value));
  return Array.from({ length: mixed.length / 7 }, (_, body) => {
    const [px, py, pz, x, y, z, w] = mixed.slice(7 * body, 7 * body + 7);
    const s = 2 / (x * x + y * y + z * z + w * w);
    return (points) => {
      const placed = new Array(points.length);
      for (let i = 0; i < points.length; i += 3) {
        const [a, b, c] = [points[i], points[i + 1], points[i + 2]];
        placed[i] = px + a * (1 - s * (y * y + z * z)) + b * s * (x * y - z * w) + c * s * (x * z + y * w);
        placed[i + 1] = py + a * s * (x * y + z * w) + b * (1 - s * (x * x + z * z)) + c * s * (y * z - x * w);
        placed[i + 2] = pz + a * s * (x * z - y * w) + b * s * (y * z + x * w) + c * (1 - s * (x * x + y * y));
      }
      return placed;
    };
  });
}

// The corners of the box that a solid lies in.
function cornersOf(solid) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  solid.points.forEach((value, i) => {
    low[i % 3] = Math.min(low[i % 3], value);
    high[i % 3] = Math.max(high[i % 3], value);
  });
  return [0, 1, 2, 3, 4, 5, 6, 7].flatMap((bits) => low.map((value, i) => ((bits >> i) & 1 ? high[i] : value)));
}

const LIGHT = [-0.35, -0.5, 0.79];

// A colour under the light: `part` of it falls on the face.
function lit(hex, part) {
  const channels = [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));
  return `rgb(${channels.map((value) => Math.round(value * (0.45 + 0.5 * part) + 40 * part)).join()})`;
}

// Faces to paint, each with its depth; `place` takes points to the picture, `scale` is its pixels a metre.
function facesOf(scene, motion, at, place, scale, pen, colours) {
  if (!scene.solids.length) return [];
  const poses = posesAt(motion, at);
  return scene.solids.flatMap((solid) => {
    const points = place(poses[solid.body](solid.points));
    const colour = solid.colour ?? (solid.of_base ? colours.base : colours.link);
    return solid.faces.map((face) => {
      const [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = [0, 1, 2].map((k) => points[face[k]]);
      // Two corners of a face may be one.
      const [dx, dy, dz] = face.length > 3 ? points[face[3]] : [ax, ay, az];
      const u = [cx - ax, cy - ay, scale * (cz - az)];
      const v = face.length > 3 ? [dx - bx, dy - by, scale * (dz - bz)] : [bx - ax, by - ay, scale * (bz - az)];
      const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      const part = Math.abs(normal.reduce((sum, value, i) => sum + value * LIGHT[i], 0)) / (Math.hypot(...normal) || 1);
      const fill = lit(colour, part);
      return { depth: face.reduce((sum, k) => sum + points[k][2], 0) / face.length, paint: () => {
        pen.beginPath();
        face.forEach((k, i) => (i ? pen.lineTo(points[k][0], points[k][1]) : pen.moveTo(points[k][0], points[k][1])));
        pen.closePath();
        pen.fillStyle = fill;
        pen.fill();
        // Its own colour closes the gaps to its neighbours.
        pen.lineWidth = 0.8;
        pen.strokeStyle = solid.has_edges ? colours.edge : fill;
        pen.stroke();
      } };
    });
  });
}
