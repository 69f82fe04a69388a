"use strict";
// The choice of light and its direction.

const k_light_names = {
  jeweller: "Jeweller\u2019s counter",
  photograph: "Photograph",
  daylight: "Daylight",
  lightbox: "Light box",
  darkfield: "Dark field",
  aset: "ASET",
  idealscope: "Ideal-scope",
  arrows: "Arrows",
  hearts: "Hearts",
};

class PanelLight {
  // `info`: the engine's answer to `open`.
  constructor(page, info) {
    this.page = page;
    const named = (lights) => lights.map(
      ({name, summary}) => ({value: name, label: k_light_names[name] || name, what: summary}));
    const take = (name) => page.choose_light(name);
    const own = page.own_light()
      ? []
      : [{value: "", label: "As in the file", what: "the scene\u2019s own lights"}];
    this.presets = choice("Light", [...own, ...named(info.lights.filter((l) => !l.instrument))],
      (name) => take(name || null), "cards", "light");
    this.instruments = choice("Through an instrument",
      named(info.lights.filter((l) => l.instrument)), take, "cards short", "instrument");
    this.tilts = toggle("Tilt strip", (on) => page.state.set({tilts: on}),
      {name: "tilts", what: "the stone rocked from \u221230\u00b0 to +30\u00b0"});
    this.by_hand = toggle("Drag turns the light", (on) => page.turn_light_by_hand(on),
      {name: "light-by-hand", what: "instead of the stone (L)"});
    this.stay = choice("The lights stay with",
      [
        {value: "viewer", label: "the viewer"},
        {value: "stone", label: "the stone"},
      ],
      (value) => page.state.set({lights_with: value}), "segments", "lights-with");
    this.reset =
      button("Lights as they were", () => page.state.set({light_turn: k_state_defaults.light_turn}),
        {class: "wide", "data-name": "reset-light"});
    this.panorama_note =
      element("p", {class: "note"}, "Or drop it on the stone. A panorama is not kept in the link.");
    this.node = element("div", {}, group("Light", null, this.presets),
      group("Through an instrument", null, this.instruments, this.tilts),
      group("By hand", null, this.by_hand, this.stay, this.reset),
      group("Your own surroundings", null,
        file_button("Open a panorama (.hdr, .exr, .jpg, .png)", ".hdr,.exr,.jpg,.jpeg,.png",
          (file) => page.take_file(file)),
        this.panorama_note));
  }

  update() {
    const values = this.page.state.values;
    const light = values.polariser !== null ? null : values.light || this.page.own_light();
    this.presets.show(light ?? "");
    this.instruments.show(light);
    if (values.polariser !== null || light === "panorama") this.presets.show("none of them");
    this.tilts.show(values.tilts);
    this.by_hand.show(this.page.hand_turns_light);
    this.stay.show(values.lights_with);
    this.reset.disabled = Turn.apart(values.light_turn, Turn.none) < 1e-6;
    if (this.page.panorama) this.panorama_note.textContent = "Read: " + this.page.panorama.name;
  }
}
