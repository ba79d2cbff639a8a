// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// write_mcap.mjs FILE.mcap indexed|plain: five clouds of a growing number of points, by the writer of @mcap/core.
import { open } from "node:fs/promises";
import { ros2humble } from "@foxglove/rosmsg-msgs-common";
import { MessageWriter } from "@foxglove/rosmsg2-serialization";
import { McapWriter } from "@mcap/core";
import { FileHandleWritable } from "@mcap/nodejs";

const [file, kind] = process.argv.slice(2);
const indexed = kind === "indexed";
const names = ["sensor_msgs/PointCloud2", "std_msgs/Header", "builtin_interfaces/Time", "sensor_msgs/PointField"];
const encoder = new MessageWriter(names.map((name) => ros2humble[name]));
const handle = await open(file, "w");
const writer = new McapWriter({ writable: new FileHandleWritable(handle), useChunks: indexed, useSummaryOffsets: indexed,
                                useStatistics: indexed, useChunkIndex: indexed, repeatChannels: indexed,
                                repeatSchemas: indexed, chunkSize: 500 });
await writer.start({ profile: "ros2", library: "peer" });
const schemaId = await writer.registerSchema({ name: "sensor_msgs/msg/PointCloud2", encoding: "ros2msg",
                                               data: new TextEncoder().encode("") });
const channelId = await writer.registerChannel({ schemaId, topic: "/points", messageEncoding: "cdr", metadata: new Map() });
for (let i = 0; i < 5; ++i) {
  const width = 100 * (i + 1);
  const xyz = Float32Array.from({ length: 3 * width }, (_, k) => 5 + 0.01 * k);
  const data = encoder.writeMessage({
    header: { stamp: { sec: 100 + i, nanosec: 0 }, frame_id: "peer" }, height: 1, width,
    fields: ["x", "y", "z"].map((name, k) => ({ name, offset: 4 * k, datatype: 7, count: 1 })),
    is_bigendian: false, point_step: 12, row_step: 12 * width, data: new Uint8Array(xyz.buffer), is_dense: true });
  const time = BigInt(1000 * i);
  await writer.addMessage({ channelId, sequence: i, logTime: time, publishTime: time, data });
}
await writer.end();
await handle.close();
