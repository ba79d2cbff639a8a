// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Elements of the page. Text from messages is always textContent, so it cannot become markup.

export const byId = (id) => document.getElementById(id);

// element("td", {className: "number"}, "1.5") or with other elements as children.
export function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

// Digits that a person reads: `decimals` of them, never "-0".
export function fixed(number, decimals) {
  return typeof number === "number" ? (number.toFixed(decimals).replace(/^-(0(\.0*)?)$/, "$1")) : "–";
}

export function vectorText(vector, decimals) {
  return Array.isArray(vector) ? vector.map((x) => fixed(x, decimals)).join("  ") : "–";
}

// The number with a thin space before each three digits.
export function countText(count) {
  return String(count).replace(/\B(?=(\d{3})+$)/g, "\u2009");
}
