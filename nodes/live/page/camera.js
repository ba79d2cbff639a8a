// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A camera that orbits a target. Angles are in radians, lengths in metres, coordinates relative to the
// scene's origin.
import { add, dot, multiply, norm, orthogonalTo, pointAlong, quantile, scale, sub, transform } from "./vectors.js";

const FIELD_OF_VIEW = (45 * Math.PI) / 180;
const VIEWS = { top: [-90, 90], front: [-90, 0], side: [0, 0], iso: [-125, 32] }; // yaw and pitch, degrees

export class Camera {
  constructor() {
    this.target = [0, 0, 0];
    this.distance = 50;
    this.radius = 50; // radius of the scene, for the depth range
    this.width = 1;
    this.height = 1;
    this.setUp([0, 0, 1]);
    this.look("iso");
  }

  setUp(up) {
    this.up = scale(up, 1 / (norm(up) || 1));
    this.level = orthogonalTo(this.up);
  }

  look(view) {
    [this.yaw, this.pitch] = VIEWS[view].map((degrees) => (degrees * Math.PI) / 180);
  }

  // Returns unit vectors to the right in the picture, up in the picture, and from the target to the eye.
  axes() {
    const [e1, e2] = this.level;
    const [cosine, sine] = [Math.cos(this.yaw), Math.sin(this.yaw)];
    const right = add(scale(e1, -sine), scale(e2, cosine));
    const out = add(scale(e1, cosine), scale(e2, sine));
    const back = add(scale(out, Math.cos(this.pitch)), scale(this.up, Math.sin(this.pitch)));
    const upward = add(scale(this.up, Math.cos(this.pitch)), scale(out, -Math.sin(this.pitch)));
    return { right, upward, back };
  }

  eye() {
    return pointAlong(this.target, this.axes().back, this.distance);
  }

  // Returns the matrix from scene coordinates to clip coordinates.
  matrix() {
    const { right, upward, back } = this.axes();
    const eye = this.eye();
    const view = [0, 1, 2].flatMap((k) => [right[k], upward[k], back[k], 0]);
    view.push(-dot(right, eye), -dot(upward, eye), -dot(back, eye), 1);
    const focal = 1 / Math.tan(FIELD_OF_VIEW / 2);
    const near = Math.max(this.distance - 3 * this.radius, this.distance / 50);
    const far = this.distance + 4 * this.radius;
    const depth = [(near + far) / (near - far), (2 * near * far) / (near - far)];
    const lens = [(focal * this.height) / this.width, 0, 0, 0, 0, focal, 0, 0, 0, 0, depth[0], -1, 0, 0, depth[1], 0];
    return multiply(lens, view);
  }

  // Returns a point's position in the canvas, in pixels from the upper left corner. If the point is behind
  // the eye, returns null.
  project(p, matrix = this.matrix()) {
    const [x, y, , w] = transform(matrix, p);
    return w > 0 ? [((x / w + 1) * this.width) / 2, ((1 - y / w) * this.height) / 2] : null;
  }

  // Returns the ray through a pixel, with a unit direction.
  ray(px, py) {
    const { right, upward, back } = this.axes();
    const half = Math.tan(FIELD_OF_VIEW / 2);
    const x = ((2 * px) / this.width - 1) * half * (this.width / this.height);
    const y = (1 - (2 * py) / this.height) * half;
    const direction = sub(add(scale(right, x), scale(upward, y)), back);
    return { from: this.eye(), direction: scale(direction, 1 / norm(direction)) };
  }

  // Returns the size of a pixel at a distance from the eye, metres.
  pixelSize(distance = this.distance) {
    return (2 * Math.tan(FIELD_OF_VIEW / 2) * distance) / this.height;
  }

  orbit(dx, dy) {
    this.yaw -= dx * 0.006;
    this.pitch = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, this.pitch + dy * 0.006));
  }

  pan(dx, dy) {
    const { right, upward } = this.axes();
    const step = this.pixelSize();
    this.target = add(this.target, add(scale(right, -dx * step), scale(upward, dy * step)));
  }

  // Zooms about the pixel (px, py). The point that this pixel shows at the target's depth does not move in
  // the picture.
  zoom(factor, px, py) {
    const next = Math.min(1e7, Math.max(0.01, this.distance * factor));
    const { right, upward } = this.axes();
    const step = this.pixelSize() * (1 - next / this.distance);
    const shifted = pointAlong(this.target, right, (px - this.width / 2) * step);
    this.target = pointAlong(shifted, upward, (this.height / 2 - py) * step);
    this.distance = next;
  }

  // Fits the points between their 1st and 99th percentile along each axis into the picture, without rotating
  // the camera.
  fit(points) {
    if (points.length === 0) return;
    const sorted = [0, 1, 2].map((k) => points.map((p) => p[k]).sort((a, b) => a - b));
    const low = sorted.map((values) => quantile(values, 0.01));
    const high = sorted.map((values) => quantile(values, 0.99));
    this.target = scale(add(low, high), 0.5);
    this.radius = Math.max(0.05, norm(sub(high, low)) / 2);
    const corners = Array.from({ length: 8 }, (_, bits) => low.map((x, k) => ((bits >> k) & 1 ? high[k] : x)));
    this.distance = this.distanceFor(corners);
  }

  // Returns the smallest distance from the eye to the target at which all corners are in the picture, with a
  // margin of 5 %.
  distanceFor(corners) {
    const { right, upward, back } = this.axes();
    const half = Math.tan(FIELD_OF_VIEW / 2) * 0.95;
    const wide = (half * this.width) / this.height;
    return corners.reduce((distance, corner) => {
      const p = sub(corner, this.target);
      const needed = Math.max(Math.abs(dot(p, right)) / wide, Math.abs(dot(p, upward)) / half);
      return Math.max(distance, dot(p, back) + needed);
    }, 0.05);
  }
}
