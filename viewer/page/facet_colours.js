"use strict";
// Colours facets as the fit report's drawings do (page/colour_maps.cpp, page/fit_paint.cpp;
// tests/viewer checks that the stops are the same).

const k_residual_stops =
  ["#ffffcc", "#ffeda0", "#fed976", "#feb24c", "#fd8d3c", "#fc4e2a", "#e31a1c", "#bd0026"];
const k_uncertainty_stops =
  ["#ffffd9", "#edf8b1", "#c7e9b4", "#7fcdbb", "#41b6c4", "#1d91c0", "#225ea8"];
const k_plain_facet = "#d9dde0";
const k_worst_shown = 4;  // sigmas: all larger residuals have the last colour

function colour_between(stops, share) {
  const at = Math.min(1, Math.max(0, share)) * (stops.length - 1);
  const cell = Math.min(Math.floor(at), stops.length - 2), part = at - cell;
  const channel = (stop, c) => parseInt(stops[stop].slice(1 + 2 * c, 3 + 2 * c), 16);
  return "rgb(" +
    [0, 1, 2]
      .map((c) => Math.round(channel(cell, c) + part * (channel(cell + 1, c) - channel(cell, c))))
      .join(",") +
    ")";
}

// The next 1, 2 or 5 times a power of ten.
function rounded_up(value) {
  const decade = Math.pow(10, Math.floor(Math.log10(value)));
  for (const step of [1, 2, 5])
    if (step * decade >= value * (1 - 1e-9)) return step * decade;
  return 10 * decade;
}

// The scale covers nine facets of ten: a few poorly determined ones would make all others look
// alike.
function top_of_sigmas(facets) {
  const known =
    facets.filter((f) => f.fit && f.fit.determined !== false && f.fit.direction_sigma_deg > 0)
      .map((f) => f.fit.direction_sigma_deg)
      .sort((a, b) => a - b);
  return known.length ? rounded_up(known[Math.floor(0.9 * (known.length - 1))]) : 1;
}

function significant(value, digits) { return String(Number(value.toPrecision(digits))); }

// {colour, text, marked} for each facet, and the legend: {what, stops, ends, mark}.
function facet_colours(facets, kind) {
  if (kind === "residual") {
    return {
      facets: facets.map(({fit}) => {
        const read = fit && Number.isFinite(fit.residual) && fit.readings !== 0;
        return {
          colour: read ? colour_between(k_residual_stops, Math.abs(fit.residual) / k_worst_shown)
                       : k_plain_facet,
          text: read ? Math.abs(fit.residual).toFixed(1) : "",
          marked: Boolean(fit && fit.suspect),
          pale: !read || Math.abs(fit.residual) < 0.7 * k_worst_shown,
        };
      }),
      legend: {
        what: "How far each facet\u2019s worst reading is off, in multiples of its \u00b1",
        stops: k_residual_stops,
        ends: ["0", "2", "4 or more"],
        plain: "grey: not read",
        mark: facets.some(({fit}) => fit && fit.suspect) ? "dashed: has a suspect reading" : "",
      },
    };
  }
  const top = top_of_sigmas(facets);
  return {
    facets: facets.map(({fit}) => {
      const sigma = fit ? fit.direction_sigma_deg : null;
      const known = Number.isFinite(sigma);
      return {
        colour: known ? colour_between(k_uncertainty_stops, sigma / top) : k_plain_facet,
        text: known ? significant(sigma, 2) : "",
        marked: Boolean(fit && fit.determined === false),
        pale: !known || sigma < 0.6 * top,
      };
    }),
    legend: {
      what: "How far a facet\u2019s direction may be off (\u00b1), degrees",
      stops: k_uncertainty_stops,
      ends: ["0", significant(top / 2, 2), significant(top, 2) + " or more"],
      plain: "grey: not known",
      mark: facets.some(({fit}) => fit && fit.determined === false)
        ? "dashed: left open by the readings"
        : "",
    },
  };
}

if (typeof module !== "undefined")
  module.exports = {facet_colours, k_residual_stops, k_uncertainty_stops};
