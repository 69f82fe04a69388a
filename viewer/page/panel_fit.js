"use strict";
// The measured stone: compared with the fit's start, and the uncertainty of each facet.

const k_role_names = {
  catalogue: "Catalogue",
  fitted: "Fitted",
  design: "Design",
  stone: "Stone"
};

class PanelFit {
  constructor(page) {
    this.page = page;
    this.node = element("div", {});
    this.legend = element("div", {class: "legend", "aria-live": "polite"});
    this.timer = 0;
    this.blink_side = 0;
  }

  build() {
    const page = this.page, stones = page.item().stones;
    const parts = [];
    this.shown = this.compare = this.colours = null;
    if (stones.length > 1) {
      this.shown = choice("Show",
        stones.map((stone, i) => ({value: i, label: k_role_names[stone.role] || stone.name})),
        (index) => page.state.set({stone: index, compare: "one"}), "segments", "stone");
      this.compare = choice("Compare",
        [
          {value: "one", label: "One"},
          {value: "blink", label: "Blink"},
          {value: "split", label: "Divided"},
        ],
        (value) => page.state.set({compare: value}), "segments", "compare");
      parts.push(group("Catalogue against fitted",
        "Blink shows one, then the other, twice a second at most: what differs jumps.", this.shown,
        this.compare));
    }
    if (stones.some((stone) => stone.fit)) {
      this.colours = choice("Colour the facets by",
        [
          {value: "none", label: "Nothing"},
          {value: "residual", label: "Residual"},
          {value: "sigma", label: "Uncertainty"},
        ],
        (value) => page.state.set({facets: value}), "segments", "facets");
      parts.push(group("How sure", null, this.colours, this.legend));
    }
    this.node.replaceChildren(...parts);
  }
  any() { return this.node.childElementCount > 0; }

  update() {
    const page = this.page, values = page.state.values;
    if (this.shown) this.shown.show(values.compare === "one" ? page.shown_index() : "both");
    if (this.compare) this.compare.show(values.compare);
    if (this.colours) this.colours.show(values.facets);
    this.show_legend(values.facets);
    this.blink(values.compare === "blink");
    const divided = values.compare === "split";
    const divider = document.getElementById("divider");
    divider.hidden = !divided;
    divider.style.left = values.divider + "%";
    divider.setAttribute("aria-valuenow", Math.round(values.divider));
    divider.setAttribute(
      "aria-valuetext", Math.round(values.divider) + " % of the picture is the left stone\u2019s");
    this.name_sides();
  }

  show_legend(kind) {
    this.legend.replaceChildren();
    const stone = this.page.shown_stone();
    if (kind === "none" || !stone) return;
    if (!stone.has_fit()) {
      this.legend.append(element("p", {class: "note"},
        "This stone was not fitted: its facets have no colours. Show the fitted one."));
      return;
    }
    const {legend} = facet_colours(stone.facets, kind);
    const scale = element("div", {class: "scale"});
    scale.style.background = `linear-gradient(to right, ${legend.stops.join(", ")})`;
    this.legend.append(element("p", {}, legend.what), scale,
      element("div", {class: "ends"}, ...legend.ends.map((end) => element("span", {}, end))),
      element("p", {class: "note"}, [legend.plain, legend.mark].filter(Boolean).join("; ")));
  }

  // Twice a second at most is slow enough for people whom flicker harms (WCAG 2.3.1 allows three).
  blink(on) {
    if (on === Boolean(this.timer)) return;
    clearInterval(this.timer);
    this.timer = 0;
    this.blink_side = 0;
    if (!on) return;
    this.timer = setInterval(() => {
      this.blink_side = 1 - this.blink_side;
      this.page.show_picture();
      this.page.overlay.draw();
      this.name_sides();
    }, 600);
  }

  name_sides() {
    const page = this.page, compare = page.state.get("compare"), stones = page.item().stones;
    const name = (index) =>
      stones[index] ? k_role_names[stones[index].role] || stones[index].name : "";
    const [left, right] = ["left-name", "right-name"].map((id) => document.getElementById(id));
    left.hidden = compare === "one";
    right.hidden = compare !== "split";
    left.textContent = name(compare === "blink" ? this.blink_side : 0);
    right.textContent = name(1);
  }
}
