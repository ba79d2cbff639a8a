// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The panel of the pipeline's settings. The descriptions of the settings come from GET /settings, their
// values from Foxglove's parameters. The server checks each value. When the server refuses a value, the
// reason is shown next to the field, and the field shows the value in force.
import { byId, element } from "./elements.js";

const UNSET = "null";
const ANSWER_MS = 2000; // a refusal within this time after the last change is treated as an answer to it

export class Settings {
  // send(message) sends a message to the server.
  constructor(send) {
    this.send = send;
    this.fields = new Map(); // key -> {setting, input, note}
    this.pendingKeys = new Map(); // id of a pending request -> key
    this.lastChange = { key: null, at: 0 };
    this.requests = 0;
  }

  // Loads the settings. Called after each connect, because another server may have other settings.
  async load() {
    const answer = await fetch("settings");
    if (!answer.ok) throw new Error(`settings: ${answer.status} ${answer.statusText}`);
    this.show(await answer.json());
    const names = [...this.fields.keys()];
    this.send({ op: "subscribeParameterUpdates", parameterNames: names });
    this.send({ op: "getParameters", parameterNames: names, id: "all" });
  }

  show(settings) {
    this.fields.clear();
    this.pendingKeys.clear();
    const groups = new Map();
    for (const setting of settings) {
      const [group] = setting.key.split(".");
      if (!groups.has(group)) groups.set(group, []);
      groups.get(group).push(this.row(setting));
    }
    byId("settings").replaceChildren(...[...groups].map(([group, rows]) =>
      element("fieldset", {}, element("legend", {}, group), ...rows)));
    byId("settings-section").hidden = settings.length === 0;
  }

  row(setting) {
    const input = inputFor(setting);
    const note = element("small", { className: "note" });
    note.setAttribute("role", "status");
    input.id = `setting-${setting.key}`;
    input.disabled = setting.fixed === true;
    input.addEventListener("change", () => this.change(setting.key));
    this.fields.set(setting.key, { setting, input, note });
    const name = setting.key.slice(setting.key.indexOf(".") + 1).replaceAll("_", " ");
    const label = element("label", { htmlFor: input.id, title: `${setting.key}: ${setting.about ?? ""}` }, name);
    const unit = element("span", { className: "unit" }, setting.unit ?? "");
    const about = element("small", { className: "about" }, aboutText(setting));
    return element("div", { className: "setting" }, label, input, unit, about, note);
  }

  // Returns the value of a number; null if there is no such setting.
  numberOf(key) {
    const field = this.fields.get(key);
    return field && field.input.value !== "" ? Number(field.input.value) : null;
  }

  change(key) {
    const { setting, input, note } = this.fields.get(key);
    note.textContent = "";
    const id = `set ${++this.requests}`;
    this.pendingKeys.set(id, key);
    this.lastChange = { key, at: performance.now() };
    this.send({ op: "setParameters", parameters: [{ name: key, value: valueOf(setting, input) }], id });
  }

  // Shows the values in force. The server sends them as the answer to a request (with an `id`) and after a
  // change by any client. A field that has the focus is overwritten only by an answer.
  receive(parameters, id) {
    this.pendingKeys.delete(id);
    for (const { name, value } of parameters) {
      const field = this.fields.get(name);
      if (field && !(field.input === document.activeElement && id === undefined)) write(field, value);
    }
  }

  // Shows the reason of a refusal at the field of the oldest pending change. If no change is pending, shows
  // the reason at the field of the last change, if that is recent. Returns false if there is no such field.
  refuse(reason) {
    const isRecent = performance.now() - this.lastChange.at < ANSWER_MS;
    const key = [...this.pendingKeys.values()][0] ?? (isRecent ? this.lastChange.key : null);
    if (!this.fields.has(key)) return false;
    this.fields.get(key).note.textContent = reason;
    return true;
  }
}

function inputFor({ kind, choices, unset }) {
  if (kind === "bool") return element("input", { type: "checkbox" });
  if (kind === "choice") return element("select", {}, ...choices.map((choice) => new Option(choice, choice)));
  const isNumber = kind === "number" || kind === "count";
  return element("input", {
    type: "text",
    inputMode: isNumber ? "decimal" : "text",
    className: isNumber ? "number" : "words",
    placeholder: unset ?? "",
    autocomplete: "off",
    spellcheck: false,
  });
}

function aboutText({ kind, least, most, closed, about, fixed: isFixed }) {
  const parts = [about ?? ""];
  if (kind === "number" || kind === "count") {
    const [low, high] = [least ?? null, most ?? null];
    if (low !== null && high !== null) parts.push(closed === false ? `above ${low}, up to ${high}` : `${low} to ${high}`);
    else if (low !== null) parts.push(closed === false ? `above ${low}` : `${low} or more`);
    else if (high !== null) parts.push(`up to ${high}`);
  }
  if (isFixed) parts.push("fixed while it runs");
  return parts.filter(Boolean).join("; ");
}

function valueOf({ kind, unset }, input) {
  if (kind === "bool") return input.checked;
  const text = input.value.trim();
  if (text === "" && unset !== undefined) return UNSET;
  const number = Number(text);
  return (kind === "number" || kind === "count") && text !== "" && Number.isFinite(number) ? number : text;
}

function write({ setting, input }, value) {
  if (setting.kind === "bool") input.checked = value === true;
  else input.value = value === undefined || value === null || value === UNSET ? "" : String(value);
}
