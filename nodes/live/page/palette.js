// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Colours of objects and of the two themes. The ten colours of objects are the same as in the topics for RViz
// and Foxglove.

const OBJECT_COLOURS = [
  [0.12, 0.56, 1.0],
  [1.0, 0.5, 0.05],
  [0.17, 0.7, 0.17],
  [0.9, 0.2, 0.25],
  [0.6, 0.4, 0.85],
  [0.75, 0.6, 0.1],
  [0.1, 0.75, 0.75],
  [0.9, 0.45, 0.75],
  [0.5, 0.6, 0.15],
  [0.55, 0.35, 0.3],
];

export const THEMES = {
  dark: {
    background: [0.055, 0.067, 0.086],
    plain: [0.36, 0.39, 0.44],
    picked: [1, 1, 1],
    grid: [0.5, 0.56, 0.64],
    text: "#dfe5ee",
    halo: "rgba(14, 17, 22, 0.85)",
    dim: "#8a94a3",
    lift: 0.3,
    ramp: [0.3, 0.42, 0.85, 0.16, 0.66, 0.78, 0.33, 0.78, 0.44, 0.88, 0.8, 0.32, 0.96, 0.52, 0.3],
  },
  light: {
    background: [0.965, 0.97, 0.976],
    plain: [0.66, 0.68, 0.71],
    picked: [0, 0, 0],
    grid: [0.45, 0.5, 0.56],
    text: "#1c222b",
    halo: "rgba(247, 248, 250, 0.9)",
    dim: "#5d6775",
    lift: 0,
    ramp: [0.2, 0.25, 0.68, 0.05, 0.47, 0.62, 0.12, 0.55, 0.25, 0.72, 0.55, 0.05, 0.8, 0.25, 0.1],
  },
};

// Mixes a colour with some white in the dark theme, so that thin lines and single points stay legible.
function lifted(colour, theme) {
  return colour.map((part) => part + (1 - part) * THEMES[theme].lift);
}

// Returns the colour of an object. It depends on the track id or, for objects without a track, on the cluster
// id. In mode "cluster", the colour depends on the cluster id for all objects. In mode "track", objects
// without a track have the plain colour.
export function objectColour(cluster, mode, theme) {
  const tracked = typeof cluster.track === "number";
  if (mode === "track" && !tracked) return lifted(THEMES[theme].plain, theme);
  const number = mode !== "cluster" && tracked ? cluster.track : cluster.id;
  return lifted(OBJECT_COLOURS[Math.abs(number) % OBJECT_COLOURS.length], theme);
}

export function cssColour(colour) {
  return `rgb(${colour.map((part) => Math.round(255 * part)).join(" ")})`;
}
