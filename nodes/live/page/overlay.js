// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Draws the objects' labels, a scale bar and the axes on a 2D canvas over the scene.
import { cssColour, THEMES } from "./palette.js";
import { niceStep, keyOf, speedOf } from "./scene.js";
import { dot } from "./vectors.js";

const FONT = "12px system-ui, sans-serif";
const LINE_HEIGHT = 15;
const MAX_LABELS = 300;
const RAMP_PIXELS = 180;

export class Overlay {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
  }

  // `objects` is the result of buildVolumes(). `range` is the range of the colour ramp, or undefined in modes
  // without a ramp.
  draw(camera, objects, view, range, pixelRatio) {
    const context = this.context;
    context.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
    context.clearRect(0, 0, camera.width, camera.height);
    context.font = FONT;
    context.lineJoin = "round";
    if (view.labels) this.drawLabels(camera, objects, view);
    this.drawScaleBar(camera, view.theme);
    this.drawAxes(camera, view.theme);
    if (range) this.drawRamp(camera, view, range);
  }

  // Draws the legend of the colour ramp above the scale bar.
  drawRamp(camera, { mode, theme }, [low, high]) {
    const [x, y, wide] = [camera.width - 16 - RAMP_PIXELS, camera.height - 58, RAMP_PIXELS];
    const { ramp, dim } = THEMES[theme];
    const gradient = this.context.createLinearGradient(x, 0, x + wide, 0);
    for (let k = 0; k < 5; ++k) gradient.addColorStop(k / 4, cssColour(ramp.slice(3 * k, 3 * k + 3)));
    this.context.fillStyle = gradient;
    this.context.fillRect(x, y, wide, 6);
    const unit = mode === "height" ? " m" : "";
    this.write(`${Number(low.toPrecision(3))}${unit}`, x, y - 5, dim, theme, "left");
    this.write(mode, x + wide / 2, y - 5, dim, theme, "center");
    this.write(`${Number(high.toPrecision(3))}${unit}`, x + wide, y - 5, dim, theme, "right");
  }

  // Draws the labels of the objects. Omits a label that would overlap an earlier label. The label of the
  // picked object is drawn first, then those of moving objects, then all others. Within each group, labels of
  // objects with more points are drawn first.
  drawLabels(camera, objects, view) {
    const matrix = camera.matrix();
    const rank = ({ cluster }) => (keyOf(cluster) === view.picked ? 1e12 : cluster.moving ? 1e9 : 0) + cluster.points;
    const taken = [];
    for (const object of [...objects].sort((a, b) => rank(b) - rank(a)).slice(0, MAX_LABELS)) {
      const text = labelOf(object.cluster);
      const at = text === "" ? null : camera.project(object.top, matrix);
      if (!at) continue;
      const half = this.context.measureText(text).width / 2 + 3;
      const box = [at[0] - half, at[1] - LINE_HEIGHT - 4, at[0] + half, at[1] - 4];
      if (box[2] < 0 || box[0] > camera.width || box[3] < 0 || box[1] > camera.height) continue;
      if (taken.some((b) => box[0] < b[2] && box[2] > b[0] && box[1] < b[3] && box[3] > b[1])) continue;
      taken.push(box);
      const isPicked = keyOf(object.cluster) === view.picked;
      this.write(text, at[0], box[3] - 4, isPicked ? THEMES[view.theme].text : cssColour(object.colour), view.theme, "center");
    }
  }

  write(text, x, y, colour, theme, align) {
    const context = this.context;
    context.textAlign = align;
    context.lineWidth = 4;
    context.strokeStyle = THEMES[theme].halo;
    context.strokeText(text, x, y);
    context.fillStyle = colour;
    context.fillText(text, x, y);
  }

  // Draws the scale bar. Its length is correct at the depth of the camera's target.
  drawScaleBar(camera, theme) {
    const length = niceStep(camera.pixelSize() * 90);
    const wide = length / camera.pixelSize();
    const [x, y] = [camera.width - 16, camera.height - 14];
    this.context.strokeStyle = THEMES[theme].dim;
    this.context.lineWidth = 1.5;
    this.context.beginPath();
    this.context.moveTo(x - wide, y - 4);
    this.context.lineTo(x - wide, y);
    this.context.lineTo(x, y);
    this.context.lineTo(x, y - 4);
    this.context.stroke();
    this.write(`${Number(length.toPrecision(1))} m`, x, y - 7, THEMES[theme].dim, theme, "right");
  }

  drawAxes(camera, theme) {
    const { right, upward, back } = camera.axes();
    const middle = [34, camera.height - 34];
    const axes = [["x", [1, 0, 0], "#e5534b"], ["y", [0, 1, 0], "#46a758"], ["z", [0, 0, 1], "#4a90e2"]];
    for (const [name, axis, colour] of axes.sort((a, b) => dot(a[1], back) - dot(b[1], back))) {
      const tip = [middle[0] + 20 * dot(axis, right), middle[1] - 20 * dot(axis, upward)];
      this.context.strokeStyle = colour;
      this.context.lineWidth = 2;
      this.context.beginPath();
      this.context.moveTo(...middle);
      this.context.lineTo(...tip);
      this.context.stroke();
      const beyond = (k) => middle[k] + 1.35 * (tip[k] - middle[k]);
      this.write(name, beyond(0), beyond(1) + 4, colour, theme, "center");
    }
  }
}

function labelOf(cluster) {
  const parts = [];
  if (typeof cluster.track === "number") parts.push(String(cluster.track));
  if (cluster.class !== undefined && cluster.class !== null) parts.push(`class ${cluster.class}`);
  if (cluster.moving) parts.push(`${speedOf(cluster).toFixed(1)} m/s`);
  return parts.join("  ");
}
