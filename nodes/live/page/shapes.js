// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Draws the volumes of a JSON report as lines and faces. SHAPES has an entry for each shape: draw() adds the
// volume to a batch, center() returns its centre, and size() returns a text with its dimensions. `o` is the
// origin of the scene. It is subtracted in double precision before the conversion to float32, so that large
// coordinates (UTM) lose no precision.
import { boundOfSlabs, polytope } from "./convex.js";
import { isConvex, trianglesOf } from "./polygon.js";
import { drawCapsule, drawCylinder, drawEllipsoid } from "./round.js";
import { add, cross, dot, norm, pointAlong, scale, sub, unit } from "./vectors.js";

const CUBE_FACES = [[0, 2, 6, 4], [1, 3, 7, 5], [0, 1, 5, 4], [2, 3, 7, 6], [0, 1, 3, 2], [4, 5, 7, 6]];

function drawBox(batch, center, halfAxes, paint) {
  const corners = Array.from({ length: 8 }, (_, bits) =>
    halfAxes.reduce((at, axis, k) => pointAlong(at, axis, (bits >> k) & 1 ? 1 : -1), center));
  for (let bits = 0; bits < 8; ++bits) {
    for (let k = 0; k < 3; ++k) {
      if (!((bits >> k) & 1)) batch.line(corners[bits], corners[bits | (1 << k)], paint.line);
    }
  }
  if (!paint.face) return;
  // In a flat box one half axis is zero. Its direction is then the cross product of the other two half axes.
  const normals = [[0, 1, 2], [1, 2, 0], [2, 0, 1]].map(([k, i, j]) =>
    unit(norm(halfAxes[k]) > 0 ? halfAxes[k] : cross(halfAxes[i], halfAxes[j])));
  CUBE_FACES.forEach((face, k) => batch.polygon(face.map((bits) => corners[bits]), normals[k >> 1], paint.face));
}

// Draws polygons. An edge between two polygons is drawn twice at the same position. Where more than three
// planes meet, rounding causes edges of nearly zero length, which are omitted. If all edges are omitted, a
// point is drawn.
function drawPolygons(batch, faces, paint) {
  const before = batch.lines;
  const corners = faces.flatMap((face) => face.corners);
  const minLength = 1e-6 * corners.reduce((max, p) => Math.max(max, norm(sub(p, corners[0]))), 0);
  for (const { n, corners: around } of faces) {
    around.forEach((corner, k) => {
      const next = around[(k + 1) % around.length];
      if (norm(sub(next, corner)) > minLength) batch.line(corner, next, paint.line);
    });
    if (paint.face && around.length > 2) batch.polygon(around, n, paint.face);
  }
  if (batch.lines === before && corners.length > 0) batch.line(corners[0], corners[0], paint.line);
}

function slabPlanes({ directions, min, max }, o) {
  return directions.flatMap((n, i) => [
    { n, d: max[i] - dot(n, o) },
    { n: scale(n, -1), d: dot(n, o) - min[i] },
  ]);
}

function boundOfKdop(v, o) {
  const shift = v.directions.map((n) => dot(n, o));
  return boundOfSlabs(v.directions, v.min.map((x, i) => x - shift[i]), v.max.map((x, i) => x - shift[i]));
}

function drawKdop(batch, v, o, paint) {
  const bound = boundOfKdop(v, o);
  if (!bound) return;
  const faces = bound.radius > 0 ? polytope(slabPlanes(v, o), bound.center, bound.radius) : [];
  const point = [{ n: [0, 0, 1], corners: [bound.center] }];
  drawPolygons(batch, faces.length > 0 ? faces : point, paint);
}

// The faces of a hull are triangles, and a flat side consists of several triangles. Edges inside a flat side
// are omitted.
function drawHull(batch, v, o, paint) {
  const at = v.vertices.map((p) => sub(p, o));
  const faces = v.faces.map((face) => ({ face, n: unit(normalOf(face.map((i) => at[i]))) }));
  if (faces.length === 0) return drawPolygons(batch, flatOutline(at), paint);
  const normals = new Map();
  for (const { face, n } of faces) {
    face.forEach((a, k) => {
      const b = face[(k + 1) % face.length];
      const key = a < b ? `${a} ${b}` : `${b} ${a}`;
      const other = normals.get(key);
      if (!other) normals.set(key, n);
      else if (dot(other, n) < 1 - 1e-6) batch.line(at[a], at[b], paint.line);
    });
    if (paint.face) batch.polygon(face.map((i) => at[i]), n, paint.face);
  }
}

function normalOf([a, b, c]) {
  return cross(sub(b, a), sub(c, a));
}

// Returns the outline of a hull without faces: a polygon, a line or a point.
function flatOutline(at) {
  if (at.length === 0) return [];
  const farthest = (distance) => at.reduce((best, p) => (distance(p) > distance(best) ? p : best));
  const a = farthest((p) => norm(sub(p, at[0])));
  const b = farthest((p) => norm(sub(p, a)));
  const axis = unit(sub(b, a));
  const fromLine = (p) => norm(cross(axis, sub(p, a)));
  const c = farthest(fromLine);
  if (fromLine(c) <= 1e-9 * norm(sub(b, a))) return [{ n: [0, 0, 1], corners: [a, b] }];
  const n = unit(cross(axis, sub(c, a)));
  const side = cross(n, axis);
  const middle = scale(at.reduce(add), 1 / at.length);
  const angle = (p) => Math.atan2(dot(sub(p, middle), side), dot(sub(p, middle), axis));
  return [{ n, corners: [...at].sort((p, q) => angle(p) - angle(q)) }];
}

