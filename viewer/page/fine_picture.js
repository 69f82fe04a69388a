"use strict";
// The picture with all wavelengths and both waves of a crystal, once the stone rests. An engine in
// its own worker draws it, so that the hand never waits.

class FinePicture {
  constructor(page) {
    this.page = page;
    this.engine = new EngineClient(() => {
      this.key = "";
    });
    this.key = "";     // of what the engine holds
    this.busy = null;  // the picture that is being drawn
  }

  stop() {
    if (!this.busy) return;
    this.engine.stop("started again");
    this.key = "";
    this.busy = null;
  }

  // Opens what the page's other engine holds: the item, a changed cut, a panorama.
  async open() {
    const page = this.page, item = page.state.get("item");
    const key = JSON.stringify([item, page.scene_version]);
    if (key === this.key && this.engine.worker) return;
    if (!this.engine.worker) await this.engine.start();
    this.key = "";
    await this.engine.call("open", {document: page.document, item});
    if (page.cut_held) await this.engine.call("cut", page.cut_held);
    if (page.panorama && page.panorama_setting) {
      const bytes = new Uint8Array(await page.panorama.arrayBuffer());
      await this.engine.call("panorama", {name: page.panorama.name, bytes}, [bytes.buffer]);
    }
    this.key = key;
  }

  // Returns [side, picture] for each side, or nothing if the page has moved on. Cancels an earlier
  // drawing.
  async draw(sides, width, height, engine) {
    this.stop();
    const mine = this.busy = {};
    try {
      await this.open();
      return await this.draw_sides(sides, width, height, engine);
    } finally {
      if (this.busy === mine) this.busy = null;
    }
  }

  async draw_sides(sides, width, height, engine) {
    const page = this.page, version = page.loop.version, drawn = [];
    const late = () => page.loop.version !== version;
    for (const [side, stone] of sides) {
      if (late()) return null;
      const settings = page.settings(stone);
      const answer = await this.engine.call("set", {stone: page.engine_stone(stone), settings});
      if (late()) return null;
      page.panels.picture.took(answer);
      const picture = await this.engine.call("draw", {
        ...page.drawing(stone, width, height),
        engine,
        samples: page.drawn_by_rays ? 1 : null,
        exposure: page.exposure_factor(),
        tonemap: page.tonemap(),
      });
      drawn.push([side, picture]);
    }
    return late() ? null : drawn;
  }
}
