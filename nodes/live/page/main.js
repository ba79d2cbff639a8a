// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Starts the page and exposes its state to tests.
import { byId } from "./elements.js";
import { say } from "./notices.js";
import { Page } from "./page.js";
import { sub } from "./vectors.js";

// Defines window.pclBv for tests, with the members
//
// - `frames`: number of frames drawn;
// - `connected`;
// - `picked`: key of the picked object, "track 17" or "cluster 3";
// - project(x, y, z): position of an absolute point, in pixels of the page;
// - pick(px, py): key of the object at a position in pixels of the page;
// - `state`: the state of the page.
function exposeForTests(page) {
  const corner = () => byId("scene").getBoundingClientRect();
  window.pclBv = {
    get frames() { return page.drawn; },
    get connected() { return page.connection?.connected ?? false; },
    get picked() { return page.view.picked; },
    project(x, y, z) {
      const at = page.camera.project(sub([x, y, z], page.origin ?? [0, 0, 0]));
      return at ? [at[0] + corner().left, at[1] + corner().top] : null;
    },
    pick(px, py) { return page.keyAt(px - corner().left, py - corner().top); },
    get state() {
      const { mode, theme, faces, labels, arrows, grid, following, pointSize, hidden } = page.view;
      const { paused, shownIndex, frames } = page.history;
      return {
        mode, theme, faces, labels, arrows, grid, following, pointSize, hidden: [...hidden], paused, shownIndex,
        stored: frames.length, seq: page.frame?.report.seq ?? null, notDrawn: page.notDrawn,
        dropped: page.plots.dropped, rate: page.plots.rate(), error: byId("error").textContent,
        panel: !byId("side").hidden, objects: page.objects.length, lines: page.batch.lines,
      };
    },
  };
}

try {
  const page = new Page();
  exposeForTests(page);
  page.start();
} catch (error) {
  say("error", error.message);
  throw error;
}
