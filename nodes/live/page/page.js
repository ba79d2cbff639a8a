// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The page. Frames come from the connection or from the data in a static page. The newest frame is drawn in
// the browser's next animation frame. Nothing is drawn when nothing has changed.
import { Batch } from "./batch.js";
import { Camera } from "./camera.js";
import { Connection } from "./connection.js";
import { controlCamera } from "./controls.js";
import { byId } from "./elements.js";
import { History } from "./history.js";
import { readStaticFrame, samplePoints } from "./messages.js";
import { frameText, notice, say } from "./notices.js";
import { ObjectPanel } from "./objects.js";
import { Overlay } from "./overlay.js";
import { objectColour } from "./palette.js";
import { pickCluster } from "./picking.js";
import { Plots } from "./plots.js";
import { Renderer } from "./renderer.js";
import { buildGrid, buildVolumes, keyOf, middleOfCluster, originNear } from "./scene.js";
import { Settings } from "./settings.js";
import { centerOf, isDrawable } from "./shapes.js";
import { add, dot, quantile, sub } from "./vectors.js";
import { View } from "./view.js";

const SAMPLE = 4096; // maximum number of points for computing the view and the colour ranges
const PICK_PIXELS = 3;
const PLOT_MS = 200; // plots are drawn five times a second
const MAX_OBJECTS = 1 << 20; // maximum number of objects with a colour for their points
const DEATH = 8; // default of track.death: missed frames until a track ends
const NARROW = 900; // the side panel starts closed if the page has at most this width in pixels

export class Page {
  constructor() {
    document.documentElement.dataset.kind = byId("data") ? "static" : "live";
    this.camera = new Camera();
    this.showPanel(innerWidth > NARROW);
    this.resize(); // before the WebGL context, so that its buffers are created only once
    this.renderer = new Renderer(byId("scene"));
    this.overlay = new Overlay(byId("overlay"));
    this.batch = new Batch();
    this.grid = new Batch();
    this.history = new History();
    this.plots = new Plots();
    this.panel = new ObjectPanel((key) => this.pick(key));
    this.view = new View({
      changed: (what) => this.changed(what),
      look: (name) => this.look(name),
      fit: () => this.fit(),
      follow: () => this.follow(!this.view.following),
      pause: () => this.pause(!this.history.paused),
      step: (by) => this.step(by),
      panel: () => this.showPanel(byId("side").hidden),
      escape: () => this.pick(null),
    });
    controlCamera(byId("scene"), this.camera, {
      moved: () => this.request(),
      grabbed: () => this.follow(false),
      click: (px, py) => this.pick(this.keyAt(px, py)),
    });
    this.frame = null; // the frame that is shown or will be shown next
    this.origin = null; // origin of the scene, in absolute coordinates
    this.objects = [];
    this.range = { height: [0, 1], intensity: [0, 1] };
    this.dirty = {};
    this.drawn = 0;
    this.notDrawn = 0;
    this.connection = null;
    // Draw without waiting for the next animation frame, because a resized canvas is blank.
    new ResizeObserver(() => this.resize() && this.drawAndSay()).observe(byId("view"));
    this.watchContext();
  }

  watchContext() {
    byId("scene").addEventListener("webglcontextlost", (event) => event.preventDefault());
    byId("scene").addEventListener("webglcontextrestored", () => {
      this.renderer.setUp();
      this.gridTheme = null;
      this.dirty = { frame: true };
      this.request();
    });
  }

  start() {
    const frame = readStaticFrame(byId("data"));
    if (frame) {
      document.title = `${frame.report.file ?? "cloud"} – pcl_bv`;
      this.camera.setUp(frame.up);
      this.show(frame);
    } else {
      this.connect();
    }
  }

  connect() {
    byId("waiting").hidden = false;
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    this.settings = new Settings((message) => this.connection.send(message));
    this.connection = new Connection(`${scheme}://${location.host}/`, {
      frame: (frame) => this.arrived(frame),
      opened: () => this.opened(),
      lost: () => say("banner", "connection lost, reconnecting"),
      status: (level, message) => {
        if (level < 2 || !this.settings.refuse(message)) notice(message);
      },
      parameters: (parameters, id) => this.settings.receive(parameters, id),
      error: (text) => say("error", text),
    });
    setInterval(() => this.drawPlots(), PLOT_MS);
  }

