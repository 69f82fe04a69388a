"use strict";
// The stone's orientation before the eye: pure arithmetic, no page. Tested by
// tests/viewer/orientation_test.js.
//
// Frames: the stone's is the scene's (right-handed, z up through the table). The eye's has x to the
// right of the picture, y up, z towards the eye. A unit quaternion [x, y, z, w] is the rotation
// from the stone's frame to the eye's. Vectors are arrays of three numbers.

const Turn = {
  none: [0, 0, 0, 1],

  dot(a, b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; },
  cross(a, b) {
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  },
  add(a, b, factor = 1) {
    return [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]];
  },
  length(a) { return Math.hypot(...a); },
  unit(a) {
    const length = Math.hypot(...a);
    return length > 0 ? a.map((v) => v / length) : a.slice();
  },

  // First b, then a.
  after(a, b) {
    const [ax, ay, az, aw] = a, [bx, by, bz, bw] = b;
    return Turn.unit([
      aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
      aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz
    ]);
  },
  inverse(q) {
    return [-q[0], -q[1], -q[2], q[3]];
  },
  about(axis, angle) {
    const [x, y, z] = Turn.unit(axis), s = Math.sin(angle / 2);
    return [x * s, y * s, z * s, Math.cos(angle / 2)];
  },
  between(a, b) {
    const from = Turn.unit(a), to = Turn.unit(b), cosine = Turn.dot(from, to);
    if (cosine < -1 + 1e-12) {
      const other = Math.abs(from[0]) < 0.8 ? [1, 0, 0] : [0, 1, 0];
      return Turn.about(Turn.cross(from, other), Math.PI);
    }
    return Turn.unit([...Turn.cross(from, to), 1 + cosine]);
  },
  of(q, v) {
    const t = Turn.cross(q, v).map((c) => 2 * c);
    return Turn.add(Turn.add(v, t, q[3]), Turn.cross(q, t));
  },
  back(q, v) { return Turn.of(Turn.inverse(q), v); },
  // Nine numbers, row by row.
  matrix(q) {
    const columns = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => Turn.of(q, axis));
    return [0, 1, 2].flatMap((row) => columns.map((column) => column[row]));
  },
  // From the eye frame's axes in the stone's frame: right, up, towards the eye.
  from_axes(right, up, back) {
    const m = [right, up, back], trace = m[0][0] + m[1][1] + m[2][2];
    const q = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1], 1 + trace];
    if (trace > -0.5) return Turn.unit(q);
    // For half turns and nearly so: start from the largest diagonal element (Shepperd 1978).
    let i = 0;
    if (m[1][1] > m[0][0]) i = 1;
    if (m[2][2] > m[i][i]) i = 2;
    const j = (i + 1) % 3, k = (i + 2) % 3, p = [0, 0, 0, m[k][j] - m[j][k]];
    p[i] = 1 + m[i][i] - m[j][j] - m[k][k];
    p[j] = m[j][i] + m[i][j];
    p[k] = m[k][i] + m[i][k];
    return Turn.unit(p);
  },
  // The view with `back` towards the eye and, if possible, `up` upwards in the picture.
  facing(back, up) {
    const z = Turn.unit(back);
    let x = Turn.cross(up, z);
    if (Turn.length(x) < 1e-9) x = Turn.cross(Math.abs(z[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0], z);
    x = Turn.unit(x);
    return Turn.from_axes(x, Turn.cross(z, x), z);
  },
  // The angle between two rotations, radians.
  apart(a, b) {
    const q = Turn.after(a, Turn.inverse(b));
    return 2 * Math.atan2(Math.hypot(q[0], q[1], q[2]), Math.abs(q[3]));
  },
  // The same rotation as angles x, y, z in degrees about the axes in that order.
  angles(q) {
    const m = Turn.matrix(q), deg = 180 / Math.PI;
    const y = Math.asin(Math.max(-1, Math.min(1, -m[6])));
    if (Math.abs(m[6]) > 1 - 1e-12) return [deg * Math.atan2(-m[5], m[4]), deg * y, 0];
    return [deg * Math.atan2(m[7], m[8]), deg * y, deg * Math.atan2(m[3], m[0])];
  },

  // Maps a point of the picture to a ball around the stone; x and y in radii of the ball, y up.
  // Beyond the ball a hyperbola continues it smoothly (Bell 1988), so that a drag never sticks.
  on_ball(x, y) {
    const square = x * x + y * y;
    return [x, y, square <= 0.5 ? Math.sqrt(1 - square) : 0.5 / Math.sqrt(square)];
  },
  // Moves the ball's point under `from` to under `to`.
  drag(from, to) { return Turn.between(Turn.on_ball(...from), Turn.on_ball(...to)); },
};

