"use strict";
// The page's state, its link, and the keys that it becomes. Expectations: what docs/rendering.md
// says of the keys, and that a link read again is the same state.
const assert = require("node:assert");
const fs = require("node:fs");
const path = require("node:path");
const test = require("node:test");
const page = path.join(__dirname, "../../viewer/page");
const {State, k_state_defaults} = require(path.join(page, "state.js"));
const {settings_of, command_line, crystal_axes} = require(path.join(page, "scene_settings.js"));
const {facet_colours, k_residual_stops, k_uncertainty_stops} =
  require(path.join(page, "facet_colours.js"));

const values = (changes) => ({...k_state_defaults, ...changes});

test("nothing chosen sets nothing",
  () => assert.deepStrictEqual(settings_of(values({}), "uniaxial"), []));

test("keys as the command line takes them", () => {
  assert.deepStrictEqual(
    settings_of(values({light: "aset", material: "sapphire_blue", colour: 2}), "uniaxial"),
    ['material="sapphire_blue"', "absorption_scale=2", 'light={preset="aset"}']);
  assert.deepStrictEqual(
    settings_of(values({polariser: 20, analyser: 110, retarder: 530}), "uniaxial"), [
      'light={preset="polariscope",polarizer=20}', "camera.analyzer=110", "camera.retarder_nm=530",
      "camera.retarder_angle=65"
    ]);
  assert.deepStrictEqual(settings_of(values({effects: [], depth: 8, wavelengths: 1}), "isotropic"),
    ['render.effects="none"', "render.wavelengths=[589.3]", "render.depth=8"]);
  assert.deepStrictEqual(
    settings_of(values({effects: ["dispersion", "absorption"], wavelengths: 3}), "isotropic"),
    ['render.effects=["dispersion","absorption"]', "render.wavelengths=[450,540,610]"]);
  assert.deepStrictEqual(
    settings_of(values({light: "panorama"}), "", 'light={environment="a.hdr"}'),
    ['light={environment="a.hdr"}']);
});

test("an optic axis by its two angles; only crystals have one", () => {
  // Tilted by 90 degrees towards azimuth 90 it is y.
  const along = crystal_axes(90, 90)[0];
  [0, 1, 0].forEach((v, i) => assert.ok(Math.abs(along[i] - v) < 1e-12));
  assert.match(
    settings_of(values({axis: [30, 0]}), "uniaxial")[0], /^optic_axis=\[0\.5,0,0\.8660254/);
  assert.match(settings_of(values({axis: [30, 0]}), "biaxial")[0], /^principal_axes=\[\[0\.5,0,/);
  assert.deepStrictEqual(settings_of(values({axis: [30, 0]}), "isotropic"), []);
  const [a, b, c] = crystal_axes(35, 110);
  for (const [u, v] of [[a, b], [b, c], [c, a]])
    assert.ok(Math.abs(u[0] * v[0] + u[1] * v[1] + u[2] * v[2]) < 1e-12);
});

test("the command is quoted for a shell", () => {
  const line = command_line({
    command: "culet render 'my stone.obj'",
    settings: ['light={preset="aset"}'],
    camera: {position: [0, 0, 40], look_at: [0, 0, 0], up: [0, 1, 0], width: 8},
    size: [640, 480],
    exposure: 1,
    tonemap: "filmic",
    engine: "beams",
    lights_turned: [0, 0, Math.SQRT1_2, Math.SQRT1_2],
  });
  assert.strictEqual(line,
    "culet render 'my stone.obj' -o picture.png --size 640,480 --engine beams --check none --set 'light={preset=\"aset\"}'" +
      " --set 'camera.position=[0,0,40]' --set 'camera.look_at=[0,0,0]' --set 'camera.up=[0,1,0]' --set camera.orthographic_width=8" +
      " --set 'light.rotate=[0,0,90]' --set film.ground=false --exposure 1 --tonemap filmic");
});

test("a link read again is the same state", () => {
  const one = new State(), two = new State();
  one.set({
    item: 2,
    stone: 0,
    turn: [0.5, -0.5, 0.5, 0.5],
    zoom: 1.25,
    pan: [0.125, -3],
    light: "hearts",
    lights_with: "stone",
    material: "ruby_gem",
    axis: [12, 340],
    colour: 0.5,
    polariser: 0,
    analyser: 90,
    effects: [],
    cut: {"crown-angle": 33.25},
    wire: true,
    exposure: 0.5,
    tonemap: "filmic",
    divider: 31,
    compare: "split"
  });
  two.restore("#" + one.fragment());
  assert.deepStrictEqual(two.values, one.values);
  assert.strictEqual(new State().fragment(), "");
});

test("a link from anybody does no harm", () => {
  const state = new State();
  state.restore(
    "#turn=1,2&zoom=1e99&light=%3Cimg%3E&__proto__=1&constructor=2&cut=<:1&effects=a;b&%E0%A4%A&exposure=-1&item=1.5&stone=-2&wavelengths=1e400");
  assert.deepStrictEqual(state.values, {...k_state_defaults, zoom: 50});
});

test("facets have the colours of the fit report's drawings", () => {
  const source = fs.readFileSync(path.join(__dirname, "../../page/colour_maps.cpp"), "utf8");
  const stops = (name) => source.match(new RegExp(name + "\\[\\] = \\{([^}]*)\\}"))[1]
                            .match(/0x[0-9a-f]{6}/g)
                            .map((c) => "#" + c.slice(2));
  assert.deepStrictEqual(k_residual_stops, stops("k_residual"));
  assert.deepStrictEqual(k_uncertainty_stops, stops("k_uncertainty"));
  const facets = [
    {fit: {residual: -4, readings: 1, suspect: true}}, {fit: {residual: 0, readings: 2}},
    {fit: null}
  ];
  const {facets: painted, legend} = facet_colours(facets, "residual");
  assert.deepStrictEqual(
    painted.map((f) => f.colour), ["rgb(189,0,38)", "rgb(255,255,204)", "#d9dde0"]);
  assert.ok(painted[0].marked && painted[0].text === "4.0" && legend.mark !== "");
});
