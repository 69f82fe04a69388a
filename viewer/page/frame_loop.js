"use strict";
// Decides when to draw, and how finely: while something moves, quick frames of a size that the last
// frames' times allow; at rest, the whole picture, then refinements. One picture at a time.

const k_quick_ms = 33;       // of a frame while the stone moves
const k_ray_ms = 90;         // the same for a stone that is not convex
const k_rest_ms = 140;       // without a move, before the whole picture is drawn
const k_least_scale = 0.5;   // of the screen's resolution; coarser is a blur
const k_least_ray_scale = 0.25;
const k_fine_ms = 250;       // without a move, before the fine picture begins
const k_quick_depth = 12;    // faces of a path: in a diamond the rest brings 1.5 % of its light
// For stones that are not convex: first without light that re-enters the stone, then as culet
// render draws it, which takes ten times as long.
const k_ray_rounds = ["preview", "beams"];
const k_levels = {
  quick: 0,
  whole: 1,
  done: 2
};

class FrameLoop {
  constructor(page) {
    this.page = page;
    this.scale = 0.6;  // of the screen's resolution while moving
    this.level = k_levels.quick;
    this.last_move = -Infinity;
    this.running = false;
    this.paused = false;     // while others (recording) need the engine
    this.set_key = "";       // what the engine was last told to draw
    this.exposure = null;    // of all views of what is shown
    this.exposed = "";       // what that was measured on
    this.milliseconds = {};  // the last time of each way of drawing
    this.idle_waiters = [];
  }

  // Something moved: quick frames now, the whole picture later.
  moved() {
    this.last_move = performance.now();
    this.changed();
  }
  changed() {
    this.level = k_levels.quick;
    this.version = (this.version || 0) + 1;
    this.page.fine.stop();  // it would take half of two cores from the quick frames
    if (this.wake) this.wake();
    if (!this.running && !this.paused) this.run();
  }
  // The engine was restarted and has lost its state.
  forget() { this.set_key = ""; }
  // A slow machine tells of the hand late: without the frames' time it would seem to rest.
  moving() {
    const rest = Math.max(k_rest_ms, 2 * (this.milliseconds.preview || 0));
    return performance.now() - this.last_move < rest;
  }

  // Resolves once the whole picture of the current request is on the page.
  idle() {
    if (!this.running && (this.level === k_levels.done || !this.page.ready()))
      return Promise.resolve();
    return new Promise((resolve) => this.idle_waiters.push(resolve));
  }

  async run() {
    this.running = true;
    try {
      while (this.level < k_levels.done && !this.paused && this.page.ready()) {
        const version = this.version, moving = this.moving();
        const begin = performance.now();
        if (moving) {
          await this.draw(true);
          if (version === this.version) await this.pause(begin);
          continue;
        }
        if (this.level === k_levels.quick) {
          await this.draw(false);
          if (version === this.version)
            this.level = this.is_fine() ? k_levels.done : k_levels.whole;
          continue;
        }
        // Input from the hand comes first.
        const woken = new Promise((resolve) => {
          this.wake = resolve;
        });
        await Promise.race([this.draw_finely(version), woken]);
        this.wake = null;
        if (version === this.version) this.level = k_levels.done;
      }
    } catch (error) {
      // One message only: another attempt would fail too.
      this.level = k_levels.done;
      this.page.failed(error);
    }
    this.running = false;
    if (this.level === k_levels.done) {
      for (const resolve of this.idle_waiters.splice(0)) resolve();
    }
  }
  // Nothing new to draw: wait for the screen's next frame, at most until the stone rests.
  pause(begin) {
    const version = this.version;
    return new Promise((resolve) => {
      const look = () => {
        if (version !== this.version || !this.moving() || performance.now() - begin > 1000)
          resolve();
        else
          setTimeout(look, 15);
      };
      setTimeout(look, 5);
    });
  }

  // Tells the engine stone and scene if it does not know them.
  async prepare(stone, settings) {
    const held = this.page.engine_stone(stone), info = this.page.info;
    const key = JSON.stringify([held, settings, this.page.scene_version]);
    if (key === this.set_key) return;
    this.set_key = "";
    const answer = await this.page.engine.call("set", {stone: held, settings});
    if (this.page.info !== info) return;
    this.set_key = key;
    this.page.took_settings(answer);
  }
  // Returns nothing if the page shows something else by now, or beams refuse the scene.
  ask(stone, settings, call, args) {
    const info = this.page.info;
    return this.page.engine.in_turn(async () => {
      if (this.page.info !== info || !info) return null;
      await this.prepare(stone, settings);
      if (this.page.info !== info || this.page.refused) return null;
      return this.page.engine.call(call, args);
    });
  }

