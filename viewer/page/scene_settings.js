"use strict";
// The page's state as keys of a scene, as for `culet render --set`, so that the command line draws
// the same picture.

function toml_text(text) { return JSON.stringify(text); }
function toml_number(value) { return String(Number(value.toPrecision(9))); }
function toml_list(list) { return "[" + list.map(toml_number).join(",") + "]"; }

// The crystal's axes for an optic axis (uniaxial; alpha of biaxial ones) that is tilted from z
// towards an azimuth, degrees.
function crystal_axes(tilt_deg, azimuth_deg) {
  const tilt = tilt_deg * Math.PI / 180, azimuth = azimuth_deg * Math.PI / 180;
  const turn = Turn.after(Turn.about([0, 0, 1], azimuth), Turn.about([0, 1, 0], tilt));
  return [[0, 0, 1], [1, 0, 0], [0, 1, 0]].map((axis) => Turn.of(turn, axis));
}

// Share of the mean radiance: below it, a diamond's picture takes minutes for what no screen shows.
const k_fine_tolerance = 0.05;

// One: the sodium line, at which gems are measured. Three: where the eye's three colours are
// separated best; an ASET picture of a diamond is then five times nearer to that of 15 wavelengths
// than with three evenly spread. More: evenly over the visible range, with the ends of the
// program's own choice (docs/rendering.md).
function wavelengths_nm(count) {
  if (count === 1) return [589.3];
  if (count === 3) return [450, 540, 610];
  return Array.from({length: count}, (_, i) => 410 + 280 * i / (count - 1));
}

// `panorama`: the engine's setting for the dropped file.
function light_settings(values, panorama) {
  if (values.polariser !== null) {
    const settings = [`light={preset="polariscope",polarizer=${toml_number(values.polariser)}}`];
    settings.push(`camera.analyzer=${
      toml_number(values.analyser === null ? values.polariser + 90 : values.analyser)}`);
    return settings;
  }
  const settings = [];
  if (values.light === "panorama" && panorama)
    settings.push(panorama);
  else if (values.light && values.light !== "panorama")
    settings.push(`light={preset=${toml_text(values.light)}}`);
  if (values.analyser !== null) settings.push(`camera.analyzer=${toml_number(values.analyser)}`);
  return settings;
}

function stone_settings(values, optic) {
  const settings = [];
  if (values.material) settings.push(`material=${toml_text(values.material)}`);
  if (values.axis && optic === "uniaxial") {
    settings.push(`optic_axis=${toml_list(crystal_axes(...values.axis)[0])}`);
  }
  if (values.axis && optic === "biaxial") {
    settings.push(`principal_axes=[${crystal_axes(...values.axis).map(toml_list).join(",")}]`);
  }
  if (values.colour !== 1) settings.push(`absorption_scale=${toml_number(values.colour)}`);
  return settings;
}

// `values` of the state; `optic` of the shown material: isotropic, uniaxial, biaxial.
function settings_of(values, optic, panorama = "") {
  const settings = [...stone_settings(values, optic), ...light_settings(values, panorama)];
  if (values.retarder !== null && (values.analyser !== null || values.polariser !== null)) {
    settings.push(`camera.retarder_nm=${toml_number(values.retarder)}`);
    settings.push(`camera.retarder_angle=${toml_number((values.polariser || 0) + 45)}`);
  }
  if (values.effects) {
    settings.push(values.effects.length
        ? `render.effects=[${values.effects.map(toml_text).join(",")}]`
        : `render.effects="none"`);
  }
  if (values.wavelengths)
    settings.push(`render.wavelengths=${toml_list(wavelengths_nm(values.wavelengths))}`);
  if (values.depth) settings.push(`render.depth=${values.depth}`);
  return settings;
}

// Quotes for a POSIX shell.
function quoted(text) {
  return /^[\w./=,:-]+$/.test(text) ? text : "'" + text.replace(/'/g, "'\\''") + "'";
}

// `drawing`: {command, settings, camera, size, exposure, tonemap, engine, lights_turned}; `command`
// ends with the file; `lights_turned` is a rotation of the lights in the stone's frame.
function command_line(drawing) {
  const settings = drawing.settings.slice();
  const camera = drawing.camera;
  settings.push(`camera.position=${toml_list(camera.position)}`,
    `camera.look_at=${toml_list(camera.look_at)}`, `camera.up=${toml_list(camera.up)}`,
    camera.width ? `camera.orthographic_width=${toml_number(camera.width)}`
                 : `camera.fov=${toml_number(camera.fov_deg)}`);
  if (drawing.lights_turned && Turn.apart(drawing.lights_turned, Turn.none) > 1e-6) {
    settings.push(`light.rotate=${toml_list(Turn.angles(drawing.lights_turned))}`);
  }
  const words = [
    "-o", "picture.png", "--size", drawing.size.join(","), "--engine", drawing.engine, "--check",
    "none"
  ];
  settings.push("film.ground=false");  // the page has its own
  for (const setting of settings) words.push("--set", setting);
  words.push("--exposure", toml_number(drawing.exposure));
  if (drawing.tonemap) words.push("--tonemap", drawing.tonemap);
  return drawing.command + " " + words.map(quoted).join(" ");
}

if (typeof module !== "undefined") {
  globalThis.Turn = require("./orientation.js").Turn;
  module.exports = {settings_of, command_line, crystal_axes, wavelengths_nm};
}
