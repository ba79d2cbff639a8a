// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Replaces the server of the live page: a WebSocket that repeats the messages in the page (demo.py), two for
// each frame, ten frames a second, and a GET /settings without settings.
(() => {
  const PERIOD_MS = 100;
  const CHANNELS = [
    { id: 1, topic: "/bv/frames", encoding: "json" },
    { id: 2, topic: "/bv/points", encoding: "cdr" },
  ];

  async function readMessages() {
    const text = document.getElementById("recording").textContent;
    const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
    const unpacked = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    const data = await new Response(unpacked).arrayBuffer();
    const view = new DataView(data);
    const messages = [];
    for (let at = 0; at < data.byteLength;) {
      const length = view.getUint32(at, true);
      messages.push(data.slice(at + 4, at + 4 + length));
      at += 4 + length;
    }
    return messages;
  }

  class Replay {
    static OPEN = 1;
    readyState = 1;

    constructor() {
      readMessages().then((messages) => this.play(messages));
    }

    play(messages) {
      let next = 0;
      this.onopen?.();
      this.onmessage?.({ data: JSON.stringify({ op: "advertise", channels: CHANNELS }) });
      setInterval(() => {
        if (document.hidden) return;
        for (let i = 0; i < 2; ++i) this.onmessage?.({ data: messages[next + i] });
        next = (next + 2) % messages.length;
      }, PERIOD_MS);
    }

    send() {}
  }

  const home = Object.assign(document.createElement("a"), { href: "index.html", textContent: "pcl_bv" });
  home.title = "All pages. This street is generated, and repeats every six seconds.";
  home.style.color = "inherit";
  document.querySelector("h1").replaceChildren(home);
  window.WebSocket = Replay;
  window.fetch = async () => new Response("[]");
})();