  // Quick frames and the first whole picture: three wavelengths, a crystal's waves merged, short
  // paths.
  settings(stone) {
    const settings = this.page.settings(stone), values = this.page.state.values;
    if (!values.wavelengths) settings.push(`render.wavelengths=${toml_list(wavelengths_nm(3))}`);
    if (!values.depth) settings.push(`render.depth=${k_quick_depth}`);
    return [...settings, 'render.crystal_beams="merged"'];
  }
  // Nothing finer comes after the GPU's samples.
  is_fine() { return this.page.gpu.shown; }

  async draw_finely(version) {
    const page = this.page, info = page.info;
    await new Promise((resolve) => setTimeout(resolve, k_fine_ms));
    if (version !== this.version || page.info !== info || page.refused) return;
    const [width, height] = page.picture.size(1);
    const rounds = page.drawn_by_rays ? k_ray_rounds : ["beams"];
    for (const [round, engine] of rounds.entries()) {
      let drawn;
      try {
        drawn = await page.fine.draw(this.sides(), width, height, engine);
      } catch (error) {
        if (version === this.version) page.failed(error);
      }
      if (!drawn || version !== this.version || page.info !== info) return;
      for (const [side, picture] of drawn) page.picture.take(picture, side);
      this.milliseconds.beams = drawn.reduce((sum, [, picture]) => sum + picture.milliseconds, 0);
      page.show_picture();
      page.drawn(false, round + 1 < rounds.length);
    }
  }

  sides() {
    return this.page.state.get("compare") === "one" ? [["left", this.page.shown_index()]]
                                                    : [["left", 0], ["right", 1]];
  }

  async draw(quick) {
    const page = this.page, info = page.info;
    const sides = this.sides();
    // By rays a large picture takes seconds, and the hand would have to wait.
    const rays = page.drawn_by_rays, rest_scale = rays ? Math.min(1, 2.5 * this.scale) : 1;
    const [width, height] = page.picture.size(quick ? this.scale : rest_scale);
    let spent = 0, shading = 0, exposure = null;
    for (const [side, stone] of sides) {
      const settings = this.settings(stone);
      await page.engine.in_turn(() => page.info === info && this.prepare(stone, settings));
      if (page.info !== info) return;  // another stone was opened meanwhile
      if (page.refused) return page.show_refused();
      // Two stones side by side get the same exposure.
      if (side === "left") exposure = await this.expose(stone, settings);
      if (!exposure || page.info !== info) return;
      if (side === "left" && page.gpu.wanted()) {
        await page.gpu.draw(settings, width, height, quick, exposure);
        if (page.info !== info) return;
        if (page.gpu.drew) return page.drawn(quick);
      }
      const drawn = await this.ask(stone, settings, "draw", {
        ...page.drawing(stone, width, height),
        engine: quick || page.drawn_by_rays ? "preview" : "beams",
        exposure,
        tonemap: page.tonemap(),
      });
      if (!drawn || page.info !== info) return;
      spent += drawn.milliseconds;
      shading += drawn.milliseconds - (drawn.build_ms || 0);
      page.picture.take(drawn, side);
    }
    if (sides.length === 1) page.picture.pictures.delete("right");
    this.milliseconds[quick ? "preview" : "whole"] = spent;
    if (quick) this.adapt(spent, shading);
    page.show_picture();
    page.drawn(quick, !quick);
  }

  // The exposure of every picture. It is measured on a small one of the first view: turning the
  // stone then changes its brightness as before the eye, and stopping changes nothing.
  async expose(stone, settings) {
    const page = this.page, own = page.exposure();
    if (own !== "auto") return own;
    const exposed = JSON.stringify([page.engine_stone(stone), settings, page.scene_version]);
    if (exposed === this.exposed) return this.exposure;
    const [width, height] = page.picture.size(), scale = Math.min(1, 200 / Math.max(width, height));
    const drawn = await this.ask(stone, settings, "draw", {
      ...page.drawing(stone, Math.ceil(width * scale), Math.ceil(height * scale),
        {turn: page.home(), zoom: 1, pan: page.base.pan}),
      turn: Turn.matrix(Turn.none),
      engine: "preview",
      quick: false,  // whatever was drawn before: a link shows the same
      exposure: "auto",
      tonemap: "none",
    });
    if (!drawn) return null;
    this.exposed = exposed;
    return this.exposure = drawn.exposure;
  }

  // For the time before the duration of a frame is known.
  start_coarsely() {
    if (this.milliseconds.preview === undefined) this.scale = k_least_ray_scale;
  }

  // Fewer pixels shorten only the shading: if beams alone take too long, coarser frames would not
  // help.
  adapt(milliseconds, shading) {
    const rays = this.page.drawn_by_rays, frame_ms = rays ? k_ray_ms : k_quick_ms;
    const least = rays ? k_least_ray_scale : k_least_scale;
    const left = Math.max(frame_ms / 2, frame_ms - (milliseconds - shading));
    const wanted = this.scale * Math.sqrt(left / Math.max(1, shading));
    this.scale = Math.min(1, Math.max(least, 0.7 * this.scale + 0.3 * wanted));
  }
}
