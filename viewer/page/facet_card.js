"use strict";
// Shows what is known about the facet under the pointer.

function with_sigma(value, sigma) {
  if (!Number.isFinite(sigma) || sigma <= 0) return value.toFixed(2) + "\u00b0";
  // The uncertainty with two digits, the value with as many decimals.
  const digits = Math.min(6, Math.max(0, 1 - Math.floor(Math.log10(sigma))));
  return value.toFixed(digits) + "\u00b0 \u00b1 " + sigma.toFixed(digits) + "\u00b0";
}

class FacetCard {
  constructor(page, card) {
    this.page = page;
    this.card = card;
  }

  show(stone, index) {
    const facet = stone && index !== null ? stone.facets[index] : null;
    this.card.hidden = !facet;
    if (!facet) return;
    const {inclination, azimuth, side} = stone.angles_of(facet);
    const fit = facet.fit || {};
    const rows = [
      ["Inclination", with_sigma(inclination, fit.inclination_sigma_deg)],
      [
        "Azimuth",
        azimuth === null ? "none: it is level" : with_sigma(azimuth, fit.azimuth_sigma_deg)
      ],
    ];
    if (Number.isFinite(fit.direction_sigma_deg)) {
      rows.push(["Direction", "\u00b1 " + significant(fit.direction_sigma_deg, 2) + "\u00b0"]);
    }
    if (facet.fit) {
      rows.push([
        "Worst reading",
        fit.reading && Number.isFinite(fit.residual)
          ? `${fit.reading}, ${Math.abs(fit.residual).toFixed(1)} times its \u00b1 off`
          : "none speaks of it"
      ]);
      if (fit.readings > 1) rows.push(["Readings", String(fit.readings)]);
    }
    const warnings = [];
    if (fit.suspect) warnings.push("\u26a0 has a suspect reading");
    if (fit.determined === false) warnings.push("\u26a0 left open by the readings");
    this.card.replaceChildren(element("h2", {}, facet.name, element("small", {}, side)),
      element("dl", {}, ...rows.map(([name,
        value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value)))),
      ...warnings.map((line) => element("p", {class: "warning"}, line)));
  }
}
