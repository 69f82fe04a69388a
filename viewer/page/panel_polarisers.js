"use strict";
// A polariscope, as in docs/rendering.md: polarised light from behind the stone, an analyser before
// the eye, a plate between them.

class PanelPolarisers {
  constructor(page) {
    this.page = page;
    const set = (changes) => page.state.set(changes);
    this.polariser = toggle("Polarised light from behind", (on) => set({
      polariser: on ? 0 : null,
      analyser: on && page.state.get("analyser") === null ? 90 : page.state.get("analyser"),
    }),
      {name: "polariser", what: "instead of the other lights: a polariscope"});
    this.polariser_dial =
      dial("Polariser", (degrees) => set({polariser: degrees}), "polariser-angle");
    this.analyser = toggle("Analyser before the eye", (on) => set({analyser: on ? 90 : null}),
      {name: "analyser", what: "lets one direction of vibration pass"});
    this.analyser_dial = dial("Analyser", (degrees) => set({analyser: degrees}), "analyser-angle");
    this.cross = button("Cross them",
      () => set({analyser: (page.state.get("polariser") || 0) + 90}), {"data-name": "cross"});
    this.along = button("Parallel", () => set({analyser: page.state.get("polariser") || 0}),
      {"data-name": "parallel"});
    this.plate = toggle("Full-wave plate, 530 nm", (on) => set({retarder: on ? 530 : null}),
      {name: "retarder", what: "grey becomes red-violet; blue and yellow tell the slow direction"});
    this.node =
      group("Polarisers", "Angles count counter-clockwise from the picture\u2019s horizontal.",
        this.polariser, this.polariser_dial, this.analyser, this.analyser_dial,
        element("div", {class: "pair"}, this.cross, this.along), this.plate);
  }

  update() {
    const {polariser, analyser, retarder} = this.page.state.values;
    this.polariser.show(polariser !== null);
    this.polariser_dial.show(polariser);
    this.analyser.show(analyser !== null);
    this.analyser.input.disabled = polariser !== null;
    this.analyser_dial.show(analyser);
    this.cross.disabled = this.along.disabled = polariser === null;
    this.plate.show(retarder !== null);
    this.plate.input.disabled = polariser === null && analyser === null;
  }
}
