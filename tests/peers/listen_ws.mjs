// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// node listen_ws.mjs PORT FRAMES SUBPROTOCOL: Foxglove's own client, as Foxglove and Lichtblick have it. Subscribes to all
// channels and wants so many frames one after the other, each message as its definition in the channel says, and the
// settings; changes one, and has another refused.
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import protocol from "@foxglove/ws-protocol"; // CommonJS
import WebSocket from "ws";

const [port, wanted, subprotocol] = [process.argv[2], Number(process.argv[3]), process.argv[4]];
const socket = new WebSocket(`ws://127.0.0.1:${port}/`, [subprotocol]);
const client = new protocol.FoxgloveClient({ ws: socket });
const channels = new Map(); // by subscription
const counts = new Map(); // messages by topic
const seen = new Set();
let capabilities = [];
let lastSeq, changed, refused;

function fail(why) {
  console.error(`listen_ws: ${why}`);
  process.exit(1);
}

client.on("serverInfo", (info) => (capabilities = info.capabilities));
client.on("error", (error) => fail(error.message));
client.on("status", (event) => {
  if (event.message.includes("cluster.tolerance")) refused = event.message;
  else if (event.level > 0) fail(`status: ${event.message}`);
});
client.on("time", () => seen.add("time"));

client.on("advertise", (added) => {
  for (const channel of added) {
    const reader =
      channel.encoding === "cdr" ? new MessageReader(parse(channel.schema, { ros2: true })) : undefined;
    if (channel.encoding === "json") JSON.parse(channel.schema);
    channels.set(client.subscribe(channel.id), { ...channel, reader });
  }
  client.getParameters([], "all");
});

client.on("parameterValues", ({ parameters, id }) => {
  const values = new Map(parameters.map((parameter) => [parameter.name, parameter.value]));
  if (id === "all" && !seen.has("all")) {
    seen.add("all");
    if (values.get("cluster.tolerance") !== 0.5) fail(`cluster.tolerance is ${values.get("cluster.tolerance")}, not 0.5`);
    client.setParameters([{ name: "cluster.tolerance", value: 0.6 }], "changed");
    client.setParameters([{ name: "cluster.tolerance", value: -1 }], "refused");
  }
  if (id === "changed") changed = values.get("cluster.tolerance");
});

client.on("message", ({ subscriptionId, data }) => {
  const channel = channels.get(subscriptionId);
  counts.set(channel.topic, (counts.get(channel.topic) ?? 0) + 1);
  if (channel.reader) {
    const message = channel.reader.readMessage(data);
    if (channel.topic.endsWith("/points") && message.data.length !== message.width * message.point_step)
      fail("a cloud is not as long as it says");
    return;
  }
  const frame = JSON.parse(new TextDecoder().decode(data));
  if (frame.error) fail(`frame ${frame.seq} is lost: ${frame.error}`);
  if (lastSeq !== undefined && frame.seq !== lastSeq + 1) fail(`frame ${frame.seq} comes after ${lastSeq}`);
  lastSeq = frame.seq;
  if (counts.get(channel.topic) === wanted) finish();
});

function finish() {
  if (socket.protocol !== subprotocol) fail(`subprotocol ${socket.protocol}`);
  for (const capability of ["parameters", "parametersSubscribe", "time"])
    if (!capabilities.includes(capability)) fail(`no capability ${capability}`);
  if (!seen.has("time")) fail("no time came");
  if (changed !== 0.6) fail(`cluster.tolerance became ${changed}`);
  if (!refused) fail("a tolerance of -1 was not refused");
  for (const [topic, count] of counts) {
    if (/(objects|markers|scene|points)$/.test(topic) && Math.abs(count - wanted) > 1) fail(`${count} messages of ${topic}`);
  }
  console.log(`${wanted} of ${wanted} frames by ${subprotocol}: ${[...counts].map(([t, n]) => `${n} ${t}`).join(", ")}`);
  process.exit(0);
}
