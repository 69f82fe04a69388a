"use strict";
// How the picture is computed and shown.

const k_effects = [
  ["dispersion", "Dispersion"],
  ["birefringence", "Double refraction"],
  ["polarization", "Polarisation"],
  ["absorption", "Colour by absorption"],
  ["pleochroism", "Pleochroism"],
];
const k_tone_maps =
  [["none", "None"], ["reinhard", "Reinhard"], ["filmic", "Filmic"], ["gamma2", "Gamma 2"]];

class PanelPicture {
  constructor(page) {
    this.page = page;
    const set = (changes) => page.state.set(changes);
    this.auto =
      toggle("Exposed to the stone", (on) => set({exposure: on ? "auto" : page.exposure_factor()}),
        {name: "exposure-auto", what: "one pixel in fifty burns out"});
    // In stops: each doubles the light.
    this.exposure = slider({
      name: "exposure",
      label: "Exposure",
      least: -5,
      most: 5,
      step: 0.1,
      digits: 1,
      unit: " stops",
      value: 0,
      onchange: (value) => page.motion.slide({exposure: Math.pow(2, value)})
    });
    this.tonemap = choice("Tone curve", k_tone_maps.map(([value, label]) => ({value, label})),
      (value) => set({tonemap: value}), "segments", "tonemap");
    this.wire = toggle("Facet edges", (on) => set({wire: on}), {name: "wire", what: "(W)"});
    this.names = toggle("Facet names", (on) => set({names: on}), {name: "names"});
    this.spin = toggle("Turns on when let go", (on) => {
      page.motion.keeps_turning = on;
    }, {name: "spin"});

    this.effects_auto = toggle("All that can matter",
      (on) => set({effects: on ? null : this.on_now()}), {name: "effects-auto"});
    this.effects = k_effects.map(([name, label]) => ({
      name,
      control:
        toggle(label, (on) => this.set_effect(name, on), {name: "effect-" + name, what: " "}),
    }));
    this.wavelengths = choice("Wavelengths",
      [
        {value: 0, label: "As needed"},
        {value: 1, label: "1"},
        {value: 3, label: "3"},
        {value: 8, label: "8"},
        {value: 15, label: "15"},
      ],
      (value) => set({wavelengths: value || null}), "segments", "wavelengths");
    this.depth = slider({
      name: "depth",
      label: "Faces on a path (0: as many as needed)",
      least: 0,
      most: 20,
      step: 1,
      value: 0,
      onchange: (value) => page.motion.slide({depth: value || null})
    });
    this.drawn_by = choice("Drawn by",
      [
        {value: "fastest", label: "Whichever is faster"},
        {value: "beams", label: "Beams"},
        {value: "gpu", label: "GPU"},
      ],
      (value) => set({drawn_by: value}), "segments", "drawn-by");
    this.times = element("p", {class: "note times"});
    this.notes = element("ul", {class: "notes"});
    this.node =
      element("div", {}, group("Brightness", null, this.auto, this.exposure, this.tonemap),
        group("Over the picture", null, this.wire, this.names, this.spin),
        group("What is computed", null, this.effects_auto, ...this.effects.map((e) => e.control),
          this.wavelengths, this.depth, this.notes),
        group("Engine", null, this.drawn_by, this.times));
    this.told = [];
  }

  on_now() {
    const told = this.told.filter((e) => e.on).map((e) => e.name);
    return k_effects.map(([name]) => name)
      .filter((name) => !this.told.length || told.includes(name));
  }
  set_effect(name, on) {
    const now = this.page.state.get("effects") || this.on_now();
    const wanted = new Set(now);
    if (on)
      wanted.add(name);
    else
      wanted.delete(name);
    this.page.state.set({effects: k_effects.map(([n]) => n).filter((n) => wanted.has(n))});
  }

  // The engine's answer to `set`.
  took(answer) {
    this.told = answer.effects || [];
    for (const {name, control} of this.effects) {
      const told = this.told.find((effect) => effect.name === name);
      control.what(told ? (told.on ? "on: " : "off: ") + told.why : "");
      if (told && this.page.state.get("effects") === null) control.show(told.on);
    }
    this.notes.replaceChildren(...(answer.notes || []).map((note) => element("li", {}, note)));
  }

  update() {
    const values = this.page.state.values, factor = this.page.exposure_factor();
    this.auto.show(this.page.exposure() === "auto");
    this.exposure.show(Math.min(5, Math.max(-5, Math.log2(factor))));
    this.tonemap.show(this.page.tonemap());
    this.wire.show(values.wire);
    this.names.show(values.names);
    this.spin.show(this.page.motion.keeps_turning);
    this.effects_auto.show(values.effects === null);
    if (values.effects)
      for (const {name, control} of this.effects) control.show(values.effects.includes(name));
    this.wavelengths.show(values.wavelengths || 0);
    this.depth.show(values.depth || 0);
    this.drawn_by.show(values.drawn_by);
    this.drawn_by.allow("gpu", !this.page.gpu.refusal());
    this.show_times();
  }
  show_times() {
    const {preview, whole, beams, gpu} = this.page.loop.milliseconds;
    const times =
      [
        ["beams", beams], ["with three wavelengths", whole], ["quick frames", preview],
        ["GPU, one sample a pixel", gpu]
      ].filter(([, ms]) => ms !== undefined)
        .map(([name, ms]) => `${name} ${ms.toFixed(0)} ms`);
    const refusal = this.page.gpu.refusal();
    this.times.textContent =
      times.join(", ") + (refusal ? (times.length ? ". " : "") + "GPU: " + refusal : "");
  }
}
