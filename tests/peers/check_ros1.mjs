// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// check_ros1.mjs FILE: decodes the messages that listen_ros1.py heard, encodes them again, and compares bytes.
import assert from "node:assert";
import { readFile } from "node:fs/promises";
import { parse } from "@foxglove/rosmsg";
import { MessageReader, MessageWriter } from "@foxglove/rosmsg-serialization";

let messages = 0;
for (const { definition, topic, data } of JSON.parse(await readFile(process.argv[2], "utf8"))) {
  const definitions = parse(definition);
  const bytes = Buffer.from(data, "hex");
  const again = new MessageWriter(definitions).writeMessage(new MessageReader(definitions).readMessage(bytes));
  assert.equal(Buffer.compare(Buffer.from(again), bytes), 0, topic);
  ++messages;
}
assert.ok(messages > 0);
console.log(`@foxglove/rosmsg-serialization: ${messages} messages of ROS 1 equal`);
