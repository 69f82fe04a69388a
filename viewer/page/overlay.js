"use strict";
// Drawn over the picture: facets by their fit, a wireframe, names, the facet under the pointer, a
// light path's facets. In CSS pixels of the stage.

class Overlay {
  constructor(page, svg) {
    this.page = page;
    this.svg = svg;
    this.pointed = null;  // index of a facet
    this.path = [];       // names of a light path's facets, in the order of the eye's ray
    this.path_at = null;  // where the eye looks, in CSS pixels
  }

  draw() {
    const page = this.page, values = page.state.values;
    const box = page.stage.getBoundingClientRect();
    this.svg.setAttribute("viewBox", `0 0 ${box.width} ${box.height}`);
    const made = [];
    const sides = values.compare === "split"
      ? [[0, `inset(0 ${100 - values.divider}% 0 0)`], [1, `inset(0 0 0 ${values.divider}%)`]]
      : [[page.shown_index(), null]];
    for (const [index, clip] of sides) {
      const stone = page.stones[index];
      if (!stone) continue;
      const group = svg_element("g", {class: "facets"});
      // Covers the whole stage, whatever is in the group.
      if (clip) group.style.clipPath = clip;
      group.append(svg_element("rect", {width: box.width, height: box.height, class: "nothing"}));
      this.facets_of(stone, group, page.base, page.view(), box);
      made.push(group);
    }
    this.svg.replaceChildren(...made);
  }

  facets_of(stone, group, base, view, box) {
    const values = this.page.state.values;
    const polygons = stone.polygons(base, view, box.width, box.height);
    const coloured = values.facets !== "none" && stone.has_fit()
      ? facet_colours(stone.facets, values.facets).facets
      : null;
    const text_of = (points) => points.map((p) => p.map((v) => v.toFixed(1)).join(",")).join(" ");
    for (const {facet, points} of polygons) {
      const own = coloured && coloured[facet.index];
      if (!own && !values.wire) continue;
      const polygon = svg_element("polygon", {
        points: text_of(points),
        class: (own ? "coloured" : "wire") + (own && own.marked ? " marked" : ""),
      });
      if (own) polygon.style.fill = own.colour;
      group.append(polygon);
    }
    for (const {facet, points} of polygons) {
      const own = coloured && coloured[facet.index];
      const words = values.names ? facet.name : own ? own.text : "";
      const room = room_in(points);
      if (!words || room < 8 + 5 * words.length * 0.9) continue;
      const [x, y] = middle_of(points);
      group.append(svg_element("text", {
        x: x.toFixed(1),
        y: y.toFixed(1),
        class: own && own.pale ? "on-pale"
          : own                ? "on-deep"
                               : "on-picture",
      },
        words));
    }
    const pointed = polygons.find(({facet}) => facet.index === this.pointed);
    if (pointed) {
      group.append(
        svg_element("polygon", {points: text_of(pointed.points), class: "pointed under"}),
        svg_element("polygon", {points: text_of(pointed.points), class: "pointed"}));
    }
    if (this.path.length) this.path_of(stone, group, base, view, box, text_of);
  }

  // Joins the light path's facets in order by a line through their middles. It shows the facets and
  // their order; real rays bend at every face.
  path_of(stone, group, base, view, box, text_of) {
    const all = stone.polygons(base, view, box.width, box.height, true);
    const met = this.path.map((name) => all.find(({facet}) => facet.name === name)).filter(Boolean);
    const drawn = new Set();
    for (const {facet, front, points} of met) {
      if (drawn.has(facet.index)) continue;
      drawn.add(facet.index);
      group.append(
        svg_element("polygon", {points: text_of(points), class: "met" + (front ? "" : " behind")}));
    }
    const stops = met.map(({points}) => middle_of(points));
    if (this.path_at && stops.length) stops[0] = this.path_at;
    group.append(svg_element("polyline", {points: text_of(stops), class: "way under"}),
      svg_element("polyline", {points: text_of(stops), class: "way"}));
    const taken = [];
    stops.forEach(([x, y], i) => {
      // The numbers of a facet that is met twice stand side by side.
      const shift = taken.filter(([a, b]) => Math.hypot(a - x, b - y) < 9).length * 20;
      taken.push([x, y]);
      group.append(svg_element("circle", {cx: x + shift, cy: y, r: 9, class: "stop"}),
        svg_element("text", {x: x + shift, y, class: "stop-number"}, String(i + 1)));
    });
  }
}
