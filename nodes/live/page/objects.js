// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The panel with the numbers of the picked object and the list of all objects.
import { byId, countText, element, fixed, vectorText } from "./elements.js";
import { cssColour } from "./palette.js";
import { keyOf, speedOf } from "./scene.js";
import { centerOf, isDrawable, sizeOf } from "./shapes.js";

const MAX_ROWS = 200;

// `pick(key)` is called when a row of the list is clicked.
export class ObjectPanel {
  constructor(pick) {
    this.rows = new Map(); // rows of the list by key
    byId("object-rows").addEventListener("click", (event) => {
      const row = event.target.closest("tr");
      if (row) pick(row.dataset.key);
    });
    byId("object-rows").addEventListener("keydown", (event) => {
      if (event.key === "Enter") pick(event.target.closest("tr").dataset.key);
    });
    byId("copy").addEventListener("click", () => copyText(JSON.stringify(this.cluster)));
  }

  // `objects` is the result of buildVolumes(). `picked` is a key or null.
  show(clusters, objects, picked) {
    this.cluster = clusters.find((candidate) => keyOf(candidate) === picked);
    this.showPicked(picked);
    byId("object-count").textContent = countText(clusters.length);
    if (byId("object-section").open) this.showList(clusters, objects, picked);
  }

  showPicked(picked) {
    byId("picked-none").hidden = picked !== null;
    byId("picked-gone").hidden = picked === null || this.cluster !== undefined;
    byId("picked-gone").textContent = `${picked} is not in this frame.`;
    byId("copy").hidden = this.cluster === undefined;
    const rows = this.cluster ? [...objectRows(this.cluster), ...this.cluster.volumes.flatMap(volumeRows)] : [];
    byId("picked-rows").replaceChildren(...rows);
  }

  // Reuses the row elements from frame to frame, so that clicks on them work and the focus stays.
  showList(clusters, objects, picked) {
    const colours = new Map(objects.map((object) => [object.cluster, cssColour(object.colour)]));
    const shown = [...clusters].sort(byTrack).slice(0, MAX_ROWS);
    const rows = shown.map((cluster) => {
      const key = keyOf(cluster);
      const row = this.rows.get(key) ?? newRow(key);
      fillRow(row, cluster, colours.get(cluster), key === picked);
      return row;
    });
    this.rows = new Map(rows.map((row) => [row.dataset.key, row]));
    const body = byId("object-rows");
    if (body.children.length !== rows.length || rows.some((row, i) => row !== body.children[i])) {
      const focused = document.activeElement;
      body.replaceChildren(...rows);
      if (rows.includes(focused)) focused.focus({ preventScroll: true });
    }
    byId("object-more").hidden = clusters.length <= MAX_ROWS;
    byId("object-more").textContent = `${clusters.length - MAX_ROWS} more`;
  }
}

// Orders clusters by track id. Clusters without a track follow, ordered by cluster id.
function byTrack(a, b) {
  const order = ({ track, id }) => (typeof track === "number" ? track : 1e10 + id);
  return order(a) - order(b);
}

function newRow(key) {
  const row = element("tr", { tabIndex: 0 });
  row.dataset.key = key;
  const cell = (className) => element("td", { className }, "");
  row.append(element("td", {}, element("span", { className: "swatch" }), ""), cell(""), cell("number"), cell("number"));
  return row;
}

function fillRow(row, cluster, colour, isPicked) {
  row.className = isPicked ? "picked" : "";
  const [name, kind, points, speed] = row.children;
  name.firstChild.style.background = colour ?? "transparent";
  name.lastChild.data = typeof cluster.track === "number" ? String(cluster.track) : `#${cluster.id}`;
  kind.firstChild.data = String(cluster.class ?? "");
  points.firstChild.data = countText(cluster.points);
  speed.firstChild.data = cluster.moving ? fixed(speedOf(cluster), 1) : "";
}

// Does not use navigator.clipboard, because browsers do not offer it in pages loaded by http from another
// machine.
function copyText(text) {
  const area = element("textarea", { value: text });
  document.body.append(area);
  area.select();
  document.execCommand("copy");
  area.remove();
}

function pair(name, text) {
  return element("tr", {}, element("th", { scope: "row" }, name), element("td", {}, text));
}

function objectRows(cluster) {
  const rows = [pair("id", String(cluster.id))];
  if ("track" in cluster) rows.push(pair("track", cluster.track === null ? "not yet" : String(cluster.track)));
  if (cluster.class !== undefined) rows.push(pair("class", String(cluster.class)));
  rows.push(pair("points", countText(cluster.points)));
  if (typeof cluster.track !== "number") return rows;
  rows.push(pair("age", `${cluster.age} frames`), pair("velocity", `${vectorText(cluster.velocity, 2)} m/s`),
    pair("speed", `${fixed(speedOf(cluster), 2)} m/s`), pair("moving", cluster.moving ? "yes" : "no"));
  if (Array.isArray(cluster.pose)) {
    rows.push(pair("pose", `${vectorText(cluster.pose.slice(0, 3), 3)} m`),
      pair("yaw", `${fixed((cluster.pose[3] * 180) / Math.PI, 1)}°`));
  }
  return rows;
}

function volumeRows(volume) {
  const title = element("tr", { className: "title" }, element("th", { colSpan: 2 }, String(volume.method ?? volume.shape)));
  if (volume.empty) return [title, pair("", "empty: no valid point")];
  if (volume.failed !== undefined) return [title, pair("failed", String(volume.failed))];
  if (!isDrawable(volume)) return [title, pair("", "a shape that this page does not know")];
  const rows = [title, pair("centre", `${vectorText(centerOf(volume), 3)} m`), pair("size", sizeOf(volume)),
    pair("volume", `${Number(volume.volume.toPrecision(5))} m³`)];
  if (volume.outside !== undefined) rows.push(pair("outside", `${countText(volume.outside)} points`));
  return rows;
}