// Returns the corners of a prism at a height, relative to the origin. `origin` is subtracted in the prism's own
// axes, in which the outline is stored.
function ringOf({ axes, outline }, height, origin) {
  const from = axes.map((axis) => dot(axis, origin));
  return outline.map(([u, v]) => {
    const at = [u - from[0], v - from[1], height - from[2]];
    return axes.reduce((p, axis, k) => pointAlong(p, axis, at[k]), [0, 0, 0]);
  });
}

function drawPrism(batch, v, o, paint) {
  const [low, high] = [ringOf(v, v.low, o), ringOf(v, v.high, o)];
  const sides = low.map((corner, i) => {
    const next = (i + 1) % low.length;
    const [along, across] = [v.outline[next][0] - v.outline[i][0], v.outline[next][1] - v.outline[i][1]];
    const n = unit(add(scale(v.axes[0], across), scale(v.axes[1], -along)));
    return { n, corners: [corner, low[next], high[next], high[i]] };
  });
  const down = scale(v.axes[2], -1);
  if (isConvex(v.outline)) {
    const ends = [{ n: down, corners: low.slice().reverse() }, { n: v.axes[2], corners: high }];
    drawPolygons(batch, [...sides, ...ends], paint);
    return;
  }
  drawPolygons(batch, sides, paint);
  if (!paint.face) return;
  for (const triangle of trianglesOf(v.outline)) {
    batch.polygon(triangle.map((i) => low[i]).reverse(), down, paint.face);
    batch.polygon(triangle.map((i) => high[i]), v.axes[2], paint.face);
  }
}

const meters = (x) => Number(x.toPrecision(4)).toString();
const product = (sizes) => `${sizes.map(meters).join(" × ")} m`;
const middleOf = (a, b) => scale(add(a, b), 0.5);

export const SHAPES = {
  aabb: {
    center: (v) => middleOf(v.min, v.max),
    size: (v) => product(sub(v.max, v.min)),
    draw: (batch, v, o, paint) => {
      const half = scale(sub(v.max, v.min), 0.5);
      drawBox(batch, sub(middleOf(v.min, v.max), o), [[half[0], 0, 0], [0, half[1], 0], [0, 0, half[2]]], paint);
    },
  },
  obb: {
    center: (v) => v.center,
    size: (v) => product(v.half_extents.map((half) => 2 * half)),
    draw: (batch, v, o, paint) =>
      drawBox(batch, sub(v.center, o), v.axes.map((axis, k) => scale(axis, v.half_extents[k])), paint),
  },
  kdop: {
    center: (v) => boundOfKdop(v, [0, 0, 0])?.center ?? [0, 0, 0],
    size: (v) => product(v.directions.slice(0, 3).map((n, i) => (v.max[i] - v.min[i]) / norm(n))),
    draw: drawKdop,
  },
  sphere: {
    center: (v) => v.center,
    size: (v) => `radius ${meters(v.radius)} m`,
    draw: (batch, v, o, paint) =>
      drawEllipsoid(batch, sub(v.center, o), [[v.radius, 0, 0], [0, v.radius, 0], [0, 0, v.radius]], paint),
  },
  ellipsoid: {
    center: (v) => v.center,
    size: (v) => `radii ${product(v.radii)}`,
    draw: (batch, v, o, paint) =>
      drawEllipsoid(batch, sub(v.center, o), v.axes.map((axis, k) => scale(axis, v.radii[k])), paint),
  },
  cylinder: {
    center: (v) => v.center,
    size: (v) => `radius ${meters(v.radius)} m, height ${meters(2 * v.half_height)} m`,
    draw: (batch, v, o, paint) => {
      const center = sub(v.center, o);
      const axis = unit(v.axis);
      const [low, high] = [-1, 1].map((end) => pointAlong(center, axis, end * v.half_height));
      drawCylinder(batch, low, high, v.radius, axis, paint);
    },
  },
  capsule: {
    center: (v) => middleOf(v.a, v.b),
    size: (v) => `radius ${meters(v.radius)} m, length ${meters(norm(sub(v.b, v.a)) + 2 * v.radius)} m`,
    draw: (batch, v, o, paint) => drawCapsule(batch, sub(v.a, o), sub(v.b, o), v.radius, paint),
  },
  prism: {
    center: (v) => scale([...ringOf(v, v.low, [0, 0, 0]), ...ringOf(v, v.high, [0, 0, 0])].reduce(add),
      0.5 / v.outline.length),
    size: (v) => `${v.outline.length} corners, height ${meters(v.high - v.low)} m`,
    draw: drawPrism,
  },
  hull: {
    center: (v) => (v.vertices.length > 0 ? scale(v.vertices.reduce(add), 1 / v.vertices.length) : [0, 0, 0]),
    size: (v) => `${v.vertices.length} vertices`,
    draw: drawHull,
  },
};

// Returns false for empty volumes and failed fits, which have no parameters, and for unknown shapes.
export function isDrawable(volume) {
  return !volume.empty && volume.failed === undefined && Object.hasOwn(SHAPES, volume.shape);
}

export const centerOf = (volume) => SHAPES[volume.shape].center(volume);
export const sizeOf = (volume) => SHAPES[volume.shape].size(volume);
export const drawVolume = (batch, volume, origin, paint) => SHAPES[volume.shape].draw(batch, volume, origin, paint);
