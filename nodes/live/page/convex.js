// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Computes the faces of the polytope of half-spaces n.p <= d. The face in a plane is computed from a large
// square in this plane, which is clipped by all other half-spaces. O(planes^2 * corners). 26 planes take
// about 0.1 ms. Points within `tolerance` of a plane are treated as inside, so that flat polytopes (two
// coincident opposite planes) keep both faces.
import { add, dot, norm, orthogonalTo, pointAlong, scale, sub } from "./vectors.js";

// The clipping tolerance as a fraction of the radius.
const RELATIVE_TOLERANCE = 1e-9;

// `planes` is [{n, d}] with n of any length. `center` and `radius` are those of a ball that contains the
// polytope. Returns [{n, corners}] with one polygon for each plane that has a face. Faces of flat polytopes
// can be single points.
export function polytope(planes, center, radius) {
  const unitPlanes = planes.map(({ n, d }) => ({ n: scale(n, 1 / norm(n)), d: d / norm(n) }));
  const tolerance = RELATIVE_TOLERANCE * radius;
  const faces = [];
  for (const plane of unitPlanes) {
    let corners = squareIn(plane, center, 2 * radius);
    for (const other of unitPlanes) {
      if (other !== plane) corners = cut(corners, other, tolerance);
      if (corners.length === 0) break;
    }
    if (corners.length > 0) faces.push({ n: plane.n, corners });
  }
  return faces;
}

function squareIn({ n, d }, center, half) {
  const middle = pointAlong(center, n, d - dot(n, center));
  const [u, v] = orthogonalTo(n);
  return [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => add(middle, add(scale(u, a * half), scale(v, b * half))));
}

// Clips a polygon by a half-space (Sutherland and Hodgman 1974).
function cut(corners, { n, d }, tolerance) {
  const clipped = [];
  for (let k = 0; k < corners.length; ++k) {
    const a = corners[k];
    const b = corners[(k + 1) % corners.length];
    const heightA = dot(n, a) - d;
    const heightB = dot(n, b) - d;
    if (heightA <= tolerance) clipped.push(a);
    if (heightA > tolerance !== heightB > tolerance) {
      clipped.push(pointAlong(a, sub(b, a), Math.min(1, Math.max(0, heightA / (heightA - heightB)))));
    }
  }
  return clipped;
}

// Returns the centre and the circumradius of a parallelepiped: the intersection of the first three linearly
// independent slabs min <= direction.p <= max. Returns null if the directions do not span 3D space.
export function boundOfSlabs(directions, min, max) {
  const chosen = [];
  for (let i = 0; i < directions.length && chosen.length < 3; ++i) {
    if (independent(chosen.map((k) => directions[k]), directions[i])) chosen.push(i);
  }
  if (chosen.length < 3) return null;
  const corner = (side) => solve(chosen.map((i) => directions[i]), chosen.map((i, k) => side(i, k)));
  const center = corner((i) => (min[i] + max[i]) / 2);
  let radius = 0;
  for (let bits = 0; bits < 8; ++bits) {
    const at = corner((i, k) => ((bits >> k) & 1 ? max[i] : min[i]));
    radius = Math.max(radius, norm(sub(at, center)));
  }
  return { center, radius };
}

function determinant(a, b, c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

function independent(before, direction) {
  if (before.length === 0) return norm(direction) > 0;
  const [a, b] = before;
  const [u, v] = orthogonalTo(a);
  if (before.length === 1) return Math.hypot(dot(u, direction), dot(v, direction)) > 1e-9 * norm(direction);
  return Math.abs(determinant(a, b, direction)) > 1e-9 * norm(a) * norm(b) * norm(direction);
}

// Returns the point p with rows[k].p = values[k], by Cramer's rule.
function solve(rows, values) {
  const columns = [0, 1, 2].map((c) => rows.map((row) => row[c]));
  const whole = determinant(...columns);
  return [0, 1, 2].map((c) => determinant(...columns.map((column, k) => (k === c ? values : column))) / whole);
}
