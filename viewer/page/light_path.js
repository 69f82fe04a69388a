"use strict";
// Which facets make the flash that was clicked: the light paths at one point of the picture, as
// `culet probe` lists them.

const k_most_paths = 6;

// The kinds of lights that `culet probe` lists (with numbers), in plain words.
const k_plain_lights = {
  constant: "the even light of the room",
  environment: "the surroundings",
  cap: "disc or ring",
  hemisphere: "half of the sky",
  sphere: "lamp",
  lamp: "lamp",
  lobe: "soft lamp",
  plane: "panel",
};
function plain_light(text) {
  if (!text) return "nothing";
  return text.split(" + ")
    .map((part) => {
      const [kind, number] = part.split(" ");
      if (!k_plain_lights[kind]) return part;
      return k_plain_lights[kind] + (number === undefined ? "" : " " + (Number(number) + 1));
    })
    .join(", ");
}

class LightPath {
  constructor(page) {
    this.page = page;
    this.chosen = 0;
    this.list = element("div", {class: "paths"});
    this.empty = element("p", {class: "note"},
      "Click a flash on the stone (or choose a facet with N and press Enter): this shows which facets made it, and which light it is.");
    this.node = group("Light path", null, this.empty, this.list);
  }

  clear() {
    this.list.replaceChildren();
    this.empty.hidden = false;
    this.page.overlay.path = [];
    this.page.overlay.path_at = null;
  }

  // `at`: CSS pixels of the stage.
  async probe(at) {
    const page = this.page, [width, height] = page.picture.size();
    const box = page.stage.getBoundingClientRect();
    const stone = page.shown_index();
    const found = await page.loop.ask(stone, page.loop.settings(stone), "path", {
      ...page.drawing(stone, width, height),
      x: at[0] * width / box.width,
      y: at[1] * height / box.height,
    });
    if (!found) return;
    this.show(found, at);
  }

  show(found, at) {
    const page = this.page;
    const paths = found.paths.filter((path) => path.facets.length > 0).slice(0, k_most_paths);
    this.empty.hidden = paths.length > 0;
    if (!paths.length) {
      this.clear();
      page.say("No light path here: this point is not on the stone.");
      page.overlay.draw();
      return;
    }
    const choose = (index) => {
      page.overlay.path = paths[index].facets;
      page.overlay.path_at = at;
      for (const [i, item] of [...this.list.children].entries())
        item.setAttribute("aria-current", i === index);
      page.overlay.draw();
    };
    this.list.replaceChildren(...paths.map((path, index) => this.item(path, index, choose)));
    const rest = found.paths.length - paths.length;
    if (rest > 0)
      this.list.append(
        element("p", {class: "note"}, `and ${rest} weaker ${rest === 1 ? "path" : "paths"}`));
    choose(0);
    const first = paths[0];
    page.say(`Light path: ${first.facets.join(", ")}; sees ${plain_light(first.light)}`, true);
  }

  // `weight` is the share of the light on this path that reaches the eye.
  item(path, index, choose) {
    const share = path.weight;
    const crossed = path.facets.map((name, i) => {
      const last = i === path.facets.length - 1;
      const what = path.facets.length === 1 ? "mirrors it"
        : i === 0                           ? "in"
        : last                              ? "out"
                                            : "reflects";
      return element("li", {}, element("b", {}, name), " ", element("span", {class: "soft"}, what));
    });
    return element("div", {class: "path-item"},
      button(`${(100 * share).toFixed(share < 0.1 ? 1 : 0)} % comes this way`, () => choose(index),
        {class: "path-button", "data-path": index}),
      element("p", {class: "soft"}, "sees " + plain_light(path.light)),
      element("ol", {}, ...crossed));
  }
}
