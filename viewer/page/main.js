"use strict";
// The page: connects the parts.

const k_stone_file = /\.(asc|gem|obj|off|ply|stl|gltf|glb)$/i;
const k_most_of_stone = 16e6, k_most_of_panorama = 256e6;  // bytes

function by_id(id) { return document.getElementById(id); }

class Page {
  constructor() {
    this.document = JSON.parse(EngineClient.text_of("culet-document"));
    this.document.items[this.document.first || 0].picture ||= by_id("still").getAttribute("src");
    this.stage = by_id("stage");
    this.state = new State();
    this.picture = new PictureView(this.stage, by_id("picture"), by_id("still"));
    this.gpu = new GpuView(this, by_id("gpu-picture"));
    this.loop = new FrameLoop(this);
    this.fine = new FinePicture(this);
    this.overlay = new Overlay(this, by_id("overlay"));
    this.card = new FacetCard(this, by_id("facet-card"));
    this.engine = new EngineClient((line) => this.engine_died(line));
    this.stones = [];
    this.designs = new Map();    // stone's index -> the engine's number for its changed cut
    this.info = null;            // the engine's description of the item
    this.refused = "";           // why the engine cannot draw the current settings
    this.drawn_by_rays = false;  // the stone is not convex, so pictures take longer than by beams
    this.scene_version = 0;  // of what the engine holds besides stone and settings: cut, panorama
    this.hand_turns_light = false;
    this.motion = new Motion(this);
    this.pointing = new Pointing(this);
    this.command = new Command(this);
  }

  // --- What is shown

  ready() { return Boolean(this.info); }
  item() { return this.document.items[this.state.get("item")]; }
  document_stone() { return this.item().stones[this.shown_index()]; }
  shown_index() {
    const values = this.state.values;
    if (values.compare === "blink") return this.fit ? this.fit.blink_side : 0;
    if (values.compare === "split") return 0;
    const last = this.item().stones.length - 1;
    return Math.min(last, Math.max(0, values.stone ?? last));
  }
  shown_stone() { return this.stones[this.shown_index()]; }
  shown_name() { return stone_title(this.item().name || this.document.title); }
  own_material() {
    const material = this.document_stone().material;
    return (material && (material.id || material.name)) || "";
  }
  // The engine's number for a stone; a changed cut has its own.
  engine_stone(index) { return this.designs.get(index) ?? index; }
  optic() {
    const name = this.state.get("material");
    if (name) return (this.info.materials.find((m) => m.name === name) || {}).optic;
    const material = this.document_stone().material;
    return (material && material.optic) ||
      (this.info.materials.find((m) => m.name === this.own_material()) || {}).optic;
  }
  // The scene's own preset; empty: it has lights of its own.
  own_light() { return (this.info && this.info.settings && this.info.settings.light_preset) || ""; }
  light_preset() {
    const {light, polariser} = this.state.values;
    if (polariser !== null || light === "panorama") return null;
    return this.info.lights.find((l) => l.name === (light || this.own_light())) || null;
  }

