"use strict";
// Mouse, pen, fingers and wheel: turn the stone or the lights, move, zoom, point at facets and
// click on them.

const k_click_pixels = 4;

class Hand {
  constructor(page, surface) {
    this.page = page;
    this.surface = surface;
    this.pointers = new Map();
    this.gesture = null;
    surface.addEventListener("pointerdown", (event) => this.down(event));
    surface.addEventListener("pointermove", (event) => this.move(event));
    surface.addEventListener("pointerup", (event) => this.up(event));
    surface.addEventListener("pointercancel", (event) => this.up(event));
    surface.addEventListener("pointerleave", () => page.pointing.point_at(null));
    surface.addEventListener("wheel", (event) => this.wheel(event), {passive: false});
    surface.addEventListener("contextmenu", (event) => event.preventDefault());
    surface.addEventListener("dblclick", () => page.ready() && page.motion.look("home"));
  }

  place(event) {
    const box = this.surface.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }
  // In radii of the ball around the stone, y up.
  on_ball([x, y]) {
    const {middle, radius} = this.page.ball();
    return [(x - middle[0]) / radius, (middle[1] - y) / radius];
  }

  down(event) {
    if (!this.page.ready()) return;
    if (event.button > 0 && event.pointerType === "mouse" && event.button !== 2) return;
    this.surface.setPointerCapture(event.pointerId);
    const at = this.place(event);
    this.pointers.set(event.pointerId, at);
    this.page.motion.stop();
    if (this.pointers.size === 1) {
      const pan = event.shiftKey || event.button === 2;
      this.begin(pan ? "pan" : this.page.hand_turns_light ? "light" : "turn", at);
      this.gesture.first = at;
      this.gesture.click = event.button === 0 && !event.shiftKey;
    } else {
      this.begin("pinch", this.middle());
      this.gesture.apart = this.apart();
    }
  }
  begin(kind, at) {
    const view = this.page.view();
    this.gesture = {
      kind,
      at,
      turn: view.turn,
      pan: view.pan.slice(),
      zoom: view.zoom,
      light_turn: this.page.state.get("light_turn"),
      first: at,
      click: false,
      trail: [],
    };
  }
  middle() {
    const [a, b] = [...this.pointers.values()];
    return [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  }
  apart() {
    const [a, b] = [...this.pointers.values()];
    return Math.max(10, Math.hypot(a[0] - b[0], a[1] - b[1]));
  }

  move(event) {
    const at = this.place(event);
    if (!this.pointers.has(event.pointerId)) {
      if (event.pointerType !== "touch") this.page.pointing.point_at(at);
      return;
    }
    this.pointers.set(event.pointerId, at);
    const gesture = this.gesture;
    if (!gesture) return;
    if (gesture.click &&
      Math.hypot(at[0] - gesture.first[0], at[1] - gesture.first[1]) < k_click_pixels)
      return;
    gesture.click = false;
    if (gesture.kind === "pinch") {
      this.page.motion.zoom_about(this.middle(), gesture, this.apart() / gesture.apart);
    } else if (gesture.kind === "pan") {
      this.page.motion.pan_by(gesture, at[0] - gesture.at[0], at[1] - gesture.at[1]);
    } else {
      const drag = Turn.drag(this.on_ball(gesture.at), this.on_ball(at));
      if (gesture.kind === "light")
        this.page.motion.turn_light(gesture, drag);
      else
        this.page.motion.turn_to(Turn.after(drag, gesture.turn));
      gesture.trail.push([performance.now(), drag]);
    }
  }

  up(event) {
    if (!this.pointers.delete(event.pointerId)) return;
    const gesture = this.gesture;
    this.gesture = null;
    if (this.pointers.size === 1) {
      // One finger remains: it turns from where it is.
      this.begin("turn", [...this.pointers.values()][0]);
      return;
    }
    if (!gesture || this.pointers.size > 0 || event.type === "pointercancel") return;
    if (gesture.click)
      this.page.pointing.click(this.place(event));
    else if (gesture.kind === "turn")
      this.page.motion.let_go(this.speed(gesture));
  }
  // Rotation speed at release: axis times radians per millisecond.
  speed(gesture) {
    const now = performance.now(), trail = gesture.trail.filter(([time]) => now - time < 90);
    if (trail.length < 2) return [0, 0, 0];
    const [first, last] = [trail[0], trail[trail.length - 1]];
    const q = Turn.after(last[1], Turn.inverse(first[1])), span = Math.max(8, last[0] - first[0]);
    const angle = 2 * Math.atan2(Math.hypot(q[0], q[1], q[2]), q[3]);
    return Turn.unit([q[0], q[1], q[2]]).map((v) => v * angle / span);
  }

  wheel(event) {
    event.preventDefault();
    if (!this.page.ready()) return;
    const lines = event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 100 : 1;
    const view = this.page.view();
    const at = this.place(event);
    this.page.motion.zoom_about(at, {at, zoom: view.zoom, pan: view.pan.slice()},
      Math.exp(-event.deltaY * lines * (event.ctrlKey ? 0.01 : 0.0015)));
  }
}
