"use strict";
// Sliders for the proportions of a standard cut.

class PanelCut {
  constructor(page, info) {
    this.page = page;
    this.info = info;
    this.node = element("div", {});
    this.made_for = undefined;
  }

  // Nothing if the shown stone is not a standard cut.
  kind() {
    const stone = this.page.document_stone();
    const cut = stone && stone.cut;
    return cut ? {cut, kind: (this.info.cuts || []).find((c) => c.name === cut.kind)} : {};
  }

  update() {
    const {cut, kind} = this.kind();
    if (this.made_for !== cut) this.build(cut, kind);
    this.made_for = cut;
    if (!kind) return;
    const changed = this.page.state.get("cut") || {};
    for (const {parameter, control} of this.sliders) {
      control.show(changed[parameter.name] ?? this.start(cut, parameter));
    }
    this.reset.disabled = !this.page.state.get("cut");
  }
  start(cut, parameter) {
    return cut.values && cut.values[parameter.name] !== undefined ? cut.values[parameter.name]
                                                                  : parameter.value;
  }

  build(cut, kind) {
    this.node.replaceChildren();
    if (!kind) return;
    this.sliders =
      kind.parameters
        .filter((parameter) => !["azimuth", "diameter", "width"].includes(parameter.name))
        .map((parameter) => ({parameter, control: this.slider_of(cut, parameter)}));
    this.reset = button("As it was", () => this.page.state.set({cut: null}),
      {class: "wide", "data-name": "reset-cut"});
    this.node.append(
      group("Proportions", kind.summary, ...this.sliders.map(({control}) => control), this.reset));
  }
  slider_of(cut, parameter) {
    const whole =
      parameter.unit === "" && parameter.name !== "ratio" && Number.isInteger(parameter.value);
    const words = parameter.name.replace(/-/g, " ");
    return slider({
      name: "cut-" + parameter.name,
      label: words[0].toUpperCase() + words.slice(1),
      least: parameter.least,
      most: parameter.most,
      what: parameter.what,
      step: whole                  ? 1
        : parameter.unit === "deg" ? 0.05
        : parameter.unit === "%"   ? 0.5
                                   : 0.01,
      digits: whole              ? 0
        : parameter.unit === "%" ? 1
                                 : 2,
      unit: {deg: "\u00b0", "%": " %", mm: " mm"}[parameter.unit] || "",
      value: this.start(cut, parameter),
      onchange: (value) =>
        this.page.motion.slide({cut: {...this.page.state.get("cut"), [parameter.name]: value}}),
    });
  }
}
