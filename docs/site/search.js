// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The navigation, the menu of narrow screens, and the search. The index is a script and not JSON, so that the
// pages also work from a folder, without a server. It is loaded when the search gets the focus.
const field = document.getElementById("search");
const found = document.getElementById("found");
const menu = document.getElementById("menu");
const MOST = 12; // results
const AROUND = 60; // characters of text before and after the first word

// The link of this page is visible in the navigation, without scrolling the page itself.
const navigation = document.getElementById("navigation");
const current = navigation.querySelector("[aria-current]");
if (current) navigation.scrollTop = current.offsetTop - navigation.offsetTop - navigation.clientHeight / 2;

menu.addEventListener("click", () => {
  const open = document.body.classList.toggle("menu");
  menu.setAttribute("aria-expanded", String(open));
});

function load() {
  if (document.getElementById("index")) return;
  const script = document.createElement("script");
  script.id = "index";
  script.src = `${field.dataset.root}/search-index.js`;
  script.onload = show;
  document.head.append(script);
}

// A word counts most in the heading of a section, then in the title of the page, then in the text. All words
// must occur.
function score([title, heading, , text], words) {
  let sum = 0;
  for (const word of words) {
    const inHeading = heading.toLowerCase().includes(word);
    const inTitle = title.toLowerCase().includes(word);
    const count = text.toLowerCase().split(word).length - 1;
    if (!inHeading && !inTitle && count === 0) return 0;
    sum += (inHeading ? 20 : 0) + (inTitle ? 8 : 0) + Math.min(count, 5);
  }
  return sum;
}

function excerpt(text, word) {
  const at = Math.max(0, text.toLowerCase().indexOf(word));
  const from = Math.max(0, at - AROUND);
  return (from > 0 ? "… " : "") + text.slice(from, at + AROUND) + (at + AROUND < text.length ? " …" : "");
}

function show() {
  const words = field.value.toLowerCase().split(/\s+/).filter((word) => word.length > 1);
  if (!window.searchIndex || words.length === 0) {
    found.hidden = true;
    return;
  }
  const scored = window.searchIndex.map((entry) => [score(entry, words), entry]);
  const ranked = scored.filter(([points]) => points > 0);
  ranked.sort((a, b) => b[0] - a[0]);
  found.replaceChildren(...ranked.slice(0, MOST).map(([, [title, heading, address, text]]) => {
    const item = document.createElement("li");
    const link = document.createElement("a");
    const small = document.createElement("small");
    link.href = `${field.dataset.root}/${address}`;
    link.append(title === heading ? title : `${title}: ${heading}`);
    small.textContent = excerpt(text, words[0]);
    item.append(link, small);
    return item;
  }));
  if (ranked.length === 0) found.textContent = "Nothing found.";
  found.hidden = false;
}

field.addEventListener("focus", load);
field.addEventListener("input", show);
document.addEventListener("keydown", (event) => {
  if (event.key === "Escape") found.hidden = true;
  if (event.key === "/" && event.target.tagName !== "INPUT") {
    event.preventDefault();
    field.focus();
  }
});
document.addEventListener("click", (event) => {
  if (!event.target.closest(".search")) found.hidden = true;
});
