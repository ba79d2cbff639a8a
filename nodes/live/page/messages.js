// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Parses messages: CDR of sensor_msgs/msg/PointCloud2, JSON of frames, and the frame inside a static page.
//
// Points are {bytes, count, stride, intensity, origin}. `bytes` is passed to WebGL unchanged. It has for each
// point x, y, z as float32, the label as uint32 and, if `intensity` is true, the intensity as float32.
// Coordinates are relative to `origin`.

const FLOAT32 = 7;
const UINT32 = 6;

// Reads little-endian CDR. Alignment is relative to the end of the encapsulation header (four bytes).
class CdrReader {
  constructor(view) {
    this.view = view;
    this.at = 4;
    if (view.byteLength < 4 || view.getUint8(1) !== 1) throw new Error("points are not little-endian CDR");
  }

  u8() {
    return this.view.getUint8(this.at++);
  }

  u32() {
    this.at += (4 - (this.at % 4)) % 4;
    this.at += 4;
    return this.view.getUint32(this.at - 4, true);
  }

  bytes(count) {
    if (count > this.view.byteLength - this.at) throw new Error("a message of points is cut off");
    this.at += count;
    return new Uint8Array(this.view.buffer, this.view.byteOffset + this.at - count, count);
  }

  text() {
    return new TextDecoder().decode(this.bytes(this.u32())).replace(/\0$/, "");
  }
}

export function readPointCloud2(view) {
  const reader = new CdrReader(view);
  reader.u32(); // skip the stamp, which is also in the header of the message
  reader.u32();
  reader.text();
  const count = reader.u32() * reader.u32();
  const fields = new Map();
  for (let left = reader.u32(); left > 0; --left) {
    const name = reader.text();
    fields.set(name, { offset: reader.u32(), type: reader.u8(), count: reader.u32() });
  }
  const bigEndian = reader.u8() !== 0;
  const stride = reader.u32();
  reader.u32();
  const bytes = reader.bytes(reader.u32());
  const has = (name, offset, type) => fields.get(name)?.offset === offset && fields.get(name)?.type === type;
  const known = ["x", "y", "z"].every((name, k) => has(name, 4 * k, FLOAT32)) && has("label", 12, UINT32);
  if (bigEndian || !known) throw new Error("points have other fields than x, y, z and label");
  if (stride < 16 || stride % 4 !== 0 || count * stride > bytes.length) {
    throw new Error("the cloud has fewer points than its header states");
  }
  return { bytes, count, stride, intensity: has("intensity", 16, FLOAT32), origin: [0, 0, 0] };
}

// Uses Uint8Array.fromBase64() if the browser has it (since 2025), because it takes a tenth of atob()'s time.
function bytesOfBase64(text) {
  return Uint8Array.fromBase64?.(text) ?? Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
}

// Parses the frame in `<script id="data">`. Returns null in a live page.
export function readStaticFrame(element) {
  if (!element) return null;
  const data = JSON.parse(element.textContent);
  const bytes = bytesOfBase64(data.points);
  const count = Math.floor(bytes.length / data.stride);
  return {
    report: data.report,
    stamp: "",
    points: { bytes, count, stride: data.stride, intensity: data.stride >= 20, origin: data.origin },
    origin: data.origin,
    up: data.up ?? [0, 0, 1],
    shown: data.shown ?? count,
    of: data.of ?? count,
  };
}

// Parses a frame from a line of JSON. The stamp is returned as text, because it has more digits than a number
// can hold.
export function readFrame(view) {
  const text = new TextDecoder().decode(view);
  const report = JSON.parse(text);
  report.clusters ??= [];
  return { report, stamp: /"stamp_ns":\s*(-?\d+)/.exec(text)?.[1] ?? "", points: null, size: text.length };
}

// Returns a sample of at most `max` points, evenly spaced by index, each [x, y, z, intensity]. Skips points
// that are not finite.
export function samplePoints({ bytes, count, stride, intensity }, max) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const step = Math.max(1, Math.ceil(count / max));
  const sample = [];
  for (let i = 0; i < count; i += step) {
    const at = i * stride;
    const value = (offset) => view.getFloat32(at + offset, true);
    const point = [value(0), value(4), value(8), intensity ? value(16) : 0];
    if (point.every(Number.isFinite)) sample.push(point);
  }
  return sample;
}
