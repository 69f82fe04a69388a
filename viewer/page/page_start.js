"use strict";
// Opens the page. The still picture is already there; then come the engine, the item, the panels.

class Tabs {
  constructor(page, list, panels) {
    this.page = page;
    this.list = list;
    this.panels = panels;
    list.addEventListener("keydown", (event) => {
      const shown = this.tabs.filter((tab) => !tab.button.hidden);
      const now = shown.findIndex((tab) => tab.button.getAttribute("aria-selected") === "true");
      const to = {ArrowRight: now + 1,
        ArrowLeft: now - 1,
        Home: 0,
        End: shown.length - 1}[event.key];
      if (to === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      const tab = shown[(to + shown.length) % shown.length];
      this.open(tab.name);
      tab.button.focus();
    });
  }
  // `tabs`: [{name, label, nodes}].
  build(tabs) {
    this.tabs = tabs.map(({name, label, nodes}) => {
      const panel = element("div",
        {role: "tabpanel", id: "panel-" + name, "aria-labelledby": "tab-" + name, tabindex: 0},
        ...nodes);
      const tab = element("button", {
        type: "button",
        role: "tab",
        id: "tab-" + name,
        "aria-controls": "panel-" + name,
        onclick: () => this.open(name),
      },
        label);
      return {name, button: tab, panel};
    });
    this.list.replaceChildren(...this.tabs.map((tab) => tab.button));
    this.panels.replaceChildren(...this.tabs.map((tab) => tab.panel));
    this.open(
      this.opened && this.tabs.some((tab) => tab.name === this.opened) ? this.opened : "light");
  }
  open(name) {
    this.opened = name;
    for (const tab of this.tabs) {
      const chosen = tab.name === name;
      tab.button.setAttribute("aria-selected", String(chosen));
      tab.button.tabIndex = chosen ? 0 : -1;
      tab.panel.hidden = !chosen;
      if (chosen) tab.button.scrollIntoView({block: "nearest", inline: "nearest"});
    }
    if (this.page.panels && name === "save") this.page.panels.save.update();
  }
  show(name, shown) {
    const tab = this.tabs.find((one) => one.name === name);
    tab.button.hidden = !shown;
    if (!shown && this.opened === name) this.open("light");
  }
}

Object.assign(Page.prototype, {
  async start() {
    this.restore_link();
    this.keys = new Keys(this, by_id("hand"), by_id("help"));
    this.gallery = new Gallery(this, by_id("gallery"));
    this.show_item();
    this.wire_stage();
    const refusal = EngineClient.refusal();
    if (refusal) {
      by_id("app").classList.add("still-only");
      this.trouble(refusal);
      return;
    }
    this.state.listen((changed, by) => this.changed(changed, by));
    await this.start_engine();
  },

  restore_link() {
    const count = this.document.items.length;
    this.state.restore(location.hash, count, Math.min(count - 1, this.document.first || 0));
  },

  async start_engine() {
    try {
      await this.engine.start();
      await this.open_engine();
    } catch (error) {
      if (this.engine.worker) this.failed(error);
    }
  },

  async open_engine() {
    const item = this.state.get("item");
    this.loop.forget();
    this.refused = this.item().refused || "";
    by_id("app").classList.toggle("still-only", Boolean(this.refused));
    if (this.refused) {
      this.show_refused();
      return;
    }
    const info =
      await this.engine.in_turn(() => this.engine.call("open", {document: this.document, item}));
    if (item !== this.state.get("item")) return;  // a newer one is on its way
    this.stones =
      this.item().stones.map((stone, index) => new ShownStone(stone, info.stones[index]));
    this.designs.clear();
    this.cut_held = null;
    this.opened = base_of(info.camera, this.stones[info.stone ?? this.stones.length - 1].center);
    this.fit_stage();
    this.info = info;
    this.show_facts();
    ++this.scene_version;
    this.build_panels();
    if (this.state.get("light") === "panorama") {
      this.panorama_setting = "";
      if (this.panorama)
        await this.send_panorama(this.panorama);
      else
        this.state.set({light: null});
    }
    if (this.state.get("cut")) await this.make_cut().catch((error) => this.failed(error));
    this.overlay.draw();
    this.loop.moved();  // a quick picture first
    if (!this.state.get("turn")) this.motion.turn_slowly();
  },

  async open_item(index) {
    this.info = null;
    this.fine.stop();
    this.state.forget_stone();
    this.state.set({item: index});
    this.put_away_all();
    this.show_item();
    try {
      await this.open_engine();
    } catch (error) {
      this.failed(error);
    }
  },
  put_away_all() {
    this.overlay.path = [];
    this.overlay.pointed = null;
    this.card.show(null, null);
    by_id("overlay").replaceChildren();
    by_id("trouble").hidden = true;
    this.picture.forget();
  },
  show_item() {
    const item = this.item(), still = by_id("still");
    this.gpu.hide();
    this.picture.canvas.hidden = true;
    still.hidden = !/^data:image\/(png|jpeg|webp);/.test(item.picture || "");
    if (!still.hidden) still.src = item.picture;
    document.title = still.alt = by_id("title").textContent = this.shown_name();
    this.show_facts();
    by_id("hand").setAttribute("aria-label",
      document.title + ": arrow keys turn it, plus and minus zoom, question mark shows all keys");
    this.gallery.update();
  },
  // What a jeweller asks first.
  show_facts() {
    const stone = this.shown_stone(), chosen = this.ready() && this.state.get("material");
    const own = (this.item().stones.length && this.document_stone().material) || {};
    const material = chosen ? this.info.materials.find((m) => m.name === chosen) : own;
    const name = (material && (material.title || material.name || material.id)) || "";
    const parts = [name.replace(/_/g, " ")];
    if (this.ready() && stone) {
      parts.push(
        stone.size(), stone.weight(material && material.density_g_cm3), stone.proportions());
    }
    if (this.item().stones.length > 1) parts.push("fitted, beside the catalogue\u2019s");
    by_id("subtitle").textContent = parts.filter(Boolean).join(" \u00b7 ");
  },

  build_panels() {
    const info = this.info;
    this.light_path = new LightPath(this);
    if (this.fit) this.fit.blink(false);
    this.fit = new PanelFit(this);
    this.fit.build();
    this.panels = {
      light: new PanelLight(this, info),
      polarisers: new PanelPolarisers(this),
      material: new PanelMaterial(this, info),
      cut: new PanelCut(this, info),
      fit: this.fit,
      picture: new PanelPicture(this),
      save: new PanelSave(this),
    };
    this.tilts ??= new TiltStrip(this, by_id("tilts"));
    this.tabs ??= new Tabs(this, by_id("tabs"), by_id("tab-panels"));
    const {light, polarisers, material, cut, picture, save} = this.panels;
    this.tabs.build([
      {name: "light", label: "Light", nodes: [light.node]},
      {name: "stone", label: "Stone", nodes: [material.node, cut.node, this.another_stone()]},
      {name: "polarisers", label: "Polarisers", nodes: [polarisers.node]},
      {name: "fit", label: "Measured", nodes: [this.fit.node]},
      {name: "path", label: "Path", nodes: [this.light_path.node]},
      {name: "picture", label: "Picture", nodes: [picture.node]},
      {name: "save", label: "Save", nodes: [save.node]},
    ]);
    this.tabs.show("fit", this.fit.any());
    this.update_panels();
  },
  another_stone() {
    return group("Another stone",
      ".asc, .gem, .obj, .stl, .ply or .off, in this material. Or drop it on this one; the link does not keep it.",
      file_button("Open a stone", ".asc,.gem,.obj,.stl,.ply,.off", (file) => this.take_file(file)));
  },
  update_panels() {
    for (const panel of Object.values(this.panels)) panel.update();
  },

  changed(changed, by) {
    if (!this.ready()) return;
    if (changed.has("cut")) this.cut_soon();
    const drawn = [...changed].some(
      (key) => !["divider", "facets", "wire", "names", "tilts", "cut", "item"].includes(key));
    if (["turn", "zoom", "pan", "stone", "compare", "cut"].some((key) => changed.has(key)) &&
      this.overlay.path.length) {
      this.light_path.clear();
    }
    if (by !== "hand") {
      this.update_panels();
    } else {
      this.panels.light.reset.disabled = Turn.apart(this.state.get("light_turn"), Turn.none) < 1e-6;
    }
    if (changed.has("divider")) this.show_picture();
    if (changed.has("tilts")) this.tilts.update().catch((error) => this.failed(error));
    if (changed.has("compare")) this.picture.forget();
    this.overlay.draw();
    if (changed.has("material") || changed.has("stone")) this.show_facts();
    if (drawn) this.loop.changed();
  },

  // Proportions change as fast as a slider moves: only the newest is cut.
  async cut_soon() {
    this.cut_wanted = true;
    if (this.cutting) return;
    this.cutting = true;
    while (this.cut_wanted && this.ready()) {
      this.cut_wanted = false;
      try {
        await this.make_cut();
      } catch (error) {
        this.failed(error);
      }
    }
    this.cutting = false;
  },
  async make_cut() {
    const values = this.state.get("cut"), index = this.shown_index(), stone = this.document_stone();
    if (!stone.cut) return;
    if (values) {
      const args = {kind: stone.cut.kind, values: {...stone.cut.values, ...values}};
      const answer = await this.engine.in_turn(() => this.engine.call("cut", args));
      this.stones[index] = new ShownStone(answer.geometry, answer.summary);
      this.designs.set(index, answer.stone);
      this.cut_held = args;
      by_id("trouble").hidden = true;
    } else {
      this.stones[index] = new ShownStone(stone, this.info.stones[index]);
      this.designs.delete(index);
      this.cut_held = null;
    }
    this.show_facts();
    ++this.scene_version;
    this.loop.forget();
    this.light_path.clear();
    this.overlay.draw();
    this.loop.changed();
  },
});

const culet_page = new Page();
culet_page.start();
