"use strict";
// Stands in for the engine where the page alone is tested: answers every call by the protocol, and
// draws a convex stone whose facets are plainly shaded, so that whatever a call says changes the
// picture.
let stones = [], shown = 0, settings = [], with_gpu = false;

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross =
  (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const unit = (a) => {
  const l = Math.hypot(...a);
  return a.map((v) => v / l);
};
const times =
  (m, v) => [0, 1, 2].map((r) => m[3 * r] * v[0] + m[3 * r + 1] * v[1] + m[3 * r + 2] * v[2]);

// A number from 0 to 1 that the text decides.
function number_of(text) {
  let hash = 2166136261;
  for (const c of text) hash = Math.imul(hash ^ c.codePointAt(0), 16777619);
  return (hash >>> 0) / 4294967296;
}

function draw({camera, turn, width, height, engine, exposure, tonemap}) {
  const begin = performance.now(), pixels = new Uint8ClampedArray(4 * width * height);
  const back = unit(minus(camera.position, camera.look_at)), right = unit(cross(camera.up, back)),
        up = cross(back, right);
  const scale = width / (camera.width || 8),
        tint = number_of(settings.join(";") + tonemap + engine);
  const bright = exposure === "auto" ? 1 : exposure;
  for (let i = 0; i < pixels.length; i += 4) pixels.set([14, 16, 18, 255], i);
  const stone = stones[shown];
  for (const facet of stone.facets) {
    if (dot(facet.normal, back) <= 0) continue;
    const points = facet.corners.map((c) => {
      const v = minus(Array.isArray(c) ? c : stone.vertices[c], camera.look_at);
      return [width / 2 + scale * dot(v, right), height / 2 - scale * dot(v, up)];
    });
    const light =
      times([turn[0], turn[3], turn[6], turn[1], turn[4], turn[7], turn[2], turn[5], turn[8]],
        facet.normal);
    const shade =
      bright * (60 + 90 * Math.max(0, light[2]) + 60 * light[0] + 40 * number_of(facet.name));
    const colour = [shade * (0.6 + 0.4 * tint), shade, shade * (1.2 - 0.5 * tint), 255];
    const xs = points.map((p) => p[0]), ys = points.map((p) => p[1]);
    const turns = Math.sign(points.reduce((sum, [x, y], i) => {
      const [nx, ny] = points[(i + 1) % points.length];
      return sum + x * ny - nx * y;
    }, 0));
    for (let y = Math.max(0, Math.floor(Math.min(...ys)));
         y < Math.min(height, Math.ceil(Math.max(...ys))); ++y) {
      for (let x = Math.max(0, Math.floor(Math.min(...xs)));
           x < Math.min(width, Math.ceil(Math.max(...xs))); ++x) {
        const inside = points.every(([ax, ay], i) => {
          const [bx, by] = points[(i + 1) % points.length];
          return turns * ((bx - ax) * (y + 0.5 - ay) - (by - ay) * (x + 0.5 - ax)) >= 0;
        });
        if (inside) pixels.set(colour, 4 * (y * width + x));
      }
    }
  }
  return {
    width,
    height,
    pixels,
    exposure: bright,
    milliseconds: performance.now() - begin,
    beams: stone.facets.length,
    remainder: 0
  };
}

// A kernel of that interface (render/gpu/gpu_program.h): a ball that the light's turn shades, one
// half of it in each of two passes, so that both must have been summed.
const gpu_program = {
  vertex:
    "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }",
  kernel: `precision highp float; precision highp sampler2D;
    uniform sampler2D u_sum; uniform sampler2D u_table; uniform float u_keep; uniform float u_half; uniform vec2 u_size;
    uniform mat3 u_light_turn; uniform int u_shift[2]; out vec4 out_sum;
    void main() {
      vec2 p = 2.0 * gl_FragCoord.xy / u_size - 1.0;
      float z = 1.0 - dot(p, p);
      vec3 n = vec3(p, sqrt(max(0.0, z)));
      float lit = z > 0.0 && p.x * u_half > 0.0 ? 0.5 + 0.5 * (u_light_turn * n).x : 0.0;
      vec4 own = vec4(lit * texelFetch(u_table, ivec2(u_shift[1], 0), 0).rgb, 1.0);
      out_sum = own + u_keep * texelFetch(u_sum, ivec2(gl_FragCoord.xy), 0);
    }`,
  display: `precision highp float; precision highp sampler2D;
    uniform sampler2D u_sum; uniform float u_exposure; uniform int u_tone_map; out vec4 colour;
    void main() { vec3 v = u_exposure * texelFetch(u_sum, ivec2(gl_FragCoord.xy), 0).rgb;
      colour = vec4(u_tone_map == 1 ? v / (1.0 + v) : v, 1.0); }`,
};
function gpu({width, height, turn, samples}) {
  const one = (name, components, values, whole = false) => ({name, components, whole, values});
  return {
    ...gpu_program,
    key: "the only one",
    uniforms: [
      one("u_light_turn", 9,
        [turn[0], turn[3], turn[6], turn[1], turn[4], turn[7], turn[2], turn[5], turn[8]]),
      one("u_shift", 1, [0, 1], true)
    ],
    passes: [{uniforms: [one("u_half", 1, [-1])]}, {uniforms: [one("u_half", 1, [1])]}],
    textures:
      [{name: "u_table", unit: 3, width: 2, height: 1, values: [0, 0, 0, 1, 0.2, 0.4, 0.8, 1]}],
    samples: Array.from({length: samples}, () => [one("u_size", 2, [width, height])]),
  };
}

const dimensions = {length: 6, width: 5, depth: 3};
const calls = {
  gpu,
  start: () => ({}),
  open({ document, item }) {
    with_gpu = document.title === "with a GPU";
    stones = document.items[item].stones.slice();
    shown = 0;
    return {
      stones: stones.map(({ role, name, facets }) => ({ role, name, facets: facets.map((f) => f.name), dimensions })),
      materials: [
        { name: "diamond", optic: "isotropic", index: 2.417, summary: "colourless" },
        { name: "tanzanite", optic: "biaxial", index: 1.692, summary: "violetish blue" },
        { name: "sapphire_blue", title: "Blue sapphire", optic: "uniaxial", index: 1.766, summary: "blue", colour: "#224387", density_g_cm3: 4 }],
      lights: [
        { name: "jeweller", summary: "a ring of light, two windows, a dim room", from_below: false, instrument: false },
        { name: "daylight", summary: "an open sky, a hazy sun, dim ground", from_below: false, instrument: false },
        { name: "aset", summary: "red, green and blue by elevation (AGS)", from_below: false, instrument: true },
        { name: "hearts", summary: "a red reflector before the pavilion", from_below: true, instrument: true }],
      cuts: [{ name: "eight", summary: "a made-up cut", parameters: [{ name: "crown-angle", value: 34, least: 20, most: 50, unit: "deg", what: "of the crown" }] }],
      camera: { position: [0, 0, 40], look_at: [0, 0, 0], up: [0, 1, 0], width: 8, size: [800, 800] },
      stone: stones.length - 1, settings: { light_preset: "jeweller", tonemap: "none" }, version: "stand-in",
    };
  },
  set(call) {
    shown = call.stone;
    settings = call.settings;
    if (settings.some((s) => s.includes("refuse"))) throw new Error("a line for people");
    return { wavelengths: 3, effects: [{ name: "dispersion", on: true, why: "the index changes" }, { name: "absorption", on: false, why: "it is clear" }], notes: [], refused: "", engine: stones[shown].convex === false ? "reference" : "beams", gpu_refused: with_gpu ? "" : "a stand-in has none" };
  },
  draw,
  path: ({ x }) => x < 5 ? { paths: [] } : { paths: [
    { facets: ["T", "P1", "P5", "C3"], weight: 0.62, light: "a ring of light" }, { facets: ["T"], weight: 0.17, light: "the room" }] },
  cut({ kind, values }) {
    const made = JSON.parse(JSON.stringify(stones[0]));
    const factor = values["crown-angle"] / 34;
    for (const vertex of made.vertices) if (vertex[2] > 0.2) vertex[2] *= factor;
    const place = stones.findIndex((s) => s.role === "design");
    stones[place < 0 ? stones.length : place] = { ...made, role: "design", cut: { kind, values } };
    return { stone: place < 0 ? stones.length - 1 : place, summary: { dimensions }, geometry: stones[place < 0 ? stones.length - 1 : place] };
  },
  stone({ name, material }) {
    if (/broken/.test(name)) throw new Error(name + ": ends in the middle of a facet");
    const own = { ...stones[0], name, cut: undefined, material: { id: material, name: material } };
    return { item: { name, stones: [own], scene: "", files: {}, picture: "", refused: "", command: `culet render '${name}' --material ${material}` } };
  },
  panorama: ({ name }) => {
    if (!/\.(hdr|exr|jpe?g|png)$/i.test(name)) throw new Error(name + " is no panorama");
    return { setting: `light={environment="${name}"}` };
  },
};

self.onmessage = ({data}) => {
  if (data.call === "die") {
    setTimeout(() => {
      throw new Error("told to");
    }, 0);
    return;
  }
  try {
    const answer = calls[data.call](data);
    self.postMessage(
      {...answer, id: data.id, ok: true}, answer.pixels ? [answer.pixels.buffer] : []);
  } catch (error) {
    self.postMessage({id: data.id, ok: false, error: error.message});
  }
};
