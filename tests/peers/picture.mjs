// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// picture.mjs FILE.mcap > PICTURE.svg: the topics of a recording, when each has messages, their rates and sizes.
import { open } from "node:fs/promises";
import { McapIndexedReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import { loadDecompressHandlers } from "@mcap/support";

const readable = new FileHandleReadable(await open(process.argv[2]));
const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers: await loadDecompressHandlers() });
const begin = reader.statistics.messageStartTime;
const seconds = Number(reader.statistics.messageEndTime - begin) / 1e9;
const topics = new Map();
for await (const message of reader.readMessages()) {
  const channel = reader.channelsById.get(message.channelId);
  const name = channel.topic;
  if (!topics.has(name))
    topics.set(name, { type: reader.schemasById.get(channel.schemaId).name, bytes: 0, times: [] });
  const topic = topics.get(name);
  topic.bytes += message.data.length;
  topic.times.push(Number(message.logTime - begin) / 1e9);
}
const rows = [...topics].sort(([a], [b]) => a.localeCompare(b));
const left = 330, width = 300, step = 34;
const size = (bytes) => (bytes >= 1e6 ? `${(bytes / 1e6).toFixed(1)} MB` : `${(bytes / 1e3).toFixed(1)} kB`);
const lines = rows.map(([name, topic], i) => {
  const y = 30 + step * i;
  const ticks = topic.times.map((t) => `M${(left + (width * t) / seconds).toFixed(1)} ${y - 9}v14`).join("");
  const rate = topic.times.length > 1 ? (topic.times.length - 1) / (topic.times.at(-1) - topic.times[0]) : 0;
  return `<text x="12" y="${y}" font-weight="bold">${name}</text><text x="12" y="${y + 14}" fill="#667">${topic.type}</text>` +
    `<path d="${ticks}" stroke="#1e90ff" stroke-width="2"/>` +
    `<text x="${left + width + 16}" y="${y}">${topic.times.length} messages, ${rate.toFixed(1)} Hz</text>` +
    `<text x="${left + width + 16}" y="${y + 14}" fill="#667">${size(topic.bytes)}</text>`;
});
console.log(`<svg xmlns="http://www.w3.org/2000/svg" width="800" height="${20 + step * rows.length}" font-family="sans-serif" font-size="12">
<rect width="100%" height="100%" fill="#fff"/>
${lines.join("\n")}
</svg>`);
