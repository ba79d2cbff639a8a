// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Builds the scene of a frame: volumes, velocity arrows and a grid on the ground, in coordinates relative to
// an origin.
import { LINE_BYTES, LINE_CORNERS, packColour } from "./batch.js";
import { objectColour, THEMES } from "./palette.js";
import { centerOf, drawVolume, isDrawable } from "./shapes.js";
import { add, cross, dot, norm, pointAlong, scale, sub, unit } from "./vectors.js";

const FACE_ALPHA = 0.13;
const GRID_LINES = 20; // on each side of the centre
const GRID_PIECE = 4; // length of the pieces of a line, in grid steps; each piece has one opacity
const LINE_WORDS = (LINE_CORNERS * LINE_BYTES) / 4;

// Returns an origin near the point. Coordinates over 4096 m are rounded to a multiple of 1024 m, because
// float32 represents these multiples exactly up to 1.7e10 m. Smaller coordinates become 0.
export function originNear(point) {
  return point.map((x) => (Math.abs(x) > 4096 ? 1024 * Math.round(x / 1024) : 0));
}

export function speedOf(cluster) {
  return Array.isArray(cluster.velocity) ? norm(cluster.velocity) : 0;
}

// Fills the batch with the volumes of a frame. Returns {cluster, colour, low, high, center, top} for each
// cluster with a visible volume. `low` and `high` are the corners, and `center` is the centre, of the
// axis-aligned box of the drawn lines. `top` is the point above the centre at the height of the highest line.
export function buildVolumes(batch, report, view, origin, up) {
  batch.clear();
  const objects = [];
  for (const cluster of report.clusters) {
    const isPicked = view.picked !== null && keyOf(cluster) === view.picked;
    const colour = objectColour(cluster, view.mode, view.theme);
    const lineColour = isPicked ? THEMES[view.theme].picked : colour;
    const paint = {
      line: packColour(lineColour, isPicked ? 1 : 0.9),
      face: view.faces ? packColour(colour, FACE_ALPHA * (isPicked ? 1.6 : 1)) : 0,
    };
    const first = batch.lines;
    for (const volume of cluster.volumes) {
      if (isDrawable(volume) && !view.hidden.has(volume.method)) drawVolume(batch, volume, origin, paint);
    }
    if (batch.lines === first) continue;
    const object = { cluster, colour, ...boundOfLines(batch, first, up) };
    objects.push(object);
    if (view.arrows) drawArrow(batch, object, packColour(lineColour, 1), up);
  }
  return objects;
}

// Returns the key that identifies an object over frames: its track or, without a track, its cluster id.
export function keyOf(cluster) {
  return typeof cluster.track === "number" ? `track ${cluster.track}` : `cluster ${cluster.id}`;
}

function boundOfLines(batch, first, up) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  let topmost = -Infinity;
  for (let line = first; line < batch.lines; ++line) {
    for (let end = 0; end < 2; ++end) {
      const at = LINE_WORDS * line + 3 * end;
      let height = 0;
      for (let k = 0; k < 3; ++k) {
        const x = batch.lineFloats[at + k];
        low[k] = Math.min(low[k], x);
        high[k] = Math.max(high[k], x);
        height += x * up[k];
      }
      topmost = Math.max(topmost, height);
    }
  }
  const center = scale(add(low, high), 0.5);
  return { low, high, center, top: pointAlong(center, up, topmost - dot(center, up)) };
}

// Draws the distance moved in one second as an arrow.
function drawArrow(batch, { cluster, center }, colour, up) {
  const speed = speedOf(cluster);
  if (!cluster.moving || !(speed > 0.05)) return;
  const tip = add(center, cluster.velocity);
  const direction = unit(cluster.velocity);
  const side = unit(cross(up, direction));
  const head = Math.min(0.6, 0.35 * speed);
  const back = pointAlong(tip, direction, -head);
  batch.line(center, tip, colour);
  batch.line(tip, pointAlong(back, side, 0.5 * head), colour);
  batch.line(tip, pointAlong(back, side, -0.5 * head), colour);
}

// Builds a square grid around `center`. The spacing is 1, 2 or 5 times a power of ten, in metres. Lines fade
// outwards.
export function buildGrid(batch, center, radius, camera, theme) {
  batch.clear();
  const step = niceStep(radius / 8);
  const [e1, e2] = camera.level;
  const snap = (axis) => step * Math.round(dot(center, axis) / step);
  const middle = pointAlong(pointAlong(scale(camera.up, dot(center, camera.up)), e1, snap(e1)), e2, snap(e2));
  for (let k = -GRID_LINES; k <= GRID_LINES; ++k) {
    for (let j = -GRID_LINES; j < GRID_LINES; j += GRID_PIECE) {
      const fade = 1 - Math.hypot(k, j + GRID_PIECE / 2) / GRID_LINES;
      if (fade <= 0) continue;
      const colour = packColour(THEMES[theme].grid, 0.28 * fade);
      for (const [a, b] of [[e1, e2], [e2, e1]]) {
        const from = pointAlong(pointAlong(middle, a, k * step), b, j * step);
        batch.line(from, pointAlong(from, b, GRID_PIECE * step), colour);
      }
    }
  }
}

export function niceStep(length) {
  const power = 10 ** Math.floor(Math.log10(length));
  const part = length / power;
  return power * (part < 1.5 ? 1 : part < 3.5 ? 2 : part < 7.5 ? 5 : 10);
}

// Returns the centre of a cluster's first drawable volume in scene coordinates. If there is none, returns
// null.
export function middleOfCluster(cluster, origin) {
  const volume = cluster.volumes.find(isDrawable);
  return volume ? sub(centerOf(volume), origin) : null;
}
