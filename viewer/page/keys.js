"use strict";
// The keyboard, and the overlay that lists its keys.

const k_keys = [
  ["Arrows", "turn the stone (with Ctrl a little)"],
  ["Shift + arrows", "move the picture"],
  ["+ and \u2212", "larger, smaller"],
  ["T, P, S", "table up, pavilion up, from the side"],
  ["Home", "as it was"],
  ["N, Shift + N", "next facet, facet before"],
  ["Enter", "light path of that facet"],
  ["L", "drag and arrows turn the light instead"],
  ["W", "facet edges"],
  ["B", "catalogue against fitted: blink"],
  ["Page up, Page down", "stone before, next stone"],
  ["F", "full screen"],
  ["?", "this help"],
  ["Esc", "close, put away the light path"],
];
const k_gestures = [
  ["Drag", "turns the stone: the point under the pointer stays there"],
  ["Wheel, pinch", "larger, smaller"],
  ["Shift-drag, two fingers", "move the picture"],
  ["Click a flash", "the light path that makes it"],
  ["Point", "the facet\u2019s name and angles"],
];

class Keys {
  constructor(page, surface, dialog) {
    this.page = page;
    this.dialog = dialog;
    this.build();
    surface.addEventListener("keydown", (event) => this.on_stone(event));
    document.addEventListener("keydown", (event) => this.anywhere(event));
  }

  build() {
    const rows = (list) => element("dl", {},
      ...list.flatMap(([key, what]) => [element("dt", {}, key), element("dd", {}, what)]));
    this.dialog.append(element("form", {method: "dialog"},
                         element("button", {class: "close", "aria-label": "Close"}, "\u00d7")),
      element("h2", {id: "help-title"}, "Hand and keys"), rows(k_gestures),
      element("h3", {}, "Keys"), rows(k_keys),
      element("p", {class: "note"},
        "Everything is computed on this page by culet\u2019s own engine; nothing leaves it. Made by culet " +
          (this.page.document.version || "") + "."));
    this.dialog.addEventListener("click", (event) => {
      if (event.target === this.dialog) this.dialog.close();
    });
  }
  help() {
    if (this.dialog.open)
      this.dialog.close();
    else
      this.dialog.showModal();
  }

  on_stone(event) {
    if (event.altKey || event.metaKey || !this.page.ready()) return;
    const page = this.page;
    const way = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0,
                   -1]}[event.key];
    if (way && event.shiftKey) {
      page.motion.pan_by({pan: page.view().pan, zoom: page.view().zoom}, 24 * way[0], -24 * way[1]);
    } else if (way) {
      const angle = (event.ctrlKey ? 1 : 5) * Math.PI / 180;
      const by = Turn.about([-way[1], way[0], 0], angle);
      if (page.hand_turns_light)
        page.motion.turn_light(
          {light_turn: page.state.get("light_turn"), turn: page.view().turn}, by);
      else
        page.motion.turn_to(Turn.after(by, page.view().turn));
    } else if (event.key === "Enter") {
      page.pointing.path_of_pointed();
    } else if (event.key === "n" || event.key === "N") {
      page.pointing.point_next(event.shiftKey ? -1 : 1);
    } else {
      return;
    }
    event.preventDefault();
  }

  anywhere(event) {
    if (event.altKey || event.metaKey || event.ctrlKey) return;
    if (!this.page.ready() && !["?", "f", "F", "PageUp", "PageDown"].includes(event.key)) return;
    const typing = event.target instanceof Element &&
      event.target.closest(
        "input:not([type=checkbox]):not([type=radio]):not([type=range]), textarea, select");
    if (typing || this.dialog.open && event.key !== "?") return;
    const page = this.page;
    const acts = {
      "+": () => page.motion.zoom_by(1.15),
      "=": () => page.motion.zoom_by(1.15),
      "-": () => page.motion.zoom_by(1 / 1.15),
      t: () => page.motion.look("table"),
      p: () => page.motion.look("pavilion"),
      s: () => page.motion.look("side"),
      Home: () => page.motion.look("home"),
      f: () => page.full_screen(),
      "?": () => this.help(),
      l: () => page.turn_light_by_hand(!page.hand_turns_light),
      w: () => page.state.set({wire: !page.state.get("wire")}),
      b: () => page.blink(),
      PageUp: () => page.gallery.step(-1),
      PageDown: () => page.gallery.step(1),
      Escape: () => page.put_away(),
    };
    const act = acts[event.key] || acts[event.key.toLowerCase()];
    // In a slider, Home and the page keys have their own meaning.
    const in_slider = event.target instanceof Element &&
      event.target.closest("input[type=range], [role=slider], [role=tablist]");
    if (!act || in_slider && ["Home", "PageUp", "PageDown"].includes(event.key)) return;
    if (["PageUp", "PageDown"].includes(event.key) && event.target.closest &&
      event.target.closest(".panel"))
      return;
    event.preventDefault();
    act();
  }
}
