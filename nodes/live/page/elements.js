// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Elements of the page. Text from messages is assigned to textContent only, so that it cannot become markup.

export const byId = (id) => document.getElementById(id);

// Creates an element, for example element("td", {className: "number"}, "1.5"). Children are texts or
// elements.
export function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

// Formats a number with `decimals` decimals, never as "-0".
export function fixed(number, decimals) {
  return typeof number === "number" ? (number.toFixed(decimals).replace(/^-(0(\.0*)?)$/, "$1")) : "–";
}

export function vectorText(vector, decimals) {
  return Array.isArray(vector) ? vector.map((x) => fixed(x, decimals)).join("  ") : "–";
}

// Formats a number with thin spaces between groups of three digits.
export function countText(count) {
  return String(count).replace(/\B(?=(\d{3})+$)/g, "\u2009");
}
