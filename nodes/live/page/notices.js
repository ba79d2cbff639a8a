// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The texts of the page. The line at the top describes the frame. Above the scene are "banner" (state of the
// connection), "error", and "notice", which fades.
import { byId, countText } from "./elements.js";

const NOTICE_MS = 4000;

export function say(id, text) {
  byId(id).textContent = text;
  byId(id).hidden = text === "";
}

let noticeTimer = 0;

// Shows a short text that fades.
export function notice(text) {
  say("notice", text);
  byId("notice").classList.remove("fading");
  clearTimeout(noticeTimer);
  noticeTimer = setTimeout(() => byId("notice").classList.add("fading"), NOTICE_MS);
}

// Returns the text of the line at the top.
export function frameText({ report, stamp, shown, of }, paused) {
  const parts = [];
  if (report.file !== undefined) parts.push(String(report.file));
  if (report.frame_id !== undefined) parts.push(String(report.frame_id));
  if (report.seq !== undefined) parts.push(`frame ${report.seq}`);
  if (stamp !== "") parts.push(`${stamp.slice(0, -9) || "0"}.${stamp.slice(-9, -6).padStart(3, "0")} s`);
  parts.push(shown < of ? `${shown} of ${of} points shown` : `${countText(report.points)} points`);
  parts.push(`${report.clusters.length} objects`);
  if (paused) parts.push("paused");
  return parts.join("  ·  ");
}
