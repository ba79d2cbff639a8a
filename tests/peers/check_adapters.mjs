// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// check_adapters.mjs FILE.mcap FRAMES.jsonl [LABELS]: decodes the messages for MoveIt, Nav2 and vision_msgs by the definitions in
// the file, and compares their numbers with those of the JSON that the same run, without poses, wrote. FILE has the
// labelled points, too. LABELS is a JSON object with the names of classes.
import assert from "node:assert";
import { open, readFile } from "node:fs/promises";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import { loadDecompressHandlers } from "@mcap/support";

const [recording, json, labels] = process.argv.slice(2);
const frames = new Map(); // by stamp
for (const line of (await readFile(json, "utf8")).trim().split("\n")) {
  const frame = JSON.parse(line);
  frames.set(BigInt(frame.stamp_ns), frame);
}

const decompressHandlers = await loadDecompressHandlers();
const reader = await McapIndexedReader.Initialize({ readable: new FileHandleReadable(await open(recording)), decompressHandlers });
const topics = new Map();
for (const channel of reader.channelsById.values()) {
  const schema = reader.schemasById.get(channel.schemaId);
  const decoder = new MessageReader(parse(new TextDecoder().decode(schema.data), { ros2: true }));
  topics.set(channel.topic, { type: schema.name, messages: [] });
  for await (const message of reader.readMessages({ topics: [channel.topic] }))
    topics.get(channel.topic).messages.push(decoder.readMessage(message.data));
  assert.ok(topics.get(channel.topic).messages.length > 0 || channel.topic === "/bv/label_info", channel.topic);
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
const taken = () => [numbers, (numbers = 0)][0];
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
  console.log(`MoveIt: ${next - removed} objects (${[...kinds]}), ${removed} removed, ${taken()} numbers equal`);
}

// The bounds of a volume that has simple ones.
function boundsOf(volume) {
  if (volume.shape === "aabb") return [volume.min, volume.max];
  const around = (reach) => [volume.center.map((c, k) => c - reach[k]), volume.center.map((c, k) => c + reach[k])];
  if (volume.shape === "sphere") return around([0, 0, 0].fill(volume.radius));
  const reach = [0, 1, 2].map((k) => volume.axes.reduce((sum, axis, i) => sum + Math.abs(axis[k]) * volume.half_extents[i], 0));
  return around(reach);
}

const single = new Float32Array(1);
const asFloat = (value) => ((single[0] = value), single[0]);

function checkNav2() {
  let obstacles = 0, polygons = 0, cleared = 0;
  const ids = new Map();
  for (const { header, obstacles: found } of messagesOf("/bv/obstacles", "nav2_dynamic_msgs/msg/ObstacleArray")) {
    const { clusters } = frameOf(header);
    assert.equal(found.length, clusters.length);
    clusters.forEach((cluster, i) => {
      const { uuid, score, position, velocity, size, position_covariance: place, velocity_covariance: motion } = found[i];
      const bounds = cluster.volumes.map(boundsOf);
      const low = [0, 1, 2].map((k) => Math.max(...bounds.map(([min]) => min[k])));
      const high = [0, 1, 2].map((k) => Math.min(...bounds.map(([, max]) => max[k])));
      equal(list(position), low.map((value, k) => (value + high[k]) / 2), "position", 1e-9);
      equal(list(size), low.map((value, k) => high[k] - value), "size", 1e-9);
      assert.equal(score, 1);
      const id = [...uuid.uuid].join();
      if (cluster.track == null) {
        equal([place[0], motion[0], ...list(velocity)], [-1, -1, 0, 0, 0], "no motion");
      } else {
        equal(list(velocity), cluster.velocity, "velocity");
        const c = cluster.covariance;
        equal([...place], [c[0], c[1], c[2], c[1], c[6], c[7], c[2], c[7], c[11]], "covariance");
        equal([...motion], [c[18], c[19], 0, c[19], c[20], 0, 0, 0, Math.max(c[18], c[20])], "covariance");
        assert.equal(ids.get(cluster.track) ?? id, id);
        ids.set(cluster.track, id);
      }
      ++obstacles;
    });
  }
  assert.equal(new Set(ids.values()).size, ids.size);
  const footprints = messagesOf("/bv/footprints", "geometry_msgs/msg/PolygonStamped");
  let next = 0;
  for (const { header, polygon } of messagesOf("/bv/polygons", "geometry_msgs/msg/PolygonInstanceStamped")) {
    const { clusters } = frameOf(header);
    const cluster = clusters.find((c) => Number(polygon.id) === (c.track ?? -1 - c.id));
    if (polygon.polygon.points.length === 0) {
      assert.equal(cluster, undefined);
      ++cleared;
      continue;
    }
    assert.deepEqual(footprints[next++], { header, polygon: polygon.polygon });
    const box = cluster.volumes.find((volume) => volume.shape === "obb");
    const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([u, v]) =>
      [0, 1].map((k) => box.center[k] + u * box.half_extents[0] * box.axes[0][k] + v * box.half_extents[1] * box.axes[1][k]));
    assert.equal(polygon.polygon.points.length, 4);
    for (const { x, y, z } of polygon.polygon.points) {
      assert.ok(corners.some(([a, b]) => Math.hypot(a - x, b - y) < 1e-5), `${x} ${y} is no corner of ${corners}`);
      assert.ok(Math.abs(z - asFloat(box.center[2] - box.half_extents[2])) < 1e-5);
      numbers += 3;
    }
    ++polygons;
  }
  assert.equal(next, footprints.length);
  console.log(`Nav2: ${obstacles} obstacles of ${ids.size} tracks, ${polygons} polygons, ${cleared} cleared, ${taken()} numbers equal`);
}

