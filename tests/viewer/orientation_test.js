"use strict";
// The arithmetic of the viewer's hand. Expectations: rotation matrices by hand, and that a point of
// the stone stays under the pointer that drags it.
const assert = require("node:assert");
const test = require("node:test");
const {
  Turn,
  named_view,
  base_of,
  camera_of,
  projection_of,
  faces_eye,
  polygon_at,
} = require("../../viewer/page/orientation.js");

const near = (a, b, bound = 1e-12) =>
  a.forEach((v, i) => assert.ok(Math.abs(v - b[i]) <= bound, `${a} is not ${b}`));
const a_camera = {
  position: [0, 0, 40],
  look_at: [0, 0, 0],
  up: [0, 1, 0],
  width: 8,
  size: [400, 400]
};

test("a quarter turn about z takes x to y", () => {
  const q = Turn.about([0, 0, 1], Math.PI / 2);
  near(Turn.of(q, [1, 0, 0]), [0, 1, 0]);
  near(Turn.matrix(q), [0, -1, 0, 1, 0, 0, 0, 0, 1]);
});

test("turns go one after the other, and back", () => {
  const a = Turn.about([1, 2, 3], 0.7), b = Turn.about([-2, 1, 0.5], 2.1), v = [0.3, -1, 2];
  near(Turn.of(Turn.after(a, b), v), Turn.of(a, Turn.of(b, v)));
  near(Turn.back(a, Turn.of(a, v)), v);
});

test("the least turn between directions, opposite ones too", () => {
  for (const [a, b] of [[[1, 0, 0], [0, 1, 0]], [[0, 0, 1], [0, 0, -1]], [[1, 2, 2], [-2, 1, 2]]]) {
    near(Turn.of(Turn.between(a, b), Turn.unit(a)), Turn.unit(b));
  }
});

test("a frame is found again from its axes, half turns too", () => {
  for (const axis of [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, -2, 0.3]]) {
    for (const angle of [0, 0.4, 2.6, Math.PI]) {
      const q = Turn.about(axis, angle), m = Turn.matrix(q);
      const again = Turn.from_axes(m.slice(0, 3), m.slice(3, 6), m.slice(6, 9));
      assert.ok(Turn.apart(q, again) < 1e-7, `${axis} by ${angle}`);
    }
  }
});

test("three angles about x, y, z in that order are the same turn", () => {
  const q = Turn.about([0.2, -1, 0.4], 1.9);
  const [x, y, z] = Turn.angles(q).map((a) => a * Math.PI / 180);
  const again = Turn.after(
    Turn.about([0, 0, 1], z), Turn.after(Turn.about([0, 1, 0], y), Turn.about([1, 0, 0], x)));
  assert.ok(Turn.apart(q, again) < 1e-7);
});

test("a point of the stone stays under the pointer that drags it", () => {
  const base = base_of(a_camera, [0, 0, 0]), radius = 2;
  const view = {turn: Turn.about([1, 1, 0], 0.3), zoom: 1, pan: [0, 0]};
  const from = [0.2, 0.3], to = [-0.35, 0.5];
  // The point of the stone that lies on the ball under `from`.
  const point = Turn.back(view.turn, Turn.on_ball(...from).map((v) => radius * v));
  const turned = {...view, turn: Turn.after(Turn.drag(from, to), view.turn)};
  const scale = 400 / 8 * radius;
  near(projection_of(base, view, [0, 0, 0], 400, 400)(point),
    [200 + scale * from[0], 200 - scale * from[1]], 1e-9);
  near(projection_of(base, turned, [0, 0, 0], 400, 400)(point),
    [200 + scale * to[0], 200 - scale * to[1]], 1e-9);
});

test("a drag and its way back cancel, also beyond the ball", () => {
  const there = Turn.drag([0.1, 0.2], [3, -2]), back = Turn.drag([3, -2], [0.1, 0.2]);
  assert.ok(Turn.apart(Turn.after(back, there), Turn.none) < 1e-7);
});

test("the camera at home is the scene's, whatever the picture's shape", () => {
  const skew =
    {position: [10, -20, 30], look_at: [0.5, 0, 0.2], up: [0, 0, 1], fov_deg: 20, size: [600, 400]};
  const center = [0, 0.1, 0];
  const base = base_of(skew, center);
  const view = {turn: base.home, zoom: 1, pan: base.pan};
  const camera = camera_of(base, view, center, 600, 400);
  near(camera.position, skew.position, 1e-9);
  // The same line of sight, and the scene's angle about it.
  near(Turn.unit(Turn.add(camera.look_at, camera.position, -1)),
    Turn.unit(Turn.add(skew.look_at, skew.position, -1)), 1e-9);
  const sight = Turn.length(Turn.add(skew.look_at, skew.position, -1));
  assert.ok(Math.abs(camera.fov_deg - 20) < 1e-9 && sight > 0);
  // A tall picture shows the whole width: tan(angle / 2) grows by the ratio of the shapes.
  const tall = camera_of(base, view, center, 400, 800);
  const expected = 2 * Math.atan(Math.tan(Math.PI / 18) * 1.5 * 2) * 180 / Math.PI;
  assert.ok(Math.abs(tall.fov_deg - expected) < 1e-9);
});

test("zoom and pan of a parallel view", () => {
  const base = base_of(a_camera, [0, 0, 1]);
  const camera =
    camera_of(base, {turn: base.home, zoom: 2, pan: [0.5, -0.25]}, [0, 0, 1], 400, 400);
  assert.strictEqual(camera.width, 4);
  near(camera.look_at, [-0.5, 0.25, 1]);
  near(projection_of(base, {turn: base.home, zoom: 2, pan: [0.5, -0.25]}, [0, 0, 1], 400, 400)(
         [0, 0, 1]),
    [250, 225]);
});

test("views by name: table, pavilion and side", () => {
  const up = [0, 0, 1], ahead = [0, 1, 0];
  near(Turn.back(named_view("table", up, ahead), [0, 0, 1]), [0, 0, 1]);
  near(Turn.back(named_view("table", up, ahead), [0, 1, 0]), [0, 1, 0]);
  near(Turn.back(named_view("pavilion", up, ahead), [0, 0, 1]), [0, 0, -1]);
  near(Turn.back(named_view("side", up, ahead), [0, 1, 0]), [0, 0, 1]);
});

test("facets that face the eye, and the facet under a pixel", () => {
  const base = base_of(a_camera, [0, 0, 0]), view = {turn: base.home, zoom: 1, pan: [0, 0]};
  assert.ok(faces_eye(base, view, [0, 0, 0], [0, 0, 1], [0, 0, 1]));
  assert.ok(!faces_eye(base, view, [0, 0, 0], [0, 0, -1], [0, 0, -1]));
  const polygons = [[[0, 0], [10, 0], [10, 10], [0, 10]], [[10, 0], [20, 0], [20, 10], [10, 10]]];
  assert.strictEqual(polygon_at(polygons, 15, 5), 1);
  assert.strictEqual(polygon_at(polygons, 25, 5), -1);
});
