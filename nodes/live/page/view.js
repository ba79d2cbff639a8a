// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The state of the view and its controls: buttons, check boxes and keys. on.changed(what) is called after
// each change. `what` is "colours" if the volumes must be rebuilt, or "view" if they only have to be redrawn.
import { byId, element } from "./elements.js";

const MODES = ["height", "cluster", "track", "intensity"];
const FLAGS = ["faces", "labels", "arrows", "grid"];
const POINT_SIZES = [1, 1.5, 2, 3, 4, 6];

export class View {
  // `on`: functions changed(what), look(name), fit(), follow(), pause(), step(by), panel(), escape().
  constructor(on) {
    this.on = on;
    this.mode = "cluster";
    this.modeChosen = false;
    this.offered = { height: true, cluster: true, track: false, intensity: false };
    this.theme = matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark";
    this.faces = this.labels = this.arrows = this.grid = true;
    this.hidden = new Set(); // methods whose volumes are not shown
    this.methods = new Set();
    this.pointSize = 2;
    this.picked = null; // key of the picked object
    this.following = false;
    this.connectElements();
    this.showState();
  }

  connectElements() {
    for (const input of document.getElementsByName("mode")) {
      input.addEventListener("change", () => this.setMode(input.value));
    }
    for (const flag of FLAGS) byId(`show-${flag}`).addEventListener("change", () => this.toggle(flag));
    const buttons = {
      "step-back": () => this.on.step(-1), "step-on": () => this.on.step(1), pause: this.on.pause, fit: this.on.fit,
      follow: this.on.follow, theme: () => this.toggleTheme(), help: () => this.toggleHelp(), panel: this.on.panel,
    };
    for (const [id, act] of Object.entries(buttons)) byId(id).addEventListener("click", () => act());
    document.addEventListener("keydown", (event) => this.key(event));
    matchMedia("(prefers-color-scheme: light)").addEventListener("change", (event) =>
      this.setTheme(event.matches ? "light" : "dark"));
  }

  key(event) {
    const isField = event.target.closest("input:not([type=checkbox]):not([type=radio]), select, textarea");
    if (event.ctrlKey || event.metaKey || event.altKey || (isField && event.key !== "Escape")) return;
    if (event.key === " " && event.target.closest("button, summary, input")) return;
    const radio = event.target.closest("input[type=radio]");
    if (radio && event.key.startsWith("Arrow")) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const act = this.actOf(key);
    if (!act) return;
    event.preventDefault();
    act();
  }

  actOf(key) {
    const acts = {
      0: this.on.fit, 1: () => this.on.look("top"), 2: () => this.on.look("front"), 3: () => this.on.look("side"),
      4: () => this.on.look("iso"), f: this.on.follow, " ": this.on.pause, ArrowLeft: () => this.on.step(-1),
      ArrowRight: () => this.on.step(1), c: () => this.nextMode(), l: () => this.toggle("labels"),
      v: () => this.toggle("faces"), a: () => this.toggle("arrows"), g: () => this.toggle("grid"),
      d: () => this.toggleTheme(), h: () => this.toggleHelp(), "?": () => this.toggleHelp(), p: this.on.panel,
      "+": () => this.resizePoints(1), "=": () => this.resizePoints(1), "-": () => this.resizePoints(-1),
      Escape: () => this.escape(),
    };
    return Object.hasOwn(acts, key) ? acts[key] : null;
  }

  escape() {
    document.activeElement?.blur();
    if (byId("help-text").hidden) this.on.escape();
    else this.toggleHelp();
  }

  // Enables the modes for which some frame has had data.
  offer({ tracks, intensity }) {
    this.offered.track ||= tracks;
    this.offered.intensity ||= intensity;
    for (const input of document.getElementsByName("mode")) input.disabled = !this.offered[input.value];
    if (!this.modeChosen) this.mode = this.offered.track ? "track" : "cluster";
    this.showState();
  }

  nextMode() {
    const offered = MODES.filter((mode) => this.offered[mode]);
    this.setMode(offered[(offered.indexOf(this.mode) + 1) % offered.length]);
  }

  setMode(mode) {
    this.mode = mode;
    this.modeChosen = true;
    this.changed("colours");
  }

  toggle(flag) {
    this[flag] = !this[flag];
    this.changed(flag === "faces" || flag === "arrows" ? "colours" : "view");
  }

  toggleTheme() {
    this.setTheme(this.theme === "dark" ? "light" : "dark");
  }

  setTheme(theme) {
    this.theme = theme;
    this.changed("colours");
  }

  resizePoints(by) {
    const index = POINT_SIZES.indexOf(this.pointSize) + by;
    this.pointSize = POINT_SIZES[Math.min(POINT_SIZES.length - 1, Math.max(0, index))];
    this.changed("view");
  }

  toggleHelp() {
    byId("help-text").hidden = !byId("help-text").hidden;
    byId("help").setAttribute("aria-expanded", String(!byId("help-text").hidden));
  }

  // Shows a check box for each method that has occurred, in the order of its first occurrence.
  showMethods(clusters) {
    const before = this.methods.size;
    for (const { volumes } of clusters) for (const { method } of volumes) this.methods.add(String(method));
    if (this.methods.size === before) return;
    byId("methods").replaceChildren(...[...this.methods].map((method) => {
      const box = element("input", { type: "checkbox", checked: !this.hidden.has(method) });
      box.addEventListener("change", () => {
        if (box.checked) this.hidden.delete(method);
        else this.hidden.add(method);
        this.changed("colours");
      });
      return element("label", {}, box, method);
    }));
  }

  changed(what) {
    this.showState();
    this.on.changed(what);
  }

  showState() {
    document.documentElement.dataset.theme = this.theme;
    byId("theme").textContent = this.theme === "dark" ? "Light" : "Dark";
    for (const input of document.getElementsByName("mode")) input.checked = input.value === this.mode;
    for (const flag of FLAGS) byId(`show-${flag}`).checked = this[flag];
    byId("follow").setAttribute("aria-pressed", String(this.following));
  }
}
