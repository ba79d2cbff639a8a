// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Collects the lines and triangles of a frame in buffers, so that WebGL draws each kind in one call.
//
// A line is drawn as a rectangle. A line has 28 bytes: 6 float32 for the two end points, and rgba. These
// bytes are stored four times, and the shader computes one corner of the rectangle from each copy. Instancing
// would need only one copy. It is not used, because software rendering takes about 15 us for each instance.
//
// A vertex of a triangle has 20 bytes: 3 float32 for the position, 4 int8 for the normal, and rgba.

export const LINE_BYTES = 28;
export const LINE_CORNERS = 4;
export const VERTEX_BYTES = 20;

export class Batch {
  constructor() {
    this.lineBytes = new ArrayBuffer(LINE_CORNERS * LINE_BYTES * 4096);
    this.vertexBytes = new ArrayBuffer(VERTEX_BYTES * 4096);
    this.indices = new Uint32Array(16384);
    this.clear();
  }

  clear() {
    this.lines = 0;
    this.vertices = 0;
    this.indexCount = 0;
    this.renewViews();
  }

  renewViews() {
    this.lineFloats = new Float32Array(this.lineBytes);
    this.lineColours = new Uint32Array(this.lineBytes);
    this.vertexFloats = new Float32Array(this.vertexBytes);
    this.vertexWords = new Uint32Array(this.vertexBytes);
  }

  // Adds a line. `colour` is a result of packColour().
  line(a, b, colour) {
    if ((this.lines + 1) * LINE_CORNERS * LINE_BYTES > this.lineBytes.byteLength) {
      this.lineBytes = enlarged(this.lineBytes);
      this.renewViews();
    }
    const words = LINE_BYTES / 4;
    const at = this.lines++ * LINE_CORNERS * words;
    this.lineFloats.set(a, at);
    this.lineFloats.set(b, at + 3);
    this.lineColours[at + 6] = colour;
    for (let corner = 1; corner < LINE_CORNERS; ++corner) this.lineColours.copyWithin(at + corner * words, at, at + words);
  }

  // Adds a vertex. Returns its index, for triangle().
  vertex(p, normal, colour) {
    if ((this.vertices + 1) * VERTEX_BYTES > this.vertexBytes.byteLength) {
      this.vertexBytes = enlarged(this.vertexBytes);
      this.renewViews();
    }
    const at = (this.vertices * VERTEX_BYTES) / 4;
    this.vertexFloats.set(p, at);
    this.vertexWords[at + 3] = packNormal(normal);
    this.vertexWords[at + 4] = colour;
    return this.vertices++;
  }

  triangle(a, b, c) {
    if (this.indexCount + 3 > this.indices.length) {
      const larger = new Uint32Array(2 * this.indices.length);
      larger.set(this.indices);
      this.indices = larger;
    }
    this.indices[this.indexCount++] = a;
    this.indices[this.indexCount++] = b;
    this.indices[this.indexCount++] = c;
  }

  // Adds a planar convex polygon with one normal.
  polygon(corners, normal, colour) {
    const first = this.vertices;
    for (const corner of corners) this.vertex(corner, normal, colour);
    for (let k = 2; k < corners.length; ++k) this.triangle(first, first + k - 1, first + k);
  }
}

function enlarged(buffer) {
  const larger = new ArrayBuffer(2 * buffer.byteLength);
  new Uint8Array(larger).set(new Uint8Array(buffer));
  return larger;
}

function packNormal(n) {
  const byte = (part) => Math.round(127 * part) & 255;
  return (byte(n[0]) | (byte(n[1]) << 8) | (byte(n[2]) << 16)) >>> 0;
}

// Packs red, green, blue and alpha (0..1) into a 32-bit word. The lowest byte is red.
export function packColour(rgb, alpha) {
  const byte = (part) => Math.round(255 * Math.min(1, Math.max(0, part)));
  return (byte(rgb[0]) | (byte(rgb[1]) << 8) | (byte(rgb[2]) << 16) | (byte(alpha) << 24)) >>> 0;
}
