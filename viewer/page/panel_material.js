"use strict";
// The material, found by a few letters; its optic axis; the depth of its colour.

class PanelMaterial {
  constructor(page, info) {
    this.page = page;
    this.materials =
      [{name: "", label: "As in the file", summary: page.own_material()}, ...info.materials];
    const list_id = new_id("materials"), field_id = new_id("search");
    this.field = element("input", {
      type: "search",
      id: field_id,
      role: "combobox",
      autocomplete: "off",
      spellcheck: "false",
      "aria-expanded": "true",
      "aria-controls": list_id,
      "aria-autocomplete": "list",
      placeholder: "Search: sapphire, uniaxial, 1.76",
      "data-name": "material",
      oninput: () => this.list_those(this.field.value),
      onkeydown: (event) => this.key(event),
    });
    this.list = element("ul",
      {id: list_id, role: "listbox", class: "materials", "aria-label": "Materials", tabindex: -1});
    this.axis_note = element("p", {class: "note"});
    const axis = (index, value) => {
      const now = (this.page.state.get("axis") || [0, 0]).slice();
      now[index] = value;
      page.motion.slide({axis: now});
    };
    this.tilt = slider({
      name: "axis-tilt",
      label: "Optic axis, from straight up",
      least: 0,
      most: 90,
      step: 1,
      unit: "\u00b0",
      value: 0,
      onchange: (value) => axis(0, value)
    });
    this.azimuth = slider({
      name: "axis-azimuth",
      label: "towards azimuth",
      least: 0,
      most: 360,
      step: 1,
      unit: "\u00b0",
      value: 0,
      onchange: (value) => axis(1, value)
    });
    this.own_axis = button("As in the file", () => page.state.set({axis: null}),
      {class: "wide", "data-name": "own-axis"});
    this.colour = slider({
      name: "colour",
      label: "Depth of colour",
      least: 0,
      most: 4,
      step: 0.05,
      digits: 2,
      unit: " times",
      value: 1,
      onchange: (value) => page.motion.slide({colour: value})
    });
    this.axis_group =
      group("Crystal", null, this.axis_note, this.tilt, this.azimuth, this.own_axis);
    this.node = element("div", {},
      group("Material", null, element("label", { class: "unseen", for: field_id }, "Search a material"), this.field, this.list, this.colour),
      this.axis_group);
      this.list_those("");
  }

  list_those(words) {
      const wanted = words.toLowerCase().split(/\s+/).filter(Boolean);
      this.listed = this.materials.filter((m) => {
        const text = `${m.label || ""} ${m.title || ""} ${m.name} ${m.optic || ""} ${
          m.index || ""} ${m.summary || ""}`
                       .toLowerCase()
                       .replace(/_/g, " ");
        return wanted.every((word) => text.includes(word.replace(/_/g, " ")));
      });
      // The best match first, which Enter takes: the name itself, a name that begins so, one that
      // has all the words, a description.
      const rank = (m) => {
        const name = (m.title || m.name).toLowerCase().replace(/ \(.*/, ""), all = wanted.join(" ");
        if (!all || name === all) return 0;
        if (name.startsWith(all)) return 1;
        return wanted.every((word) => name.includes(word)) ? 2 : 3;
      };
      this.listed.sort((a, b) => rank(a) - rank(b));
      const chosen = this.page.state.get("material") || "";
      this.list.replaceChildren(...this.listed.map(
        (m) => element("li", {
          role: "option",
          id: "material-" + (m.name || "own"),
          "aria-selected": String(m.name === chosen),
          onclick: () => this.choose(m),
        },
          element("b", {}, this.swatch(m), m.label || m.title || m.name.replace(/_/g, " ")),
          element("span", {class: "what"}, this.about(m)))));
      if (!this.listed.length)
        this.list.append(element("li", {class: "none"}, "No material like this in the catalogue"));
      this.active = Math.max(0, this.listed.findIndex((m) => m.name === chosen));
      this.mark();
  }
  about(material) {
      if (!material.name) return material.summary || "";
      const index = [].concat(material.index ?? []).map((n) => n.toFixed(3)).join(" / ");
      const colour = material.colour ? material.summary
        : material.summary           ? `${material.summary}; drawn colourless: no spectrum measured`
                                     : "colourless";
      return [index, material.optic, colour].filter(Boolean).join(", ");
  }
  // The body colour, if it has one; the words beside it say the same.
  swatch(material) {
      if (!/^#[0-9a-f]{6}$/i.test(material.colour || "")) return null;
      const made = element("i", {class: "swatch"});
      made.style.background = material.colour;
      return made;
  }
  mark() {
      const items = [...this.list.querySelectorAll("[role=option]")];
      items.forEach((item, i) => item.classList.toggle("active", i === this.active));
      const item = items[this.active];
      this.field.setAttribute("aria-activedescendant", item ? item.id : "");
      if (item && document.activeElement === this.field) item.scrollIntoView({block: "nearest"});
  }
  key(event) {
      if (event.key === "ArrowDown" || event.key === "ArrowUp") {
        const step = event.key === "ArrowDown" ? 1 : -1;
        this.active = Math.min(this.listed.length - 1, Math.max(0, this.active + step));
        this.mark();
      } else if (event.key === "Enter" && this.listed[this.active]) {
        this.choose(this.listed[this.active]);
      } else if (event.key === "Escape" && this.field.value) {
        this.field.value = "";
        this.list_those("");
      } else {
        return;
      }
      event.preventDefault();
      event.stopPropagation();
  }
  // An axis belongs to one crystal: another material starts with its own.
  choose(material) {
      this.page.state.set({material: material.name || null, axis: null}); }

  update() {
      const values = this.page.state.values, optic = this.page.optic();
      this.list_those(this.field.value);
      this.axis_group.hidden = !optic || optic === "isotropic";
      this.axis_note.textContent = optic === "biaxial"
        ? "Biaxial: the angles are of the direction alpha."
        : "Uniaxial: along this axis there is no double refraction.";
      const [tilt, azimuth] = values.axis || [0, 0];
      this.tilt.show(tilt);
      this.azimuth.show(azimuth);
      this.own_axis.disabled = values.axis === null;
      this.colour.show(values.colour);
  }
  }
