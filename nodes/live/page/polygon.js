// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Simple polygons in the plane, as lists of counter-clockwise corners [u, v].

// Returns twice the area of a triangle. It is positive if c is to the left of the line from a to b.
function turn(a, b, c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

export function isConvex(corners) {
  const count = corners.length;
  return corners.every((b, i) => turn(corners[(i + count - 1) % count], b, corners[(i + 1) % count]) >= 0);
}

// Divides a polygon into triangles by ear clipping (Meisters 1975). Returns triples of positions. Rounding
// can hide all ears of a very thin remaining polygon; it is then divided from its first corner.
export function trianglesOf(corners) {
  const left = corners.map((_, i) => i);
  const isEar = (k) => {
    const [i, j, next] = [left[(k + left.length - 1) % left.length], left[k], left[(k + 1) % left.length]];
    const [a, b, c] = [corners[i], corners[j], corners[next]];
    if (turn(a, b, c) <= 0) return false;
    return left.every((other) => {
      if (other === i || other === j || other === next) return true;
      const p = corners[other];
      return turn(a, b, p) < 0 || turn(b, c, p) < 0 || turn(c, a, p) < 0;
    });
  };
  const triangles = [];
  let [k, misses] = [0, 0];
  while (left.length > 3 && misses < left.length) {
    k %= left.length;
    if (!isEar(k)) {
      ++k;
      ++misses;
      continue;
    }
    triangles.push([left[(k + left.length - 1) % left.length], left[k], left[(k + 1) % left.length]]);
    left.splice(k, 1);
    misses = 0;
  }
  for (let i = 2; i < left.length; ++i) triangles.push([left[0], left[i - 1], left[i]]);
  return triangles;
}
