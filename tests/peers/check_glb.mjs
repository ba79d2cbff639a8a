// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// check_glb.mjs FILE.glb FILE.ply FILE.json: Khronos' validator finds nothing, and three.js' loader finds the objects of
// the report, with the vertices of the .ply file as floats, and points.
import assert from "node:assert";
import { readFile } from "node:fs/promises";
import validator from "gltf-validator";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { PLYLoader } from "three/addons/loaders/PLYLoader.js";

const [, , glb, ply, json] = process.argv;
globalThis.self = globalThis; // a name of browsers that the loader uses
const bytes = async (name) => {
  const file = await readFile(name);
  return file.buffer.slice(file.byteOffset, file.byteOffset + file.length);
};
const { issues } = await validator.validateBytes(new Uint8Array(await bytes(glb)));
assert.equal(issues.numErrors + issues.numWarnings, 0, JSON.stringify(issues.messages.slice(0, 5)));

const { scene, parser } = await new GLTFLoader().parseAsync(await bytes(glb), "");
scene.updateMatrixWorld(true);
const [report] = JSON.parse(await readFile(json));
const root = scene.children[0];
const expected = report.clusters.flatMap(({ id, points, volumes }) =>
  volumes.map(({ method, volume }) => ({ id, points, method, volume })));
const objects = root.children.filter(({ name }) => name != "points");
assert.deepEqual(objects.map(({ userData: { id, points, method, volume } }) => ({ id, points, method, volume })), expected);

// The matrix maps x, y, z to x, z, -y, and adds the origin.
const m = parser.json.nodes.at(-1).matrix, origin = [m[12], -m[14], m[13]];
assert.deepEqual([...m.slice(0, 12)], [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0]);
m.forEach((x, i) => assert.ok(Math.abs(root.matrix.elements[i] - x) < 1e-15 * (1 + Math.abs(x))));
// The loader's arrays of .ply are floats, so the doubles are read here; the header says how many there are.
const file = await readFile(ply), end = file.indexOf("end_header\n") + 11;
const count = Number(/element vertex (\d+)/.exec(file.subarray(0, end).toString())[1]);
assert.equal(new PLYLoader().parse(await bytes(ply)).attributes.position.count > 0, true);
let vertex = 0;
for (const object of objects) {
  const mesh = object.isMesh || object.isLineSegments || object.isPoints ? object : object.children[0];
  const { array, count: n } = mesh.geometry.attributes.position;
  for (let i = 0; i < n; ++i, ++vertex)
    for (let axis = 0; axis < 3; ++axis)
      assert.equal(array[3 * i + axis], Math.fround(file.readDoubleLE(end + 27 * vertex + 8 * axis) - origin[axis]));
}
assert.equal(vertex, count);
const cloud = root.children.find(({ name }) => name == "points");
assert.ok(cloud.isPoints && cloud.geometry.attributes.position.count > 1000);
console.log(`glTF: ${objects.length} volumes, ${vertex} vertices equal, ${cloud.geometry.attributes.position.count} points`);
