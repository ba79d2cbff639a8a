// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// check_adapters.mjs FILE.mcap FRAMES.jsonl: decodes the messages for MoveIt by the definitions in the file, and
// compares all their numbers with those of the JSON that the same run wrote.
import assert from "node:assert";
import { open, readFile } from "node:fs/promises";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import { loadDecompressHandlers } from "@mcap/support";

const [recording, json] = process.argv.slice(2);
const frames = new Map(); // by stamp
for (const line of (await readFile(json, "utf8")).trim().split("\n")) {
  const frame = JSON.parse(line);
  frames.set(BigInt(frame.stamp_ns), frame);
}

const decompressHandlers = await loadDecompressHandlers();
const reader = await McapIndexedReader.Initialize({ readable: new FileHandleReadable(await open(recording)), decompressHandlers });
const topics = new Map();
for (const [id, channel] of reader.channelsById) {
  const schema = reader.schemasById.get(channel.schemaId);
  const decoder = new MessageReader(parse(new TextDecoder().decode(schema.data), { ros2: true }));
  topics.set(channel.topic, { type: schema.name, messages: [] });
  for await (const message of reader.readMessages({ topics: [channel.topic] }))
    topics.get(channel.topic).messages.push(decoder.readMessage(message.data));
  assert.equal(topics.size > 0, true, id);
}

function messagesOf(topic, type) {
  assert.equal(topics.get(topic)?.type, type, topic);
  return topics.get(topic).messages;
}
const stampOf = ({ stamp }) => BigInt(stamp.sec) * 1_000_000_000n + BigInt(stamp.nanosec);
const frameOf = (header) => {
  const frame = frames.get(stampOf(header));
  assert.equal(header.frame_id, frame.frame_id);
  return frame;
};
const list = ({ x, y, z }) => [x, y, z];
let numbers = 0;
function equal(found, expected, what, tolerance = 0) {
  assert.equal(found.length, expected.length, what);
  expected.forEach((value, i) => assert.ok(Math.abs(found[i] - value) <= tolerance, `${what}: ${found} is not ${expected}`));
  numbers += expected.length;
}
const rotated = ({ x, y, z, w }, [a, b, c]) => {
  const t = [2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)];
  return [a + w * t[0] + y * t[2] - z * t[1], b + w * t[1] + z * t[0] - x * t[2], c + w * t[2] + x * t[1] - y * t[0]];
};

const shapes = {
  aabb: (volume, { pose, primitives }) => {
    equal(list(pose.position), volume.min.map((low, k) => (low + volume.max[k]) / 2), "centre", 1e-12);
    equal([...primitives[0].dimensions], volume.min.map((low, k) => volume.max[k] - low), "size");
    return 1;
  },
  obb: (volume, { pose, primitives }) => {
    equal(list(pose.position), volume.center, "centre");
    const { x, y, z, w } = pose.orientation;
    equal([x, y, z, w], volume.quaternion, "quaternion");
    equal([...primitives[0].dimensions], volume.half_extents.map((half) => 2 * half), "size");
    return 1;
  },
  sphere: (volume, { pose, primitives }) => {
    equal(list(pose.position), volume.center, "centre");
    equal([...primitives[0].dimensions], [volume.radius], "radius");
    return 2;
  },
  cylinder: (volume, { pose, primitives }) => {
    equal(list(pose.position), volume.center, "centre");
    equal(rotated(pose.orientation, [0, 0, 1]), volume.axis, "axis", 1e-12);
    equal([...primitives[0].dimensions], [2 * volume.half_height, volume.radius], "height and radius");
    return 3;
  },
  hull: (volume, { pose, meshes }) => {
    const [x, y, z] = list(pose.position);
    assert.equal(meshes[0].vertices.length, volume.vertices.length);
    volume.vertices.forEach((vertex, i) => {
      const at = meshes[0].vertices[i];
      equal([x + at.x, y + at.y, z + at.z], vertex, "vertex", 1e-12);
    });
    assert.ok(meshes[0].triangles.length >= 2);
    for (const { vertex_indices: corners } of meshes[0].triangles)
      assert.ok(new Set(corners).size === 3 && Math.max(...corners) < volume.vertices.length);
    return undefined;
  },
};

function checkMoveIt() {
  const alone = messagesOf("/bv/collision_object", "moveit_msgs/msg/CollisionObject");
  const alive = new Set(), adds = new Set(), kinds = new Set();
  let next = 0, removed = 0;
  for (const scene of messagesOf("/bv/planning_scene", "moveit_msgs/msg/PlanningScene")) {
    assert.ok(scene.is_diff && scene.robot_state.is_diff);
    adds.clear();
    for (const object of scene.world.collision_objects) {
      assert.deepEqual(alone[next++], object);
      if (object.operation === 1) {
        assert.ok(alive.delete(object.id), object.id);
        ++removed;
        continue;
      }
      assert.equal(object.operation, 0);
      const frame = frameOf(object.header);
      const cluster = frame.clusters.find((c) => object.id === (c.track == null ? `bv_cluster_${c.id}` : `bv_${c.track}`));
      const volume = cluster.volumes[0];
      const type = shapes[volume.shape](volume, object);
      if (type != undefined) assert.equal(object.primitives[0].type, type);
      assert.equal(object.primitives.length + object.meshes.length, 1);
      kinds.add(volume.shape);
      assert.ok(scene.object_colors.some((colour) => colour.id === object.id));
      alive.add(object.id);
      adds.add(object.id);
    }
    if (adds.size > 0) {
      const frame = frameOf(scene.world.collision_objects[0].header);
      assert.equal(adds.size, frame.clusters.filter((c) => c.volumes.length > 0).length);
    }
  }
  assert.equal(next, alone.length);
  assert.equal(alive.size, 0, "objects are left at the end");
  console.log(`MoveIt: ${next - removed} objects (${[...kinds]}), ${removed} removed, ${numbers} numbers equal`);
}

checkMoveIt();
