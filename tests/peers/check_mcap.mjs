// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// check_mcap.mjs FILE.mcap: opens it by its index and as a stream, decodes each message by the definition in the file
// and by the peers' own, encodes it again, and compares bytes.
import assert from "node:assert";
import { open, readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { parse } from "@foxglove/rosmsg";
import { ros2humble } from "@foxglove/rosmsg-msgs-common";
import { MessageReader, MessageWriter } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import { loadDecompressHandlers } from "@mcap/support";

const foxglove = createRequire(import.meta.url)("@foxglove/schemas/internal");
const file = process.argv[2];
const decompressHandlers = await loadDecompressHandlers();

// The definitions of a type and those it is made of, as the peers have them; none of vision_msgs.
function ownDefinitions(type) {
  if (type === "foxglove_msgs/msg/SceneUpdate") {
    const text = foxglove.generateRosMsgMergedSchema(foxglove.foxgloveMessageSchemas.SceneUpdate, { rosVersion: 2 });
    return parse(text, { ros2: true });
  }
  const found = [];
  const add = (name) => {
    const definition = ros2humble[name];
    if (definition == undefined || found.includes(definition)) return definition != undefined;
    found.push(definition);
    return definition.definitions.every((field) => !field.isComplex || add(field.type));
  };
  return add(type.replace("/msg/", "/")) ? found : undefined;
}

const reader = await McapIndexedReader.Initialize({ readable: new FileHandleReadable(await open(file)), decompressHandlers });
const codecs = new Map();
for (const [id, channel] of reader.channelsById) {
  const schema = reader.schemasById.get(channel.schemaId);
  assert.equal(schema.encoding, "ros2msg");
  assert.equal(channel.messageEncoding, "cdr");
  const definitions = [parse(new TextDecoder().decode(schema.data), { ros2: true })];
  const own = ownDefinitions(schema.name);
  if (own) definitions.push(own);
  codecs.set(id, { topic: channel.topic, own: own != undefined, messages: 0,
                   pairs: definitions.map((d) => [new MessageReader(d), new MessageWriter(d)]) });
}
let messages = 0;
for await (const message of reader.readMessages({ validateCrcs: true })) {
  const codec = codecs.get(message.channelId);
  for (const [decoder, encoder] of codec.pairs) {
    const again = encoder.writeMessage(decoder.readMessage(message.data));
    assert.equal(Buffer.compare(Buffer.from(again), Buffer.from(message.data)), 0, codec.topic);
  }
  ++codec.messages;
  ++messages;
}
assert.equal(BigInt(messages), reader.statistics.messageCount);
let attachments = 0;
for await (const attachment of reader.readAttachments()) {
  assert.ok(attachment.data.length > 0);
  ++attachments;
}
assert.ok(attachments > 0);

const stream = new McapStreamReader({ decompressHandlers, validateCrcs: true });
stream.append(await readFile(file));
let streamed = 0;
for (let record; (record = stream.nextRecord()); ) {
  if (record.type === "Message") ++streamed;
}
assert.equal(streamed, messages);
for (const codec of codecs.values())
  console.log(`${codec.topic}: ${codec.messages} messages equal${codec.own ? ", also by the peers' own definitions" : ""}`);