  opened() {
    say("banner", "");
    say("error", "");
    this.plots.restart();
    this.settings.load().catch((error) => notice(`no settings: ${error.message}`));
  }

  arrived(frame) {
    this.plots.add(frame.report, performance.now());
    if (frame.report.error !== undefined) {
      notice(`frame ${frame.report.seq} was lost: ${frame.report.error}`);
      return;
    }
    const next = this.history.arrive(frame);
    if (!next) return;
    this.dropEndedPick(frame.report);
    if (this.dirty.frame) ++this.notDrawn;
    this.show(next);
  }

  show(frame) {
    this.frame = frame;
    this.dirty.frame = true;
    this.request();
  }

  request() {
    this.requested ??= requestAnimationFrame(() => {
      this.requested = null;
      this.drawAndSay();
    });
  }

  drawAndSay() {
    try {
      this.draw();
    } catch (error) {
      say("error", `the frame could not be drawn: ${error.message}`);
      throw error;
    }
  }

  changed(what) {
    if (what === "colours") this.dirty.colours = true;
    this.request();
  }

  draw() {
    const dirty = this.dirty;
    this.dirty = {};
    if (this.frame) {
      if (dirty.frame) this.takeFrame();
      if (dirty.frame || dirty.colours) this.takeVolumes();
      if (this.view.following) this.moveToPicked();
    }
    const ratio = window.devicePixelRatio;
    this.renderer.draw(this.camera, {
      theme: this.view.theme, mode: this.view.mode, range: this.range[this.view.mode] ?? [0, 1],
      pointSize: this.view.pointSize * ratio, lineWidth: 1.4 * ratio, origin: this.origin ?? [0, 0, 0],
      faces: this.view.faces, grid: this.view.grid,
    });
    this.overlay.draw(this.camera, this.objects, this.view, this.range[this.view.mode], ratio);
    if (!dirty.frame) return;
    ++this.drawn;
    say("error", "");
  }

  takeFrame() {
    const { report, points } = this.frame;
    byId("waiting").hidden = true;
    if (this.origin === null) this.takeFirst();
    this.renderer.setPoints(points);
    this.view.offer({
      tracks: report.clusters.some(({ track }) => typeof track === "number"),
      intensity: points?.intensity ?? false,
    });
    this.view.showMethods(report.clusters);
    byId("frame-text").textContent = frameText(this.frame, this.history.paused);
    byId("frame-text").title = byId("frame-text").textContent;
  }

  takeVolumes() {
    const { clusters } = this.frame.report;
    const { mode, theme } = this.view;
    const colours = [];
    for (const cluster of clusters) {
      if (cluster.id < MAX_OBJECTS) colours[cluster.id] = objectColour(cluster, mode, theme);
    }
    this.renderer.setObjectColours(Array.from(colours, (colour) => colour ?? [0.5, 0.5, 0.5]));
    this.objects = buildVolumes(this.batch, this.frame.report, this.view, this.origin, this.camera.up);
    this.renderer.setLayer(this.renderer.volumes, this.batch);
    this.panel.show(clusters, this.objects, this.view.picked);
    this.renewGrid();
  }

  // Sets the origin, the view and the colour ranges from the first frame.
  takeFirst() {
    const { points, report, origin } = this.frame;
    const positions = points
      ? samplePoints(points, SAMPLE).map((p) => add(p, points.origin))
      : report.clusters.flatMap(({ volumes }) => volumes.filter(isDrawable).map(centerOf));
    const middle = [0, 1, 2].map((k) => quantile(positions.map((p) => p[k]).sort((a, b) => a - b), 0.5));
    this.origin = origin ?? originNear(middle);
    this.fit();
  }

  // Returns the points [x, y, z, intensity] in scene coordinates to which the view is fitted: a sample of the
  // frame's points or, without points, the corners of the objects' boxes.
  fitPoints() {
    const { points, report } = this.frame;
    const sample = points ? samplePoints(points, SAMPLE) : [];
    if (sample.length > 0) return sample.map((p) => [...add(p, sub(points.origin, this.origin)), p[3]]);
    const objects = buildVolumes(this.batch, report, this.view, this.origin, this.camera.up);
    return objects.flatMap(({ low, high }) => [[...low, 0], [...high, 0]]);
  }