  // Chosen on the page; it looks as `culet render --light` has it, whatever the light before.
  instrument() {
    const preset = this.ready() && this.state.get("light") && this.light_preset();
    return preset && preset.instrument ? preset : null;
  }
  // Instruments have no perspective.
  get base() {
    const {opened} = this, far = this.instrument() || this.state.get("polariser") !== null;
    return {...opened, orthographic: opened.orthographic || Boolean(far)};
  }
  // The view for which the light is made: from below for hearts.
  home() {
    const {home} = this.opened, instrument = this.instrument();
    if (!instrument) return home;
    return named_view(instrument.from_below ? "pavilion" : "table", this.shown_stone().up,
      Turn.back(home, [0, 1, 0]));
  }
  view() {
    const {turn, zoom, pan} = this.state.values;
    return {turn: turn || this.home(), zoom, pan: pan || this.base.pan};
  }
  lights_turn(turn = this.view().turn) {
    const {light_turn, lights_with, polariser} = this.state.values;
    // A polariscope's light is always behind the stone.
    if (polariser !== null) return Turn.after(Turn.inverse(turn), this.opened.home);
    if (lights_with === "stone") return light_turn;
    return Turn.after(Turn.after(Turn.inverse(turn), this.home()), light_turn);
  }
  // By default as `culet render`: to the stone, except for instruments and own lights. A dropped
  // panorama has unknown brightness.
  exposure() {
    const own = this.state.get("exposure");
    if (own !== null) return own;
    if (this.state.get("light") === "panorama") return "auto";
    const preset = this.light_preset();
    return preset && !preset.instrument ? "auto" : 1;
  }
  // The same as a number: 1 until it has been measured.
  exposure_factor() {
    const exposure = this.exposure();
    return exposure === "auto" ? this.loop.exposure || 1 : exposure;
  }
  tonemap() { return this.state.get("tonemap") ?? this.light_tonemap ?? "none"; }
  settings(stone) {
    return [
      ...settings_of(this.state.values, this.optic(stone), this.panorama_setting),
      `render.tolerance=${k_fine_tolerance}`
    ];
  }
  // The arguments that all calls of the engine about a view share.
  drawing(stone, width, height, view = this.view()) {
    return {
      stone: this.engine_stone(stone),
      camera: camera_of(this.base, view, this.base.center, width, height),
      turn: Turn.matrix(this.lights_turn(view.turn)),
      width,
      height,
    };
  }
  // The ball that the hand turns, in CSS pixels of the stage.
  ball() {
    const box = this.stage.getBoundingClientRect(), view = this.view();
    const scale = box.height / 2 / half_height_of(this.base, view.zoom, box.width, box.height);
    return {
      middle: [box.width / 2 + scale * view.pan[0], box.height / 2 - scale * view.pan[1]],
      radius: Math.max(0.2 * Math.min(box.width, box.height), scale * this.shown_stone().radius),
      scale,
    };
  }

  // --- Choices

  put_away() {
    this.light_path.clear();
    this.pointing.point(null);
    this.overlay.draw();
    by_id("trouble").hidden = true;
  }

  choose_light(name) {
    const before = this.home();
    this.state.set({light: name, polariser: null, analyser: null, retarder: null});
    const turned = Turn.apart(before, this.home()) > 1e-6;
    // Instruments are used looking straight on.
    if (turned || this.instrument()) this.motion.go_to(this.home());
  }
  turn_light_by_hand(on) {
    this.hand_turns_light = on;
    this.stage.classList.toggle("turning-light", on);
    this.say(on ? "Dragging turns the lights now." : "Dragging turns the stone now.");
    this.panels.light.update();
  }
  blink() {
    if (this.item().stones.length > 1)
      this.state.set({compare: this.state.get("compare") === "blink" ? "one" : "blink"});
    else
      this.say("There is one stone only: nothing to blink against.");
  }
  full_screen() {
    if (document.fullscreenElement)
      document.exitFullscreen();
    else if (document.documentElement.requestFullscreen) {
      document.documentElement.requestFullscreen().catch(
        () => this.say("The browser does not allow the full screen here."));
    }
  }
  // A stone or a panorama, by the file's name.
  async take_file(file) {
    if (!this.ready()) return;
    const stone = k_stone_file.test(file.name), most = stone ? k_most_of_stone : k_most_of_panorama;
    try {
      if (file.size > most) {
        const mb = (bytes) => (bytes / 1e6).toFixed(0) + " MB";
        throw new Error(`${file.name} has ${mb(file.size)}; this page takes ${mb(most)} at most`);
      }
      if (/\.(gltf|glb)$/i.test(file.name))
        throw new Error(`${file.name} is glTF, which a page does not read: culet convert makes an .obj of it`);
      this.say(`Reading ${file.name}\u2026`);
      await (stone ? this.take_stone(file) : this.take_panorama(file));
    } catch (error) {
      by_id("say").textContent = "";
      this.failed(error);
    }
  }
  // It becomes another stone of the page, in the material that is shown.
  async take_stone(file) {
    const {material, colour} = this.state.values, items = this.document.items;
    const bytes = new Uint8Array(await file.arrayBuffer());
    const {item} = await this.engine.in_turn(
      () => this.engine.call(
        "stone", {name: file.name, material: material || "", bytes}, [bytes.buffer]));
    const index = items.push(item) - 1;
    this.gallery.build();
    await this.open_item(index);
    this.state.set({colour});
    this.say(`This is ${file.name}.`);
  }
  async take_panorama(file) {
    await this.send_panorama(file);
    this.state.set({light: "panorama", polariser: null});
    this.panels.light.update();
    this.loop.changed();
    this.say(`The stone lies in ${file.name}.`);
  }

