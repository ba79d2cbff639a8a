// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the volume that a ray hits. Each test returns [entry, exit] along the ray or null. Volumes are
// inflated by `pad`, the length of a few pixels, so that flat and small volumes can be hit.
import { isConvex, trianglesOf } from "./polygon.js";
import { isDrawable, SHAPES } from "./shapes.js";
import { add, cross, dot, norm, scale, sub, unit } from "./vectors.js";

// Intersects a ray with half-spaces n.p <= d. n is a unit vector, and p is relative to the ray's start.
function throughPlanes(planes, direction, pad) {
  let [entry, exit] = [-Infinity, Infinity];
  for (const { n, d } of planes) {
    const slope = dot(n, direction);
    const distance = d + pad;
    if (Math.abs(slope) < 1e-12) {
      if (distance < 0) return null;
    } else if (slope < 0) {
      entry = Math.max(entry, distance / slope);
    } else {
      exit = Math.min(exit, distance / slope);
    }
  }
  return entry <= exit ? [entry, exit] : null;
}

// Returns the interval of t in which `a * t^2 + 2 * b * t + c <= 0`, or null.
function quadratic(a, b, c) {
  const root = b * b - a * c;
  if (root < 0 || a <= 0) return null;
  return [(-b - Math.sqrt(root)) / a, (-b + Math.sqrt(root)) / a];
}

function throughSphere(center, radius, direction) {
  return quadratic(1, -dot(center, direction), dot(center, center) - radius * radius);
}

function throughEllipsoid(center, axes, radii, direction) {
  const inside = (p) => axes.map((axis, k) => dot(axis, p) / radii[k]);
  const [step, start] = [inside(direction), inside(scale(center, -1))];
  return quadratic(dot(step, step), dot(step, start), dot(start, start) - 1);
}

// Intersects a ray with an infinite cylinder. A ray parallel to the axis is completely inside or outside.
function throughTube(center, axis, radius, direction) {
  const [step, start] = [cross(direction, axis), cross(scale(center, -1), axis)];
  const excess = dot(start, start) - radius * radius;
  if (dot(step, step) < 1e-18) return excess <= 0 ? [-Infinity, Infinity] : null;
  return quadratic(dot(step, step), dot(step, start), excess);
}

const slab = (n, min, max) => [{ n, d: max }, { n: scale(n, -1), d: -min }];

function both(a, b) {
  if (!a || !b) return null;
  const [entry, exit] = [Math.max(a[0], b[0]), Math.min(a[1], b[1])];
  return entry <= exit ? [entry, exit] : null;
}

// Returns the smallest interval that contains all intervals, or null if all are null.
function union(parts) {
  const met = parts.filter(Boolean);
  return met.length === 0 ? null : [Math.min(...met.map((p) => p[0])), Math.max(...met.map((p) => p[1]))];
}

function throughCylinder(center, axis, radius, half, direction, pad) {
  const middle = dot(axis, center);
  return both(throughTube(center, axis, radius + pad, direction),
    throughPlanes(slab(axis, middle - half, middle + half), direction, pad));
}

// Intersects a ray with a prism over a convex outline.
function throughConvexPrism(v, outline, from, direction, pad) {
  const [u0, v0, h0] = v.axes.map((axis) => dot(axis, from));
  const sides = outline.flatMap(([a, b], i) => {
    const [c, d] = outline[(i + 1) % outline.length];
    const length = Math.hypot(c - a, d - b);
    if (length === 0) return [];
    const [x, y] = [(d - b) / length, (a - c) / length];
    return [{ n: add(scale(v.axes[0], x), scale(v.axes[1], y)), d: x * (a - u0) + y * (b - v0) }];
  });
  const box = [0, 1].flatMap((k) => {
    const along = outline.map((corner) => corner[k] - [u0, v0][k]);
    return slab(v.axes[k], Math.min(...along), Math.max(...along));
  });
  return throughPlanes([...sides, ...box, ...slab(v.axes[2], v.low - h0, v.high - h0)], direction, pad);
}

// The test of each shape. The arguments are: volume, start of the ray in absolute coordinates, direction of
// the ray, pad.
const TESTS = {
  aabb: (v, from, direction, pad) =>
    throughPlanes([0, 1, 2].flatMap((k) => {
      const axis = [0, 0, 0];
      axis[k] = 1;
      return slab(axis, v.min[k] - from[k], v.max[k] - from[k]);
    }), direction, pad),
  obb: (v, from, direction, pad) =>
    throughPlanes(v.axes.flatMap((axis, k) => {
      const middle = dot(axis, sub(v.center, from));
      return slab(axis, middle - v.half_extents[k], middle + v.half_extents[k]);
    }), direction, pad),
  kdop: (v, from, direction, pad) =>
    throughPlanes(v.directions.flatMap((n, i) => {
      const [length, shift] = [norm(n), dot(n, from)];
      return slab(scale(n, 1 / length), (v.min[i] - shift) / length, (v.max[i] - shift) / length);
    }), direction, pad),
  hull: (v, from, direction, pad) =>
    throughPlanes(v.planes.map((p) => {
      const length = norm(p) || 1;
      return { n: scale(p, 1 / length), d: (p[3] - dot(p, from)) / length };
    }), direction, pad),
  prism: (v, from, direction, pad) => {
    if (isConvex(v.outline)) return throughConvexPrism(v, v.outline, from, direction, pad);
    return union(trianglesOf(v.outline).map((triangle) =>
      throughConvexPrism(v, triangle.map((i) => v.outline[i]), from, direction, pad)));
  },
  sphere: (v, from, direction, pad) => throughSphere(sub(v.center, from), v.radius + pad, direction),
  ellipsoid: (v, from, direction, pad) =>
    throughEllipsoid(sub(v.center, from), v.axes, v.radii.map((r) => r + pad), direction),
  cylinder: (v, from, direction, pad) =>
    throughCylinder(sub(v.center, from), unit(v.axis), v.radius, v.half_height, direction, pad),
  capsule: (v, from, direction, pad) => {
    const [a, b] = [sub(v.a, from), sub(v.b, from)];
    const ends = [throughSphere(a, v.radius + pad, direction), throughSphere(b, v.radius + pad, direction)];
    const axis = unit(sub(b, a));
    if (norm(axis) === 0) return ends[0];
    const half = norm(sub(b, a)) / 2;
    return union([...ends, throughCylinder(scale(add(a, b), 0.5), axis, v.radius, half, direction, pad)]);
  },
};

// Returns the cluster whose volume the ray hits first. If the ray enters other volumes before it leaves the
// first one, returns the cluster of the smallest of all these volumes, the first one included. Returns null
// if the ray hits no volume. `from` is in absolute coordinates. padAt(distance) returns the pad at a distance
// from the eye.
export function pickCluster(clusters, hidden, from, direction, padAt) {
  const met = [];
  for (const cluster of clusters) {
    for (const volume of cluster.volumes) {
      if (!isDrawable(volume) || hidden.has(volume.method)) continue;
      const pad = padAt(norm(sub(SHAPES[volume.shape].center(volume), from)));
      const span = TESTS[volume.shape](volume, from, direction, pad);
      if (span && span[1] > 0) met.push({ cluster, entry: Math.max(0, span[0]), exit: span[1], size: volume.volume });
    }
  }
  if (met.length === 0) return null;
  const first = met.reduce((a, b) => (b.entry < a.entry ? b : a));
  const rivals = met.filter((other) => other.entry <= first.exit);
  return rivals.reduce((a, b) => (b.size < a.size ? b : a)).cluster;
}
