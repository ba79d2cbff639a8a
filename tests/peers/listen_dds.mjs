// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// listen_dds.mjs DOMAIN COUNT: subscribes to /bv/markers and /diagnostics over RTPS as others wrote it, decodes what comes
// by the peers' own definitions, and ends well when COUNT arrays of markers and one of diagnostics have come in 60 s.
import assert from "node:assert";
import { createRequire } from "node:module";
import { ros2humble } from "@foxglove/rosmsg-msgs-common";
import { MessageReader } from "@foxglove/rosmsg2-serialization";

const require = createRequire(import.meta.url);
const rtps = require("@foxglove/rtps");
const { getNetworkInterfaces, UdpSocketNode } = require("@foxglove/rtps/nodejs");

const [domainId, count] = process.argv.slice(2).map(Number);
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
const limit = setTimeout(() => {
  console.error(`only ${arrays} arrays of markers and ${diagnostics} of diagnostics in 60 s`);
  process.exit(1);
}, 60_000);

async function doneWhenAllHaveCome() {
  if (arrays < count || diagnostics === 0) return;
  clearTimeout(limit);
  await node.shutdown();
  console.log(`@foxglove/rtps: ${arrays} arrays of ${markers} markers`);
  process.exit(0);
}

// RosNode of @foxglove/ros2 asks for what was published before, too, which ROS's default publishers do not keep.
function listen(topic, dataType, heard) {
  const [packageName, , name] = dataType.split("/");
  const reader = new MessageReader(definitionsOf(`${packageName}/${name}`));
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
    heard(reader.readMessage(serializedData));
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
