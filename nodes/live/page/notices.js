// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What the page says above the scene: "banner" (the connection), "error", and a notice that fades.
import { byId } from "./elements.js";

const NOTICE_MS = 4000;

export function say(id, text) {
  byId(id).textContent = text;
  byId(id).hidden = text === "";
}

let noticeTimer = 0;

// A short line that fades.
export function notice(text) {
  say("notice", text);
  byId("notice").classList.remove("fading");
  clearTimeout(noticeTimer);
  noticeTimer = setTimeout(() => byId("notice").classList.add("fading"), NOTICE_MS);
}

