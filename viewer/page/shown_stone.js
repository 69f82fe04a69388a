"use strict";
// One stone of the document: its facets in space and in the picture, and its fit.

class ShownStone {
  // `stone` is as in the document: role, name, unit, vertices, facets, up, fit, ...
  constructor(stone) {
    this.stone = stone;
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