// Named views: the direction of the stone that faces the eye, and the one that is up in the
// picture.
function named_view(name, up, home_up) {
  const side = Turn.unit(Turn.add(home_up, up, -Turn.dot(home_up, up)));
  if (name === "pavilion") return Turn.facing(up.map((v) => -v), side);
  if (name === "side") return Turn.facing(side.map((v) => -v), up);
  return Turn.facing(up, side);
}

// The scene's camera in the page's terms: how much of the stone it shows at the distance of the
// stone's middle, and the eye's distance from there. `camera` is as in the engine's `open`.
function base_of(camera, center) {
  const [pixels_x, pixels_y] = camera.size || [1, 1];
  const back = Turn.unit(Turn.add(camera.position, camera.look_at, -1));
  const home = Turn.facing(back, camera.up);
  const eye = Turn.of(home, Turn.add(camera.position, center, -1));
  const half_width = camera.width
    ? camera.width / 2
    : eye[2] * Math.tan(camera.fov_deg * Math.PI / 360) * pixels_x / pixels_y;
  return {
    home,
    center,
    orthographic: Boolean(camera.width),
    distance: eye[2],
    pan: [-eye[0], -eye[1]],
    half_width,
    half_height: half_width * pixels_y / pixels_x,
    free_height: 1,  // share of the picture's height that is not covered
  };
}

// Half the height of a picture of width x height pixels, in the stone's unit at the distance of the
// stone's middle.
function half_height_of(base, zoom, width, height) {
  return Math.max(base.half_height / base.free_height, base.half_width * height / width) / zoom;
}

// `view`: {turn, zoom, pan}; pan is the offset of the stone's middle from the picture's, in the
// stone's unit, to the right and up.
function camera_of(base, view, center, width, height) {
  const along = (v) => Turn.back(view.turn, v);
  const half = half_height_of(base, view.zoom, width, height);
  const at = Turn.add(center, along([-view.pan[0], -view.pan[1], 0]));
  const camera = {
    position: Turn.add(at, along([0, 0, base.distance])),
    look_at: at,
    up: along([0, 1, 0]),
  };
  if (base.orthographic)
    camera.width = 2 * half * width / height;
  else
    camera.fov_deg = 360 / Math.PI * Math.atan(half / base.distance);
  return camera;
}

// Maps points of the stone to pixels [x, y] (x to the right, y down).
function projection_of(base, view, center, width, height) {
  const scale = height / 2 / half_height_of(base, view.zoom, width, height);
  return (point) => {
    const v = Turn.of(view.turn, Turn.add(point, center, -1));
    v[0] += view.pan[0];
    v[1] += view.pan[1];
    const nearer = base.orthographic ? 1 : base.distance / (base.distance - v[2]);
    return [width / 2 + scale * nearer * v[0], height / 2 - scale * nearer * v[1]];
  };
}

// Needs the facet's outward normal and a point of it.
function faces_eye(base, view, center, normal, point) {
  const n = Turn.of(view.turn, normal);
  if (base.orthographic) return n[2] > 0;
  const v = Turn.of(view.turn, Turn.add(point, center, -1));
  return Turn.dot(n, [-view.pan[0] - v[0], -view.pan[1] - v[1], base.distance - v[2]]) > 0;
}

// Index of the convex polygon (points in pixels) that contains the point; -1: none.
function polygon_at(polygons, x, y) {
  return polygons.findIndex((points) => {
    let inside = false;
    for (let i = 0, j = points.length - 1; i < points.length; j = i++) {
      const [ax, ay] = points[i], [bx, by] = points[j];
      if ((ay > y) !== (by > y) && x < (bx - ax) * (y - ay) / (by - ay) + ax) inside = !inside;
    }
    return inside;
  });
}

if (typeof module !== "undefined") {
  module.exports = {
    Turn,
    named_view,
    base_of,
    half_height_of,
    camera_of,
    projection_of,
    faces_eye,
    polygon_at,
  };
}
