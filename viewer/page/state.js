"use strict";
// The page's state, as one plain object with listeners. A link's fragment holds what differs from
// the defaults, so that it also works with file://.

// The names are used in links; `null`: as in the file.
const k_state_defaults = {
  item: 0,      // in the gallery
  stone: null,  // index among the item's stones; null: the last, which is the fitted one
  turn: null,   // quaternion, from the stone's frame to the eye's; null: the light's own view
  zoom: 1,
  pan: null,                 // stone's unit, right and up; null: as the scene's camera
  light: null,               // name of a preset; "panorama": a dropped file
  light_turn: [0, 0, 0, 1],  // set by hand
  lights_with: "viewer",     // or "stone"
  material: null,
  axis: null,         // [tilt from up, azimuth] of the optic axis, degrees
  colour: 1,          // multiplies the material's absorption
  polariser: null,    // degrees; lights the stone from behind
  analyser: null,     // degrees in the picture
  retarder: null,     // nm, at 45 degrees to the polariser
  effects: null,      // list of names; null: all that can matter
  wavelengths: null,  // number of them
  depth: null,
  cut: null,       // {name: value} of the changed proportions
  compare: "one",  // blink, split
  divider: 50,     // per cent of the width
  facets: "none",  // residual, sigma
  wire: false,
  names: false,
  tilts: false,
  exposure: null,       // "auto" or a factor
  tonemap: null,        // none, reinhard, filmic, gamma2
  drawn_by: "fastest",  // beams, gpu
};

// How lists of texts and numbers are written in a link.
const k_state_coding = {
  lists: new Set(["turn", "pan", "light_turn", "axis"]),
  numbers: new Set([
    "item", "stone", "zoom", "colour", "polariser", "analyser", "retarder", "wavelengths", "depth",
    "divider"
  ]),
  whole: new Set(["item", "stone", "wavelengths", "depth"]),
  truths: new Set(["wire", "names", "tilts"]),
};

function written_number(value) { return String(Number(value.toPrecision(7))); }

function written_state(key, value) {
  if (k_state_coding.lists.has(key)) return value.map(written_number).join(",");
  if (key === "effects") return value.length ? value.join(",") : "none";
  if (key === "cut")
    return Object.entries(value).map(([k, v]) => k + ":" + written_number(v)).join(",");
  if (typeof value === "number") return written_number(value);
  return value === true ? "yes" : value === false ? "no" : value;
}

// Returns nothing for nonsense: a link may come from anybody.
function read_state(key, text) {
  const numbers = (parts) =>
    parts.every((p) => p !== "" && Number.isFinite(Number(p))) ? parts.map(Number) : undefined;
  if (k_state_coding.lists.has(key)) {
    const list = numbers(text.split(","));
    const count = key === "pan" || key === "axis" ? 2 : 4;
    if (!list || list.length !== count) return undefined;
    if (count === 4) return Math.hypot(...list) > 0.1 ? Turn.unit(list) : undefined;
    return list;
  }
  if (k_state_coding.numbers.has(key)) {
    const [value] = numbers([text]) || [];
    return k_state_coding.whole.has(key) && !(Number.isInteger(value) && value >= 0) ? undefined
                                                                                     : value;
  }
  if (k_state_coding.truths.has(key)) return text === "yes";
  if (key === "effects")
    return text === "none" ? [] : /^[a-z]+(,[a-z]+)*$/.test(text) ? text.split(",") : undefined;
  if (key === "cut") {
    const pairs = text.split(",").map((pair) => pair.split(":"));
    return pairs.every(([k, v]) => /^[a-z][a-z0-9-]*$/.test(k) && v !== undefined &&
               Number.isFinite(Number(v)))
      ? Object.fromEntries(pairs.map(([k, v]) => [k, Number(v)]))
      : undefined;
  }
  if (key === "exposure" && text !== "auto") {
    const factor = Number(text);
    return factor > 0 && Number.isFinite(factor) ? factor : undefined;
  }
  return /^[\w-]*$/.test(text) ? text : undefined;
}

class State {
  constructor() {
    this.values = {...k_state_defaults};
    this.listeners = [];
  }
  get(key) { return this.values[key]; }
  // `changes`: {key: value}. Listeners get the keys whose values have changed.
  set(changes, by) {
    const changed = new Set(Object.keys(changes).filter(
      (key) => JSON.stringify(this.values[key]) !== JSON.stringify(changes[key])));
    Object.assign(this.values, changes);
    if (changed.size)
      for (const listener of this.listeners) listener(changed, by);
    return changed;
  }
  listen(listener) { this.listeners.push(listener); }
  // Resets what belongs to one stone.
  forget_stone() {
    this.set({
      stone: null,
      turn: null,
      zoom: 1,
      pan: null,
      material: null,
      axis: null,
      colour: 1,
      cut: null,
      compare: "one",
      facets: "none"
    });
  }

  fragment() {
    const parts = [];
    for (const [key, usual] of Object.entries(k_state_defaults)) {
      const value = this.values[key];
      if (value === null || JSON.stringify(value) === JSON.stringify(usual)) continue;
      parts.push(key + "=" +
        encodeURIComponent(written_state(key, value)).replace(/%2C/g, ",").replace(/%3A/g, ":"));
    }
    return parts.join("&");
  }
  // `count`: number of stones; `first` is shown if the link names none of them.
  restore(fragment, count = Infinity, first = 0) {
    const values = {};
    for (const part of fragment.replace(/^#/, "").split("&")) {
      const [key, text] = part.split("=");
      if (!Object.hasOwn(k_state_defaults, key) || text === undefined) continue;
      let value;
      try {
        value = read_state(key, decodeURIComponent(text));
      } catch {
        continue;
      }
      if (value !== undefined) values[key] = value;
    }
    if (values.zoom !== undefined) values.zoom = Math.min(50, Math.max(0.2, values.zoom));
    if (!(values.item < count)) values.item = first;
    this.set({...k_state_defaults, ...values});
  }
}

if (typeof module !== "undefined") {
  globalThis.Turn = require("./orientation.js").Turn;
  module.exports = {State, k_state_defaults};
}