  fit() {
    if (!this.frame || this.origin === null) return;
    this.follow(false);
    const points = this.fitPoints();
    this.camera.fit(points);
    const rangeOf = (values) => [quantile(values, 0.02), quantile(values, 0.98)];
    this.range.height = rangeOf(points.map((p) => dot(p, this.camera.up)).sort((a, b) => a - b));
    this.range.intensity = rangeOf(points.map((p) => p[3]).sort((a, b) => a - b));
    this.gridTheme = null;
    this.changed("colours");
  }

  renewGrid() {
    if (this.gridTheme === this.view.theme) return;
    this.gridTheme = this.view.theme;
    const { up, target, radius } = this.camera;
    const onGround = add(target, up.map((x) => x * (this.range.height[0] - dot(target, up))));
    buildGrid(this.grid, onGround, radius, this.camera, this.view.theme);
    this.renderer.setLayer(this.renderer.ground, this.grid);
  }

  look(name) {
    this.camera.look(name);
    this.request();
  }

  pick(key) {
    this.view.picked = key === this.view.picked ? null : key;
    this.seen = this.frame?.report.seq ?? 0; // the last frame with the picked object
    if (this.view.picked === null) this.follow(false);
    this.changed("colours");
  }

  // Ends the selection after 4 * track.death frames without the track, since frames in which it may be occluded
  // count a quarter. Also if frames are numbered anew: the ids are then of other objects.
  dropEndedPick({ clusters, seq }) {
    const key = this.view.picked;
    if (key === null) return;
    if (clusters.some((c) => keyOf(c) === key)) {
      this.seen = seq;
      return;
    }
    const missed = seq - this.seen;
    if (missed >= 0 && missed <= 4 * (this.settings?.numberOf("track.death") ?? DEATH)) return;
    this.pick(key);
    if (key.startsWith("track")) notice(`${key} has ended.`);
  }

  keyAt(px, py) {
    if (!this.frame || this.origin === null) return null;
    const { from, direction } = this.camera.ray(px, py);
    const pad = (distance) => PICK_PIXELS * this.camera.pixelSize(distance);
    const cluster = pickCluster(this.frame.report.clusters, this.view.hidden, add(from, this.origin), direction, pad);
    return cluster ? keyOf(cluster) : null;
  }

  follow(following) {
    this.view.following = following && this.view.picked !== null;
    if (following && this.view.picked === null) notice("Pick an object to follow it.");
    this.view.showState();
    this.request();
  }

  moveToPicked() {
    const cluster = this.frame.report.clusters.find((candidate) => keyOf(candidate) === this.view.picked);
    const middle = cluster ? middleOfCluster(cluster, this.origin) : null;
    if (middle) this.camera.target = middle;
  }

  pause(paused) {
    if (!this.connection) return;
    this.history.pause(paused);
    this.showPaused();
  }

  step(by) {
    if (!this.connection) return;
    const frame = this.history.step(by);
    if (frame) this.show(frame);
    this.showPaused();
  }

  showPaused() {
    byId("pause").textContent = this.history.paused ? "Play" : "Pause";
    byId("pause").setAttribute("aria-pressed", String(this.history.paused));
    if (this.frame) byId("frame-text").textContent = frameText(this.frame, this.history.paused);
  }

  showPanel(shown) {
    byId("side").hidden = !shown;
    byId("panel").setAttribute("aria-pressed", String(shown));
  }

  // Adapts canvases and camera to the size of the view. Returns whether the size has changed.
  resize() {
    const { clientWidth, clientHeight } = byId("view");
    const [wide, high] = [clientWidth, clientHeight].map((size) => Math.max(1, Math.round(size * devicePixelRatio)));
    if (byId("scene").width === wide && byId("scene").height === high) return false;
    for (const canvas of [byId("scene"), byId("overlay")]) Object.assign(canvas, { width: wide, height: high });
    this.camera.width = Math.max(1, clientWidth);
    this.camera.height = Math.max(1, clientHeight);
    return true;
  }

  drawPlots() {
    if (!document.hidden) this.plots.draw(this.view.theme, this.notDrawn);
  }
}
