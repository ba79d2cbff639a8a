// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The numbers of the picked object, and the list of all.
import { byId, countText, element, fixed, vectorText } from "./elements.js";
import { cssColour } from "./palette.js";
import { keyOf, speedOf } from "./scene.js";
import { centerOf, isDrawable, sizeOf } from "./shapes.js";

const MOST_ROWS = 200;

// `pick(key)` is called for a click into the list.
export class ObjectPanel {
  constructor(pick) {
    byId("object-rows").addEventListener("click", (event) => {
      const row = event.target.closest("tr");
      if (row) pick(row.dataset.key);
    });
    byId("object-rows").addEventListener("keydown", (event) => {
      if (event.key === "Enter") pick(event.target.closest("tr").dataset.key);
    });
  }

  // `objects`: of buildVolumes(); `picked`: a key or null.
  show(clusters, objects, picked) {
    const cluster = clusters.find((candidate) => keyOf(candidate) === picked);
    this.showPicked(cluster, picked);
    this.showList(clusters, new Map(objects.map((object) => [object.cluster, cssColour(object.colour)])), picked);
  }

  showPicked(cluster, picked) {
    byId("picked-none").hidden = picked !== null;
    byId("picked-gone").hidden = picked === null || cluster !== undefined;
    byId("picked-gone").textContent = `${picked} is not in this frame.`;
    const rows = cluster ? [...objectRows(cluster), ...cluster.volumes.flatMap(volumeRows)] : [];
    byId("picked-rows").replaceChildren(...rows);
  }

  showList(clusters, colours, picked) {
    byId("object-count").textContent = countText(clusters.length);
    if (!byId("object-section").open) return;
    const rows = clusters.slice(0, MOST_ROWS).map((cluster) => listRow(cluster, colours.get(cluster), keyOf(cluster) === picked));
    const body = byId("object-rows");
    const focused = body.contains(document.activeElement) ? document.activeElement.dataset.key : null;
    body.replaceChildren(...rows);
    if (focused !== null) rows.find((row) => row.dataset.key === focused)?.focus();
    byId("object-more").hidden = clusters.length <= MOST_ROWS;
    byId("object-more").textContent = `${clusters.length - MOST_ROWS} more`;
  }
}

function listRow(cluster, colour, isPicked) {
  const row = element("tr", { tabIndex: 0, className: isPicked ? "picked" : "" });
  row.dataset.key = keyOf(cluster);
  const swatch = element("span", { className: "swatch" });
  swatch.style.background = colour ?? "transparent";
  const name = typeof cluster.track === "number" ? String(cluster.track) : `#${cluster.id}`;
  row.append(element("td", {}, swatch, name), element("td", {}, String(cluster.class ?? "")),
    element("td", { className: "number" }, countText(cluster.points)),
    element("td", { className: "number" }, cluster.moving ? fixed(speedOf(cluster), 1) : ""));
  return row;
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