function checkVision() {
  const detections = new Map(messagesOf("/bv/objects", "vision_msgs/msg/Detection3DArray").map((m) => [stampOf(m.header), m]));
  let boxes = 0, points = 0;
  for (const { header, boxes: list } of messagesOf("/bv/boxes", "vision_msgs/msg/BoundingBox3DArray")) {
    frameOf(header);
    assert.deepEqual(list, detections.get(stampOf(header)).detections.map((detection) => detection.bbox));
    boxes += list.length;
  }
  const labelled = new Map(messagesOf("/bv/points", "sensor_msgs/msg/PointCloud2").map((m) => [stampOf(m.header), m]));
  const rowsOf = ({ data, point_step: step, width }) => {
    const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
    const rows = [];
    for (let i = 0; i < width; ++i)
      rows.push({ label: view.getUint32(step * i + 12, true), xyz: [0, 4, 8].map((at) => view.getFloat32(step * i + at, true)) });
    return rows;
  };
  for (const cloud of messagesOf("/bv/detection_points", "sensor_msgs/msg/PointCloud2")) {
    const { clusters } = frameOf(cloud.header);
    assert.deepEqual(cloud.fields.map((field) => field.name), ["x", "y", "z", "detection"]);
    const expected = clusters.map(() => []);
    for (const { label, xyz } of rowsOf(labelled.get(stampOf(cloud.header))))
      if (label < clusters.length) expected[label].push(xyz.join());
    const found = clusters.map(() => []);
    for (const { label, xyz } of rowsOf(cloud)) found[label].push(xyz.join());
    found.forEach((list, i) => assert.deepEqual(list.sort(), expected[i].sort()));
    assert.equal(cloud.width, clusters.reduce((sum, cluster) => sum + cluster.points, 0));
    points += cloud.width;
  }
  console.log(`vision_msgs: ${boxes} boxes and ${points} points of detections equal`);
}

function checkLabels(expected) {
  const infos = messagesOf("/bv/label_info", "vision_msgs/msg/LabelInfo");
  assert.equal(infos.length, 1);
  const [{ header, class_map: classes, threshold }] = infos;
  frameOf(header);
  assert.equal(threshold, 0);
  assert.deepEqual(Object.fromEntries(classes.map((known) => [known.class_id, known.class_name])), expected);
  const channel = [...reader.channelsById.values()].find(({ topic }) => topic === "/bv/label_info");
  assert.ok(channel.metadata.get("offered_qos_profiles").includes("durability: 1")); // transient local
  console.log(`vision_msgs: names of ${classes.length} classes equal`);
}

if (topics.has("/bv/planning_scene")) checkMoveIt();
if (topics.has("/bv/obstacles")) checkNav2();
if (topics.has("/bv/detection_points") && topics.has("/bv/points")) checkVision();
if (labels) checkLabels(JSON.parse(labels));
