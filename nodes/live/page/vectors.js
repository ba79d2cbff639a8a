// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Vectors are arrays of three numbers. Matrices are arrays of 16 numbers in column-major order, as in WebGL.

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const norm = (a) => Math.hypot(a[0], a[1], a[2]);
// Returns the point at parameter t of the line through `a`.
export const pointAlong = (a, direction, t) => add(a, scale(direction, t));

export function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

// Normalizes a vector. A zero vector stays zero.
export function unit(a) {
  const length = norm(a);
  return length > 0 ? scale(a, 1 / length) : [0, 0, 0];
}

// Returns two unit vectors orthogonal to `axis` and to each other. For +z they are x and y, so that a view
// from the top has x to the right.
export function orthogonalTo(axis) {
  const w = unit(axis);
  const hint = Math.abs(w[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0];
  const u = unit(sub(hint, scale(w, dot(hint, w))));
  return [u, cross(w, u)];
}

export function multiply(a, b) {
  const product = new Float64Array(16);
  for (let column = 0; column < 4; ++column) {
    for (let row = 0; row < 4; ++row) {
      let sum = 0;
      for (let k = 0; k < 4; ++k) sum += a[4 * k + row] * b[4 * column + k];
      product[4 * column + row] = sum;
    }
  }
  return product;
}

// Transforms a point of the scene to clip coordinates [x, y, z, w].
export function transform(m, p) {
  const row = (r) => m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r];
  return [row(0), row(1), row(2), row(3)];
}

// Returns the quantile at the fraction `part` (0..1) of ascending numbers; 0 for an empty array.
export function quantile(sorted, part) {
  return sorted.length === 0 ? 0 : sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))];
}
