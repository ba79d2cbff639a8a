// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Stores the last frames for stepping back, as many as fit into 64 MB. While paused, arriving frames are not
// stored, because old frames would have to be removed for them. After a step forward from the newest frame,
// the next frame that arrives is stored and shown.

const MAX_BYTES = 64e6;

// Parsed JSON takes about three times the memory of its text.
const bytesOf = (frame) => (frame.points?.bytes.byteLength ?? 0) + 3 * (frame.size ?? 0);

export class History {
  constructor() {
    this.frames = [];
    this.bytes = 0;
    this.shownIndex = -1; // index of the frame that is shown
    this.paused = false;
    this.showNext = false;
  }

  // Stores a frame and returns it to be shown. While paused, returns null.
  arrive(frame) {
    if (this.paused && !this.showNext) return null;
    this.showNext = false;
    this.frames.push(frame);
    this.bytes += bytesOf(frame);
    while (this.bytes > MAX_BYTES && this.frames.length > 1) this.bytes -= bytesOf(this.frames.shift());
    this.shownIndex = this.frames.length - 1;
    return frame;
  }

  pause(paused) {
    this.paused = paused;
    this.showNext = false;
  }

  // Pauses and steps forward (1) or back (-1). Returns the frame to show, or null if there is none.
  step(by) {
    this.paused = true;
    if (by > 0 && this.shownIndex === this.frames.length - 1) {
      this.showNext = true;
      return null;
    }
    const index = Math.min(this.frames.length - 1, Math.max(0, this.shownIndex + by));
    if (index === this.shownIndex) return null;
    this.shownIndex = index;
    return this.frames[index];
  }
}
