// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// check_tiles.mjs make FOLDER [TILES]: writes a tileset whose bounding volumes are wrong.
// check_tiles.mjs check FOLDER: 3d-tiles-renderer reads contents and volumes, of which each holds the points of its
// tile and of all tiles below, and is not larger than they need.
// check_tiles.mjs clusters FILE.3dtiles FILE.json: the volumes of clusters are those of the report.
// check_tiles.mjs geographic FILE.3dtiles FILE.xyz: the region holds the points in degrees, and is not larger.
import assert from "node:assert";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { PNTSLoaderBase } from "3d-tiles-renderer/core";
import { OBB, WGS84_ELLIPSOID } from "3d-tiles-renderer/three";
import { Matrix4, Sphere, Vector3 } from "three";

const [, , verb, folder, argument] = process.argv;

async function make(tiles) {
  await mkdir(folder, { recursive: true });
  let state = 7;
  const random = () => (state = (state * 48271) % 2147483647) / 2147483647 - 0.5;
  const kinds = [{ box: [9, 9, 9, 1, 0, 0, 0, 1, 0, 0, 0, 1] }, { sphere: [9, 9, 9, 1] }, { region: [0, 0, 0, 0, 0, 0] }];
  const leaves = [];
  for (let tile = 0; tile < tiles; ++tile) {
    const xyz = new Float32Array(3 * 500);
    for (let i = 0; i < xyz.length; ++i) xyz[i] = random() * [4, 2, 1][i % 3] + (i % 3 == 1 ? xyz[i - 1] / 2 : 0);
    let table = JSON.stringify({ POINTS_LENGTH: 500, POSITION: { byteOffset: 0 }, RTC_CENTER: [0, 1, 2].map(() => 900 * random()) });
    table += " ".repeat((8 - ((28 + table.length) % 8)) % 8);
    const header = Buffer.alloc(28);
    header.write("pnts");
    [1, 28 + table.length + xyz.byteLength, table.length, xyz.byteLength].forEach((n, i) => header.writeUInt32LE(n, 4 + 4 * i));
    await writeFile(`${folder}/${tile}.pnts`, Buffer.concat([header, Buffer.from(table), Buffer.from(xyz.buffer)]));
    leaves.push({ boundingVolume: kinds[tile % 3], geometricError: 0, content: { uri: `${tile}.pnts` } });
  }
  const groups = [];
  for (let i = 0; i < tiles; i += 30)
    groups.push({ boundingVolume: kinds[groups.length % 3], geometricError: 9, children: leaves.slice(i, i + 30),
                  transform: [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, groups.length, 0, 0, 1] });
  // A root at 48 degrees north, whose z axis is up.
  const root = { boundingVolume: kinds[2], geometricError: 99, refine: "ADD", children: groups,
                 transform: WGS84_ELLIPSOID.getEastNorthUpFrame(0.8378, 0.2, 0, new Matrix4()).elements };
  await writeFile(`${folder}/tileset.json`, JSON.stringify({ asset: { version: "1.1" }, geometricError: 99, root }, null, 1));
}

async function points(uri) {
  const file = await readFile(`${folder}/${uri}`);
  const { featureTable } = await new PNTSLoaderBase().parse(file.buffer.slice(file.byteOffset, file.byteOffset + file.length));
  const center = new Vector3(...featureTable.getData("RTC_CENTER", 1, "FLOAT", "VEC3"));
  const xyz = featureTable.getData("POSITION", featureTable.getData("POINTS_LENGTH"), "FLOAT", "VEC3");
  return Array.from({ length: xyz.length / 3 }, (_, i) => new Vector3(...xyz.slice(3 * i, 3 * i + 3)).add(center));
}

