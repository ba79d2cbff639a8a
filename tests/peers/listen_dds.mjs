// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// listen_dds.mjs DOMAIN COUNT FILE.mcap: subscribes to topics of bv_stream over RTPS as others wrote it, and decodes what
// comes: markers and diagnostics by the peers' own definitions, the messages for MoveIt, Nav2 and vision_msgs by those in
// the recording. Ends well when COUNT arrays of markers and a message of each other topic have come in 60 s.
import assert from "node:assert";
import { open } from "node:fs/promises";
import { createRequire } from "node:module";
import { parse } from "@foxglove/rosmsg";
import { ros2humble } from "@foxglove/rosmsg-msgs-common";
import { MessageReader, MessageWriter } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import { loadDecompressHandlers } from "@mcap/support";

const require = createRequire(import.meta.url);
const rtps = require("@foxglove/rtps");
const { getNetworkInterfaces, UdpSocketNode } = require("@foxglove/rtps/nodejs");

const [domainId, count] = process.argv.slice(2, 4).map(Number);
const node = new rtps.Participant({
  name: "listener",
  domainId,
  addresses: [rtps.selectIPv4(getNetworkInterfaces())],
  udpSocketCreate: UdpSocketNode.Create,
});

function definitionsOf(type, found = []) {
  const definition = ros2humble[type];
  if (found.includes(definition)) return found;
  found.push(definition);
  for (const field of definition.definitions) if (field.isComplex) definitionsOf(field.type, found);
  return found;
}

let arrays = 0, markers = 0, diagnostics = 0;
const adapted = new Map(); // messages by topic
const limit = setTimeout(() => {
  console.error(`only ${arrays} arrays of markers, ${diagnostics} of diagnostics and ${JSON.stringify([...adapted])} in 60 s`);
  process.exit(1);
}, 60_000);

async function doneWhenAllHaveCome() {
  if (arrays < count || diagnostics === 0 || [...adapted.values()].includes(0)) return;
  clearTimeout(limit);
  await node.shutdown();
  console.log(`@foxglove/rtps: ${arrays} arrays of ${markers} markers; ${[...adapted].map(([topic, n]) => `${n} of ${topic}`)}`);
  process.exit(0);
}

// RosNode of @foxglove/ros2 asks for what was published before, too, which ROS's default publishers do not keep.
function listen(topic, dataType, heard, definitions) {
  const [packageName, , name] = dataType.split("/");
  const reader = new MessageReader(definitions ?? definitionsOf(`${packageName}/${name}`));
  const topicName = `rt${topic}`;
  node.subscribe({
    topicName,
    typeName: `${packageName}::msg::dds_::${name}_`,
    durability: rtps.Durability.Volatile,
    reliability: { kind: rtps.Reliability.Reliable, maxBlockingTime: { sec: 0x7fffffff, nsec: 0xffffffff } },
    history: { kind: rtps.HistoryKind.KeepLast, depth: 10 },
  });
  node.on("userData", ({ subscription, serializedData }) => {
    if (subscription.topicName !== topicName) return;
    heard(reader.readMessage(serializedData), serializedData);
    void doneWhenAllHaveCome();
  });
}

await node.start();
listen("/bv/markers", "visualization_msgs/msg/MarkerArray", (message) => {
  for (const marker of message.markers) {
    assert.equal(marker.header.frame_id, "street");
    const { x, y, z, w } = marker.pose.orientation;
    assert.ok(Math.abs(x * x + y * y + z * z + w * w - 1) < 1e-9);
  }
  ++arrays;
  markers += message.markers.length;
});
listen("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", (message) => {
  assert.equal(message.status[0].name, "pcl_bv");
  ++diagnostics;
});
const recording = await McapIndexedReader.Initialize({
  readable: new FileHandleReadable(await open(process.argv[4])), decompressHandlers: await loadDecompressHandlers() });
for (const channel of recording.channelsById.values()) {
  if (!/planning_scene|collision_object|obstacles|polygons|footprints|boxes/.test(channel.topic)) continue;
  const schema = recording.schemasById.get(channel.schemaId);
  const definitions = parse(new TextDecoder().decode(schema.data), { ros2: true });
  const encoder = new MessageWriter(definitions);
  adapted.set(channel.topic, 0);
  listen(channel.topic, schema.name, (message, data) => {
    const again = Buffer.from(encoder.writeMessage(message));
    assert.equal(Buffer.compare(again.subarray(4), Buffer.from(data).subarray(4, again.length)), 0, channel.topic);
    assert.ok(data.length - again.length < 4); // padding
    adapted.set(channel.topic, adapted.get(channel.topic) + 1);
  }, definitions);
}
