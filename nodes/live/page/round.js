// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Draws round volumes as meshes. A mesh of 20 x 40 quads deviates from a sphere by 0.3 % of its radius. The
// lines have a smaller deviation.
import { add, cross, orthogonalTo, scale, sub, unit } from "./vectors.js";

const STACKS = 20;
const SLICES = 40;
const CIRCLE_LINES = 48;

function angles(count) {
  return Array.from({ length: count + 1 }, (_, k) => [Math.cos((2 * Math.PI * k) / count), Math.sin((2 * Math.PI * k) / count)]);
}

const FINE = angles(CIRCLE_LINES);
const COARSE = angles(SLICES);

// Draws an arc of the ellipse center + cos*u + sin*v from point `first` to point `last`. The whole ellipse
// has points 0 to 48.
function arc(batch, center, u, v, colour, first = 0, last = CIRCLE_LINES) {
  let before = null;
  for (let k = first; k <= last; ++k) {
    const [cos, sin] = FINE[k];
    const at = add(center, add(scale(u, cos), scale(v, sin)));
    if (before) batch.line(before, at, colour);
    before = at;
  }
}

// Joins each ring of vertices with the next ring. `rings` is [{center, u, v, normal}]: u and v are the half
// axes of a ring, normal(cos, sin) returns the normal of a vertex.
function skin(batch, rings, colour) {
  const first = batch.vertices;
  for (const { center, u, v, normal } of rings) {
    for (const [cos, sin] of COARSE) {
      batch.vertex(add(center, add(scale(u, cos), scale(v, sin))), normal(cos, sin), colour);
    }
  }
  for (let ring = 0; ring + 1 < rings.length; ++ring) {
    for (let k = 0; k < SLICES; ++k) {
      const a = first + ring * (SLICES + 1) + k;
      const b = a + SLICES + 1;
      batch.triangle(a, b, a + 1);
      batch.triangle(a + 1, b, b + 1);
    }
  }
}

// Returns rings of an ellipsoid with half axes u, v, w, from the latitude `from` to the latitude `to`.
// Latitude 0 is the pole -w, latitude 1 is the pole +w.
function ellipsoidRings(center, u, v, w, from, to, count) {
  const inverse = [u, v, w].map((axis) => scale(axis, 1 / Math.max(1e-300, axis[0] ** 2 + axis[1] ** 2 + axis[2] ** 2)));
  return Array.from({ length: count + 1 }, (_, k) => {
    const angle = Math.PI * (from + ((to - from) * k) / count - 0.5);
    const [cosine, sine] = [Math.cos(angle), Math.sin(angle)];
    return {
      center: add(center, scale(w, sine)),
      u: scale(u, cosine),
      v: scale(v, cosine),
      normal: (cos, sin) =>
        unit(add(add(scale(inverse[0], cosine * cos), scale(inverse[1], cosine * sin)), scale(inverse[2], sine))),
    };
  });
}

// Draws an ellipsoid with the half axes u, v, w. Their lengths are the radii and may be zero. The lines are
// the three principal ellipses.
export function drawEllipsoid(batch, center, [u, v, w], paint) {
  arc(batch, center, u, v, paint.line);
  arc(batch, center, v, w, paint.line);
  arc(batch, center, w, u, paint.line);
  if (paint.face) skin(batch, ellipsoidRings(center, u, v, w, 0, 1, STACKS), paint.face);
}

export function drawCylinder(batch, low, high, radius, axis, paint) {
  const [u, v] = orthogonalTo(axis).map((side) => scale(side, radius));
  arc(batch, low, u, v, paint.line);
  arc(batch, high, u, v, paint.line);
  sides(batch, low, high, u, v, paint);
  if (!paint.face) return;
  const out = (cos, sin) => unit(add(scale(u, cos), scale(v, sin)));
  skin(batch, [low, high].map((center) => ({ center, u, v, normal: out })), paint.face);
  const [down, up] = [scale(unit(axis), -1), unit(axis)];
  batch.polygon(circleCorners(low, u, v), down, paint.face);
  batch.polygon(circleCorners(high, u, v), up, paint.face);
}

function circleCorners(center, u, v) {
  return COARSE.slice(0, SLICES).map(([cos, sin]) => add(center, add(scale(u, cos), scale(v, sin))));
}

function sides(batch, low, high, u, v, paint) {
  for (const side of [u, v, scale(u, -1), scale(v, -1)]) batch.line(add(low, side), add(high, side), paint.line);
}

export function drawCapsule(batch, a, b, radius, paint) {
  const axis = unit(sub(b, a));
  const isPoint = axis[0] === 0 && axis[1] === 0 && axis[2] === 0;
  const [u, v] = orthogonalTo(isPoint ? [0, 0, 1] : axis).map((side) => scale(side, radius));
  const w = scale(unit(cross(u, v)), radius);
  for (const end of [a, b]) arc(batch, end, u, v, paint.line);
  for (const side of [u, v]) {
    arc(batch, b, side, w, paint.line, 0, CIRCLE_LINES / 2);
    arc(batch, a, side, w, paint.line, CIRCLE_LINES / 2, CIRCLE_LINES);
  }
  sides(batch, a, b, u, v, paint);
  if (!paint.face) return;
  const lower = ellipsoidRings(a, u, v, w, 0, 0.5, STACKS / 2);
  const upper = ellipsoidRings(b, u, v, w, 0.5, 1, STACKS / 2);
  skin(batch, [...lower, ...upper], paint.face);
}
