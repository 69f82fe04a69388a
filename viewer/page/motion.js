"use strict";
// Changes of the view: by hand, by keys, between named views.

function less_motion() { return matchMedia("(prefers-reduced-motion: reduce)").matches; }

class Motion {
  constructor(page) {
    this.page = page;
    this.frame = 0;  // requested from the browser
    this.keeps_turning = false;
  }

  turn_to(turn) {
    this.page.loop.last_move = performance.now();
    this.page.state.set({turn}, "hand");
  }
  turn_light(gesture, drag) {
    const before = this.page.state.get("lights_with") === "stone" ? gesture.turn : this.page.home();
    const turn = Turn.after(Turn.inverse(before), Turn.after(drag, before));
    this.page.loop.last_move = performance.now();
    this.page.state.set({light_turn: Turn.after(turn, gesture.light_turn)}, "hand");
  }
  pan_by(gesture, x, y) {
    const {scale} = this.page.ball();
    this.page.loop.last_move = performance.now();
    this.page.state.set({pan: [gesture.pan[0] + x / scale, gesture.pan[1] - y / scale]}, "hand");
  }
  // `at` stays in place; `from`: {at, zoom, pan} at the start of the gesture.
  zoom_about(at, from, factor) {
    const box = this.page.stage.getBoundingClientRect();
    const zoom = Math.min(50, Math.max(0.2, from.zoom * factor));
    const unit = (point, z) => {
      const scale = box.height / 2 / half_height_of(this.page.base, z, box.width, box.height);
      return [(point[0] - box.width / 2) / scale, (box.height / 2 - point[1]) / scale];
    };
    const before = unit(from.at, from.zoom), after = unit(at, zoom);
    this.page.loop.last_move = performance.now();
    this.page.state.set(
      {zoom, pan: [0, 1].map((i) => after[i] - (before[i] - from.pan[i]))}, "hand");
  }
  zoom_by(factor) {
    const box = this.page.stage.getBoundingClientRect(), {zoom, pan} = this.page.view();
    const at = [box.width / 2, box.height / 2];
    this.zoom_about(at, {at, zoom, pan}, factor);
  }
  // A control is dragged: quick frames until it rests.
  slide(changes) {
    this.page.loop.last_move = performance.now();
    this.page.state.set(changes);
  }

  // On opening, a small circle in the light shows the stone's life, until something is touched. A
  // stone that is drawn by rays would be coarse all that time.
  turn_slowly() {
    if (this.was_shown || less_motion() || this.page.document_stone().convex === false) return;
    this.was_shown = true;
    const from = this.page.view().turn, begin = performance.now();
    const touches = ["pointerdown", "keydown", "wheel", "drop"];
    const touched = () => {
      for (const touch of touches) removeEventListener(touch, touched, true);
      this.stop();
    };
    for (const touch of touches) addEventListener(touch, touched, true);
    const step = () => {
      const seconds = (performance.now() - begin) / 1000, around = seconds * 2 * Math.PI / 12;
      const tilt = 0.22 * Math.min(1, seconds / 3);  // 13 degrees
      this.turn_to(Turn.after(Turn.about([Math.cos(around), Math.sin(around), 0], tilt), from));
      this.frame = requestAnimationFrame(step);
    };
    this.frame = requestAnimationFrame(step);
  }
  stop() {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
  }
  go_to(turn) {
    this.stop();
    // Home has no turn of its own: it depends on the light.
    const end = Turn.apart(turn, this.page.home()) < 1e-9 ? null : turn;
    const from = this.page.view().turn, way = Turn.after(turn, Turn.inverse(from));
    const sign = way[3] < 0 ? -1 : 1, angle = Turn.apart(turn, from);
    if (less_motion() || angle < 1e-4) {
      this.page.state.set({turn: end});
      return;
    }
    const axis = way.slice(0, 3).map((v) => sign * v), begin = performance.now(), lasts = 260;
    const step = () => {
      const t = Math.min(1, (performance.now() - begin) / lasts), eased = t * t * (3 - 2 * t);
      if (t < 1) {
        this.turn_to(Turn.after(Turn.about(axis, angle * eased), from));
        this.frame = requestAnimationFrame(step);
      } else {
        this.page.state.set({turn: end});
      }
    };
    this.frame = requestAnimationFrame(step);
  }
  // After a drag: `speed` is axis times radians per millisecond.
  let_go(speed) {
    const fast = Turn.length(speed);
    if (!this.keeps_turning || less_motion() || fast < 1e-4) return;
    let last = performance.now(), now_fast = fast;
    const step = () => {
      const now = performance.now();
      now_fast *= Math.exp((last - now) / 900);
      this.turn_to(Turn.after(Turn.about(speed, now_fast * (now - last)), this.page.view().turn));
      last = now;
      this.frame = now_fast > 2e-5 ? requestAnimationFrame(step) : 0;
    };
    this.frame = requestAnimationFrame(step);
  }
  look(name) {
    if (name === "home") this.page.state.set({zoom: 1, pan: null});
    this.go_to(name === "home"
        ? this.page.home()
        : named_view(name, this.page.shown_stone().up, Turn.back(this.page.base.home, [0, 1, 0])));
  }
}
