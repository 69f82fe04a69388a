"use strict";
// The facet under the pointer, and the light path of the one that is clicked.

class Pointing {
  constructor(page) { this.page = page; }

  polygons() {
    const box = this.page.stage.getBoundingClientRect();
    return this.page.shown_stone().polygons(
      this.page.base, this.page.view(), box.width, box.height);
  }
  point_at(at) {
    if (!this.page.ready()) return;
    const polygons = at ? this.polygons() : [];
    const found = at ? polygon_at(polygons.map(({points}) => points), ...at) : -1;
    this.point(found < 0 ? null : polygons[found].facet.index);
  }
  point(index) {
    if (index === this.page.overlay.pointed) return;
    this.page.overlay.pointed = index;
    this.page.card.show(this.page.shown_stone(), index);
    this.page.overlay.draw();
  }
  point_next(step) {
    const polygons = this.polygons();
    const now = polygons.findIndex(({facet}) => facet.index === this.page.overlay.pointed);
    const next = now < 0 ? (step > 0 ? 0 : polygons.length - 1)
                         : (now + step + polygons.length) % polygons.length;
    this.point(polygons[next].facet.index);
    const {facet} = polygons[next], {inclination} = this.page.shown_stone().angles_of(facet);
    this.page.say(`${facet.name}, inclination ${inclination.toFixed(2)} degrees`, true);
  }
  async click(at) {
    this.point_at(at);
    if (!this.page.ready() || this.page.refused) return;
    try {
      await this.page.light_path.probe(at);
      this.page.tabs.open("path");
    } catch (error) {
      this.page.failed(error);
    }
  }
  path_of_pointed() {
    const polygon = this.polygons().find(({facet}) => facet.index === this.page.overlay.pointed);
    if (polygon)
      this.click(middle_of(polygon.points));
    else
      this.page.say("Choose a facet first: N.");
  }
}
