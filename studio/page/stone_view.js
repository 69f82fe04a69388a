// The stone drawn from two sides; facets answer to rows and to the pointer.

class StoneView {
  /** `choose` is called with a facet's name when a person chooses it. */
  constructor(place, choose) {
    this.place = place;
    this.choose = choose;
    this.facets = new Map();
    this.lit = [];
    this.wanted = [];
  }

  show(drawing) {
    this.facets.clear();
    this.place.replaceChildren(...drawing.views.filter((view) => view.svg).map((view) => {
      const figure = made("figure");
      // The program's own drawing, in which it escapes names.
      figure.innerHTML = view.svg;
      figure.querySelectorAll(".facet").forEach((facet, i) => {
        const name = view.facets[i];
        if (!this.facets.has(name)) this.facets.set(name, []);
        this.facets.get(name).push(facet);
        facet.setAttribute("tabindex", "-1");
        facet.addEventListener("click", () => this.choose(name));
      });
      figure.append(made("figcaption", {}, view.caption));
      return figure;
    }));
    this.mark();
  }

  about(name) {
    const facets = this.facets.get(name);
    return facets ? facets[0].getAttribute("aria-label") : name;
  }

  light(names) { this.lit = names; this.mark(); }
  want(names) { this.wanted = names; this.mark(); }

  mark() {
    for (const [name, facets] of this.facets) {
      for (const facet of facets) {
        facet.classList.toggle("lit", this.lit.includes(name));
        facet.classList.toggle("wanted", this.wanted.includes(name));
        if (this.lit.includes(name)) facet.parentNode.append(facet);  // over its neighbours' lines
      }
    }
    // Names and marks stay above.
    for (const svg of this.place.querySelectorAll("svg")) svg.append(...svg.querySelectorAll(":scope > .mark, :scope > .leaders, :scope > .names, :scope > .led"));
  }
}

/** A ramp of the colours with its ticks, or nothing. */
function legend_of(drawing) {
  if (!drawing.gradient) return [];
  const ramp = made("div", {class: "ramp"});
  ramp.style.background = drawing.gradient;
  const ticks = made("div", {class: "ticks"}, ...drawing.ticks.map((tick) => made("span", {}, tick)));
  return [ramp, ticks, made("p", {class: "note"}, drawing.legend + (drawing.mark ? "; " + drawing.mark : "") + ".")];
}
