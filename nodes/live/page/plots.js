// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Plots of the stages' times, the frame rate and the dropped frames over the last 200 frames.
import { byId, fixed } from "./elements.js";
import { THEMES } from "./palette.js";
import { quantile } from "./vectors.js";

const MAX_FRAMES = 200;
// The stages whose times add up to `total`, in order. `total` does not include decoding.
const STAGES = [
  ["filter", "#3fa7d6"], ["ground", "#b08a3e"], ["cluster", "#4cae6a"], ["fit", "#e0894a"], ["track", "#a77bd8"],
];

export class Plots {
  constructor() {
    this.frames = []; // {ms, arrived, dropped}
    this.dropped = 0;
    this.lastSeq = null;
    byId("stage-legend").replaceChildren(...STAGES.map(([name, colour]) => {
      const item = Object.assign(document.createElement("span"), { textContent: name });
      item.style.setProperty("--swatch", colour);
      return item;
    }));
  }

  // Adds a frame. A gap in `seq` is treated as dropped frames.
  add(report, now) {
    const gap = this.lastSeq !== null && report.seq > this.lastSeq + 1 ? report.seq - this.lastSeq - 1 : 0;
    const dropped = gap + (report.error ? 1 : 0);
    this.lastSeq = report.seq ?? this.lastSeq;
    this.dropped += dropped;
    this.frames.push({ ms: report.ms ?? {}, arrived: now, dropped });
    if (this.frames.length > MAX_FRAMES) this.frames.shift();
  }

  // Must be called for a new connection, whose first `seq` can be any number.
  restart() {
    this.lastSeq = null;
  }

  rate() {
    const last = this.frames.slice(-21);
    const seconds = last.length > 1 ? (last.at(-1).arrived - last[0].arrived) / 1000 : 0;
    return seconds > 0 ? (last.length - 1) / seconds : 0;
  }

  draw(theme, notDrawn) {
    const totals = this.frames.map(({ ms }) => ms.total).filter(Number.isFinite).sort((a, b) => a - b);
    const maxMs = Math.max(1e-3, 1.15 * quantile(totals, 0.99));
    byId("total-text").textContent =
      `total p50 ${fixed(quantile(totals, 0.5), 1)} ms, p99 ${fixed(quantile(totals, 0.99), 1)} ms`;
    byId("rate-text").textContent = `${fixed(this.rate(), 1)} frames/s`;
    byId("drop-text").textContent = `dropped ${this.dropped}, not drawn ${notDrawn}`;
    this.onCanvas("stage-plot", (context, wide, high) => this.drawStages(context, wide, high, maxMs));
    this.onCanvas("rate-plot", (context, wide, high) => this.drawRate(context, wide, high, theme));
    this.onCanvas("drop-plot", (context, wide, high) => this.drawDrops(context, wide, high, theme));
  }

  onCanvas(id, draw) {
    const canvas = byId(id);
    const ratio = window.devicePixelRatio;
    const [wide, high] = [canvas.clientWidth, canvas.clientHeight];
    if (wide === 0) return;
    canvas.width = Math.round(wide * ratio);
    canvas.height = Math.round(high * ratio);
    const context = canvas.getContext("2d");
    context.scale(ratio, ratio);
    draw(context, wide, high);
  }

  drawStages(context, wide, high, maxMs) {
    const step = wide / MAX_FRAMES;
    const first = wide - step * this.frames.length;
    this.frames.forEach(({ ms }, i) => {
      let base = high;
      for (const [stage, colour] of STAGES) {
        const tall = Number.isFinite(ms[stage]) ? (ms[stage] / maxMs) * high : 0;
        context.fillStyle = colour;
        context.fillRect(first + i * step, base - tall, Math.max(1, step), tall);
        base -= tall;
      }
    });
  }

  drawRate(context, wide, high, theme) {
    const rates = this.frames.slice(1).map((frame, i) => 1000 / Math.max(1, frame.arrived - this.frames[i].arrived));
    const maxRate = 1.2 * Math.max(1, quantile([...rates].sort((a, b) => a - b), 0.95));
    const step = wide / MAX_FRAMES;
    context.strokeStyle = THEMES[theme].dim;
    context.lineWidth = 1.25;
    context.beginPath();
    rates.forEach((rate, i) =>
      context.lineTo(wide - step * (rates.length - i - 0.5), high - Math.min(1, rate / maxRate) * (high - 1)));
    context.stroke();
  }

  drawDrops(context, wide, high, theme) {
    const step = wide / MAX_FRAMES;
    context.fillStyle = THEMES[theme].dim;
    context.globalAlpha = 0.4;
    context.fillRect(0, high - 1, wide, 1);
    context.globalAlpha = 1;
    context.fillStyle = "#e5484d";
    this.frames.forEach(({ dropped }, i) => {
      const tall = high * Math.min(1, 0.4 + 0.15 * dropped);
      if (dropped > 0) context.fillRect(wide - step * (this.frames.length - i), high - tall, Math.max(2, step), tall);
    });
  }
}
