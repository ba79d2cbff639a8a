// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The last frames, for stepping back: as many as fit into 64 MB. While paused none is added, so that none is lost
// that one may want to see; only a step beyond the newest takes the next frame that comes.

const MOST_BYTES = 64e6;

// JSON takes about three times its text as objects.
const bytesOf = (frame) => (frame.points?.bytes.byteLength ?? 0) + 3 * (frame.size ?? 0);

export class History {
  constructor() {
    this.frames = [];
    this.bytes = 0;
    this.place = -1; // of the frame shown
    this.paused = false;
    this.wantsNext = false;
  }

  // The frame to show now, or null: it is paused.
  arrive(frame) {
    if (this.paused && !this.wantsNext) return null;
    this.wantsNext = false;
    this.frames.push(frame);
    this.bytes += bytesOf(frame);
    while (this.bytes > MOST_BYTES && this.frames.length > 1) this.bytes -= bytesOf(this.frames.shift());
    this.place = this.frames.length - 1;
    return frame;
  }

  pause(paused) {
    this.paused = paused;
    this.wantsNext = false;
  }

  // The frame one step on (1) or back (-1), or null: there is none, or none yet.
  step(by) {
    this.paused = true;
    if (by > 0 && this.place === this.frames.length - 1) {
      this.wantsNext = true;
      return null;
    }
    const place = Math.min(this.frames.length - 1, Math.max(0, this.place + by));
    if (place === this.place) return null;
    this.place = place;
    return this.frames[place];
  }
}