  // Kept, because a restarted engine has lost it.
  async send_panorama(file) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    const stone = this.shown_index();
    const answer = await this.engine.in_turn(async () => {
      await this.loop.prepare(stone, this.loop.settings(stone));
      return this.engine.call("panorama", {name: file.name, bytes}, [bytes.buffer]);
    });
    this.panorama = file;
    this.panorama_setting = answer.setting;
    ++this.scene_version;
  }

  // --- Drawing

  took_settings(answer) {
    this.refused = answer.refused || "";
    this.light_tonemap = answer.settings && answer.settings.tonemap;
    this.drawn_by_rays = answer.engine === "reference";
    if (this.drawn_by_rays) this.loop.start_coarsely();
    this.gpu.took_settings(answer);
    if (!this.panels.picture.told.length) this.panels.picture.took(answer);
  }
  show_picture() {
    const {compare, divider} = this.state.values;
    this.gpu.hide();
    this.picture.show(compare === "blink" && this.fit.blink_side ? "right" : "left",
      compare === "split" ? divider / 100 : null);
  }
  show_refused() {
    this.says_refused = true;
    this.gpu.hide();
    this.picture.canvas.hidden = true;
    this.picture.still.hidden = false;
    this.trouble(
      `The page cannot draw this live: ${this.refused}. The picture is what culet drew.`);
  }
  // `rough`: a finer picture follows.
  drawn(quick, rough = false) {
    this.stage.dataset.drawn = quick ? "quick" : rough ? "whole" : "fine";
    if (this.says_refused) by_id("trouble").hidden = true;
    this.says_refused = false;
    if (!this.first_picture_ms)
      this.stage.dataset.firstPictureMs = this.first_picture_ms = Math.round(performance.now());
    if (quick) return;
    if (!this.item().picture)
      this.gallery.take_picture((this.gpu.shown ? this.gpu : this.picture).canvas);
    this.keep_address();
    this.panels.picture.update();
    this.panels.save.update();
    this.tilts.update().catch((error) => this.failed(error));
  }

  // So that reloading shows the same.
  keep_address() {
    const fragment = this.state.fragment();
    if (location.hash.replace(/^#/, "") === fragment) return;
    try {
      history.replaceState(null, "", fragment ? "#" + fragment : location.href.replace(/#.*$/, ""));
    } catch {
      // Some browsers forbid it for pages from a file; the link can still be copied.
    }
  }

  // --- Words

  // Shows a line for a while. `aloud`: only for screen readers; others see the same in the panel.
  say(line, aloud = false) {
    clearTimeout(this.saying);
    by_id("say").classList.toggle("unseen", aloud);
    by_id("say").textContent = line;
    this.saying = setTimeout(() => {
      by_id("say").textContent = "";
    }, 4500);
  }
  trouble(line, button_text = "", act = null) {
    by_id("trouble").hidden = false;
    by_id("trouble-text").textContent = line;
    const again = by_id("trouble-button");
    again.hidden = !act;
    again.textContent = button_text;
    again.onclick = act;
  }
  failed(error) {
    if (error instanceof EngineError && /^(overtaken|started again)$/.test(error.message)) return;
    this.trouble(error.message || String(error));
  }
  engine_died(line) {
    this.info = null;
    this.loop.forget();
    this.trouble(`The engine stopped: ${
                   line.replace(/^the engine stopped:?\s*/, "") || "no reason is known"}.`,
      "Start it again", () => {
        by_id("trouble").hidden = true;
        this.start_engine();
      });
  }
}
