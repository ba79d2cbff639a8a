// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// check_labels.mjs FOLDER: the boxes of boxes.json and those of boxes.kitti, .nuscenes, .openlabel and .sustech, whose
// rotations three.js computes by the conventions of each format, are the same: sizes and centres equal, corners to
// 1e-12.
import assert from "node:assert";
import { readFile } from "node:fs/promises";
import { Euler, Matrix4, Quaternion, Vector3 } from "three";

const text = (name) => readFile(`${process.argv[2]}/boxes.${name}`, "utf8");
const json = async (name) => JSON.parse(await text(name));

function corners(center, rotation, size) {
  const matrix = new Matrix4().makeRotationFromQuaternion(rotation);
  matrix.setPosition(new Vector3(...center));
  const found = [];
  for (let i = 0; i < 8; ++i) {
    const sign = (bit) => ((i >> bit) & 1 ? 0.5 : -0.5);
    const corner = new Vector3(sign(0) * size[0], sign(1) * size[1], sign(2) * size[2]).applyMatrix4(matrix);
    found.push([corner.x, corner.y, corner.z]);
  }
  return found;
}

const expected = (await json("json"))[0].clusters.map(({ volumes: [box] }) => {
  const size = box.half_extents.map((half) => 2 * half);
  return { center: box.center, size, corners: corners(box.center, new Quaternion(...box.quaternion), size) };
});
assert.ok(expected.length > 5);

function compare(format, boxes, exact = 3) {
  assert.equal(boxes.length, expected.length, format);
  boxes.forEach(({ center, size, rotation }, i) => {
    assert.deepEqual(size, expected[i].size, format);
    assert.deepEqual(center.slice(0, exact), expected[i].center.slice(0, exact), format);
    corners(center, rotation, size).forEach((corner, k) =>
      corner.forEach((x, axis) => assert.ok(Math.abs(x - expected[i].corners[k][axis]) < 1e-12, `${format} ${i} ${k}`)));
  });
  console.log(`${format}: ${boxes.length} boxes equal`);
}

// KITTI: object to camera is a rotation about y; the camera's x, y, z are the cloud's -y, -z, x.
const toCloud = new Matrix4().set(0, 0, 1, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 1);
const objectToCamera = new Matrix4().set(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1); // length x, width, height up
compare("kitti", (await text("kitti")).trim().split("\n").map((line) => {
  const words = line.split(" ");
  assert.equal(words.length, 15);
  const [h, w, l, x, y, z, ry] = words.slice(8).map(Number);
  const axes = new Matrix4().multiplyMatrices(toCloud, new Matrix4().makeRotationY(ry)).multiply(objectToCamera);
  return { center: [z, -x, h / 2 - y], size: [l, w, h], rotation: new Quaternion().setFromRotationMatrix(axes) };
}), 2);
const [boxes] = Object.values((await json("nuscenes")).results);
compare("nuscenes", boxes.map(({ translation, size: [w, l, h], rotation: [qw, qx, qy, qz] }) =>
  ({ center: translation, size: [l, w, h], rotation: new Quaternion(qx, qy, qz, qw) })));
// What ASAM's schema demands; ./bootstrap check peers compares with the schema itself where OPENLABEL_SCHEMA names it.
const key = /^(-?[0-9]+|[0-9a-fA-F]{8}-[0-9a-fA-F]{4}-[0-9a-fA-F]{4}-[0-9a-fA-F]{4}-[0-9a-fA-F]{12})$/;
for (const name of ["openlabel", "frames.openlabel"]) {
  const { metadata, coordinate_systems, objects } = (await json(name)).openlabel;
  assert.equal(metadata.schema_version, "1.0.0");
  for (const [uid, { name, type, object_data }] of Object.entries(objects)) {
    assert.match(uid, key);
    assert.ok(typeof name == "string" && typeof type == "string" && object_data.cuboid.length == 1);
    assert.equal(object_data.cuboid[0].val.length, 10);
    assert.ok(object_data.cuboid[0].coordinate_system in coordinate_systems);
  }
}
compare("openlabel", Object.values((await json("openlabel")).openlabel.objects).map((object) => {
  const { val } = object.object_data.cuboid[0];
  return { center: val.slice(0, 3), size: val.slice(7), rotation: new Quaternion(...val.slice(3, 7)) };
}));
compare("sustech", (await json("sustech")).map(({ psr: { position, scale, rotation } }) => ({
  center: [position.x, position.y, position.z], size: [scale.x, scale.y, scale.z],
  rotation: new Quaternion().setFromEuler(new Euler(rotation.x, rotation.y, rotation.z, "XYZ")) })));