// How far a point is outside of a volume, in metres; negative inside.
function measure({ box, sphere, region }, to_earth) {
  if (sphere) return (p) => new Sphere(new Vector3(...sphere.slice(0, 3)), sphere[3]).distanceToPoint(p);
  if (box) {
    const axes = [3, 6, 9].map((i) => new Vector3(...box.slice(i, i + 3)));
    const center = new Vector3(...box.slice(0, 3));
    return (p) => Math.max(...axes.map((a) => Math.abs(p.clone().sub(center).dot(a)) / a.length() - a.length()));
  }
  const [west, south, east, north, low, high] = region, at = {}, scale = 6.4e6;
  return (p) => {
    const earth = p.clone().applyMatrix4(to_earth);
    WGS84_ELLIPSOID.getPositionToCartographic(earth, at);
    const height = WGS84_ELLIPSOID.getPositionElevation(earth);
    return Math.max(scale * (west - at.lon), scale * (at.lon - east), scale * (south - at.lat), scale * (at.lat - north),
                    low - height, height - high);
  };
}

const counts = {};
async function check(tile, parent) {
  const own = new Matrix4();
  if (tile.transform) own.fromArray(tile.transform);
  const to_earth = parent.clone().multiply(own);
  const inside = tile.content ? await points(tile.content.uri) : [];
  for (const child of tile.children ?? []) inside.push(...(await check(child, to_earth)));
  const outside = measure(tile.boundingVolume, to_earth), kind = Object.keys(tile.boundingVolume)[0];
  let farthest = -Infinity;
  for (const p of inside) farthest = Math.max(farthest, outside(p));
  assert.ok(farthest < 1e-6, `${kind}: a point is ${farthest} m outside`);
  if (!tile.children) assert.ok(farthest > -1e-6, `${kind}: no point at the surface, ${farthest} m`);
  if (tile.boundingVolume.box) new OBB(); // the class that draws boxes loads
  counts[kind] = (counts[kind] ?? 0) + 1;
  return inside.map((p) => p.applyMatrix4(own));
}

async function clusters() {
  const { root } = JSON.parse(await readFile(folder)), [report] = JSON.parse(await readFile(argument));
  assert.equal(root.children.length, report.clusters.length);
  root.children.forEach(({ boundingVolume: { box, sphere } }, i) => {
    const [volume] = report.clusters[i].volumes;
    if (volume.shape == "sphere") return assert.deepEqual(sphere, [...volume.center, volume.radius]);
    const half = volume.axes.flatMap((axis, k) => axis.map((x) => x * volume.half_extents[k] + 0));
    assert.deepEqual(box, [...volume.center, ...half.map((x) => (x == 0 ? 0 : x))]);
  });
  console.log(`3dtiles: ${root.children.length} volumes equal`);
}

async function geographic() {
  const { root } = JSON.parse(await readFile(folder));
  const { region } = root.children[0].boundingVolume, outside = measure({ region }, new Matrix4());
  const rows = (await readFile(argument, "utf8")).trim().split("\n").slice(1).map((row) => row.split(" ").map(Number));
  const radian = Math.PI / 180, farthest = rows.map(([longitude, latitude, height]) =>
    outside(WGS84_ELLIPSOID.getCartographicToPosition(latitude * radian, longitude * radian, height, new Vector3())));
  const worst = Math.max(...farthest);
  assert.ok(worst < 1e-6, `region: the farthest point is ${worst} m outside`);
  [[0, 0], [1, 1], [2, 0], [3, 1], [4, 2], [5, 2]].forEach(([i, column]) => {
    const values = rows.map((row) => row[column] * (column < 2 ? radian : 1));
    const extreme = i < 2 || i == 4 ? Math.min(...values) : Math.max(...values);
    assert.ok(Math.abs(region[i] - extreme) < 1e-15 * Math.max(1, Math.abs(extreme)), `region[${i}]: ${region[i]}, not ${extreme}`);
  });
  console.log(`3dtiles-region: ${rows.length} points inside`);
}

if (verb == "geographic") await geographic();
else if (verb == "make") await make(Number(argument));
else if (verb == "clusters") await clusters();
else {
  const { root } = JSON.parse(await readFile(`${folder}/tileset.json`));
  await check(root, new Matrix4());
  console.log(`3D Tiles: every point in its volumes: ${JSON.stringify(counts)}`);
}
