"use strict";
// The stone at seven tilts, small: how its brightness changes when it is rocked.

const k_tilts_deg = [-30, -20, -10, 0, 10, 20, 30];

class TiltStrip {
  constructor(page, strip) {
    this.page = page;
    this.strip = strip;
    this.drawn_key = "";
    this.pictures = k_tilts_deg.map((tilt) => {
      const canvas = element("canvas", {width: 96, height: 96, "aria-hidden": "true"});
      const one = button("", () => page.motion.go_to(this.turn_at(tilt)),
        {title: `Tilt the stone by ${tilt} degrees`, "aria-label": `Tilt by ${tilt} degrees`});
      one.append(canvas, element("span", {}, (tilt > 0 ? "+" : "") + tilt + "\u00b0"));
      strip.append(one);
      return canvas;
    });
  }

  // About the picture's x as in culet grade: for positive tilts the near edge of the stone rises.
  turn_at(tilt) {
    return Turn.after(Turn.about([1, 0, 0], -tilt * Math.PI / 180), this.page.home());
  }

  // Drawn when the stone rests; unchanged pictures are not drawn again.
  async update() {
    const page = this.page, values = page.state.values;
    this.strip.hidden = !values.tilts;
    if (!values.tilts || !page.ready() || page.refused) return;
    const stone = page.shown_index(), settings = page.loop.settings(stone);
    const exposure = page.exposure_factor();
    const key = JSON.stringify([
      stone, settings, values.light_turn, values.lights_with, exposure, page.tonemap(),
      page.scene_version
    ]);
    if (key === this.drawn_key) return;
    this.drawn_key = key;
    for (const [i, tilt] of k_tilts_deg.entries()) {
      if (page.loop.moving() || this.drawn_key !== key) {
        this.drawn_key = "";
        return;
      }
      const view = {turn: this.turn_at(tilt), zoom: 1, pan: [0, 0]};
      const drawn = await page.loop.ask(stone, settings, "draw", {
        ...page.drawing(stone, 96, 96, view),
        engine: "preview",
        exposure,
        tonemap: page.tonemap(),
      });
      if (!drawn) return;
      this.pictures[i].getContext("2d").putImageData(new ImageData(drawn.pixels, 96, 96), 0, 0);
    }
  }
}
