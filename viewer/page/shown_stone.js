"use strict";
// One stone of the document: its facets in space and in the picture, and its fit.

const k_mm = {um: 1e-3, mm: 1, cm: 10, m: 1000};

// A file's name as a stone's: "round-brilliant.obj" is "Round brilliant".
function stone_title(name) {
  const bare = name.replace(/\.(obj|asc|gem|gcs|stl|ply|off|glb|toml)$/i, "");
  if (!/^[a-z0-9]+([-_][a-z0-9]+)*$/.test(bare)) return bare;
  return bare[0].toUpperCase() + bare.slice(1).replace(/[-_]/g, " ");
}

class ShownStone {
  // `stone` is as in the document: role, name, unit, vertices, facets, up, fit, ...; `summary` is
  // what the engine says of it.
  constructor(stone, summary) {
    this.stone = stone;
    this.dimensions = summary && summary.dimensions;
    this.up = stone.up || [0, 0, 1];
    this.facets = stone.facets.map((facet, index) => ({
      index,
      name: facet.name,
      normal: facet.normal,
      points:
        facet.corners.map((corner) => Array.isArray(corner) ? corner : stone.vertices[corner]),
      fit: stone.fit ? stone.fit[index] : null,
    }));
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (const {points} of this.facets) {
      for (const point of points) {
        point.forEach((v, i) => {
          low[i] = Math.min(low[i], v);
          high[i] = Math.max(high[i], v);
        });
      }
    }
    this.center = low.map((v, i) => (v + high[i]) / 2);
    this.radius = 0;
    for (const {points} of this.facets) {
      for (const p of points)
        this.radius = Math.max(this.radius, Turn.length(Turn.add(p, this.center, -1)));
    }
    this.by_name = new Map(this.facets.map((facet) => [facet.name, facet]));
  }

  // In degrees, from the fit if there is one, else from the plane; no azimuth for level facets.
  angles_of(facet) {
    const n = Turn.unit(facet.normal), up = Turn.unit(this.up);
    const cosine = Math.max(-1, Math.min(1, Turn.dot(n, up)));
    const fit = facet.fit || {};
    const inclination = fit.inclination_deg ?? Math.acos(Math.abs(cosine)) * 180 / Math.PI;
    const level = Math.abs(cosine) > 1 - 1e-9;
    const azimuth =
      level ? null : fit.azimuth_deg ?? (Math.atan2(n[1], n[0]) * 180 / Math.PI + 360) % 360;
    return {
      inclination,
      azimuth,
      side: level        ? (cosine > 0 ? "table" : "culet")
        : cosine > 0.02  ? "crown"
        : cosine < -0.02 ? "pavilion"
                         : "girdle"
    };
  }

  // Length, width and depth; empty where the file has no unit.
  size() {
    const mm = k_mm[this.stone.unit];
    if (!mm || !this.dimensions) return "";
    const {length, width, depth} = this.dimensions;
    return [length, width, depth].map((side) => (side * mm).toFixed(2)).join(" \u00d7 ") + " mm";
  }
  weight(density_g_cm3) {
    const mm = k_mm[this.stone.unit];
    if (!mm || !density_g_cm3) return "";
    let volume = 0;
    for (const {points: [first, ...rest]} of this.facets) {
      for (let i = 1; i < rest.length; ++i)
        volume += Turn.dot(first, Turn.cross(rest[i - 1], rest[i])) / 6;
    }
    return (volume * mm ** 3 * density_g_cm3 / 200).toFixed(2) + " ct";  // 0.2 g a carat
  }
  // Depth and table as shares of the width, for a stone that lies face up.
  proportions() {
    if (!this.dimensions || Turn.unit(this.up)[2] < 0.999) return "";
    const {length, width, depth} = this.dimensions, across = length < width ? 0 : 1;
    const least = Math.min(length, width), shares = [["depth", depth]];
    const table = this.facets.find((facet) => this.angles_of(facet).side === "table");
    if (table) {
      const at = table.points.map((point) => point[across]);
      shares.unshift(["table", Math.max(...at) - Math.min(...at)]);
    }
    return shares.map(([name, of]) => `${name} ${(100 * of / least).toFixed(0)} %`).join(", ");
  }

  // The facets that face the eye (with `all`, every facet), as polygons in pixels.
  polygons(base, view, width, height, all = false) {
    const project = projection_of(base, view, base.center, width, height);
    return this.facets
      .map((facet) =>
             ({facet, front: faces_eye(base, view, base.center, facet.normal, facet.points[0])}))
      .filter(({front}) => front || all)
      .map(({facet, front}) => ({facet, front, points: facet.points.map(project)}));
  }

  has_fit() { return this.facets.some((facet) => facet.fit); }
}

// A polygon's middle, and its room for a word: the shorter side of its box.
function middle_of(points) {
  let area = 0, x = 0, y = 0;
  points.forEach(([ax, ay], i) => {
    const [bx, by] = points[(i + 1) % points.length], cross = ax * by - bx * ay;
    area += cross;
    x += (ax + bx) * cross;
    y += (ay + by) * cross;
  });
  return Math.abs(area) > 1e-9 ? [x / (3 * area), y / (3 * area)] : points[0].slice();
}
function room_in(points) {
  const xs = points.map((p) => p[0]), ys = points.map((p) => p[1]);
  return Math.min(Math.max(...xs) - Math.min(...xs), Math.max(...ys) - Math.min(...ys));
}
