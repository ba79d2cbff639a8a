# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause

"""write_numpy.py FOLDER PCD_BV: NumPy writes arrays and tables, pcd_bv reads them and writes the points as .pcd, and
NumPy finds all numbers equal in it."""
import subprocess
import sys
from pathlib import Path

import numpy as np

folder, pcd_bv = Path(sys.argv[1]), sys.argv[2]
folder.mkdir(parents=True, exist_ok=True)
random = np.random.default_rng(5)


def read_pcd(path):
    content = path.read_bytes()
    header, data = content.split(b"DATA binary\n", 1)
    lines = {words[0]: words[1:] for words in (line.split() for line in header.decode().splitlines()) if words}
    types = [f"{dict(F='f', I='i', U='u')[t]}{s}" for t, s in zip(lines["TYPE"], lines["SIZE"])]
    dtype = np.dtype([(n, t, int(c)) if int(c) > 1 else (n, t) for n, t, c in zip(lines["FIELDS"], types, lines["COUNT"])])
    return np.frombuffer(data, dtype, int(lines["POINTS"][0])), [int(lines[k][0]) for k in ("WIDTH", "HEIGHT")]


count = 0


def check(path, fields, shape=None, options=()):
    global count
    out = folder / "out.pcd"
    subprocess.run([pcd_bv, "--volume", "aabb", *options, "--labels", out, path], check=True, stdout=subprocess.DEVNULL)
    points, found = read_pcd(out)
    assert list(points.dtype.names) == [*fields, "label"], (path, points.dtype)
    for name, values in fields.items():
        assert points[name].dtype == np.asarray(values).dtype, (path, name, points[name].dtype)
        np.testing.assert_array_equal(points[name].ravel(), np.asarray(values).ravel(), err_msg=f"{path} {name}")
    assert shape is None or found == list(shape), (path, found)
    count += 1


names = ["x", "y", "z", "intensity"]
for kind in ("f4", "f8", "i2", "u1", "i8"):
    for columns in (3, 4, 7):
        a = (random.normal(size=(1000, columns)) * 50).astype(kind)
        fields = {(names[i] if i < 3 or columns == 4 else f"field{i + 1}"): a[:, i] for i in range(columns)}
        np.save(folder / "a.npy", a)
        check(folder / "a.npy", fields)
        np.save(folder / "f.npy", np.asfortranarray(a))
        check(folder / "f.npy", fields)
        np.savez(folder / "a.npz", a)
        check(folder / "a.npz", fields)
        np.savez_compressed(folder / "c.npz", labels=np.arange(1000), points=a)
        check(folder / "c.npz", fields)
grid = random.normal(size=(20, 30, 3)).astype("f4")
np.save(folder / "grid.npy", grid)
check(folder / "grid.npy", dict(zip("xyz", np.moveaxis(grid, 2, 0))), (30, 20))
for aligned in (False, True):
    dtype = np.dtype([("t", "u1"), ("x", "f8"), ("y", "f4"), ("z", "i2"), ("ring", "u2"), ("n", "f4")], align=aligned)
    records = np.zeros(500, dtype)
    for name in dtype.names:
        records[name] = random.uniform(0, 200, 500).astype(dtype[name])
    np.save(folder / "records.npy", records)
    if not aligned:  # the .pcd has the gaps of aligned records as fields
        check(folder / "records.npy", {name: records[name] for name in dtype.names})
table = random.normal(size=(3000, 4)) * [1e6, 1, 1e-6, 255]
fields = dict(zip(names, table.T))
for delimiter, suffix in ((",", "csv"), (" ", "xyz"), (";", "txt"), ("\t", "asc")):
    path = folder / f"table.{suffix}"
    np.savetxt(path, table, fmt="%.17g", delimiter=delimiter)
    check(path, fields)
    np.savetxt(path, table, fmt="%.17g", delimiter=delimiter, header=delimiter.join(["X", "Y", "Z", "w"]))
    check(path, dict(zip(["X", "Y", "Z", "w"], table.T)))
    np.savetxt(path, table, fmt="%.17g", delimiter=delimiter, header=delimiter.join(["z", "y", "x", "w"]), comments="")
    check(path, dict(zip(["z", "y", "x", "w"], table.T)))
    np.savetxt(path, table[:, [3, 0, 1, 2]], fmt=["%d", "%.17g", "%.17g", "%.17g"], delimiter=delimiter)
    check(path, {"label0": table[:, 3].astype("i4"), **dict(zip("xyz", table.T))}, options=["--columns", "label0:i4,x,y,z"])
np.savetxt(folder / "scan.pts", table, fmt="%.17g", header="3000", comments="")
check(folder / "scan.pts", fields)
print(f"NumPy: {count} files equal")
