# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""The machine and its limit, peers, growth, and everything else that is no table of the paper: text in Markdown."""
from results import LEVELS, count, exponent, number, percent, points_of, table


def machine(results):
    m = results.machine
    caches = ", ".join(f"{size >> 10} KB {name}" for name, size in m["caches"].items())
    compilers = sorted({part["compiler"] for part in results.parts.values()})
    return (f"{m['cpu']}, family {m['family']}, model {m['model']}; {m['cores']} cores; {caches}; "
            f"{m['memory_mb'] / 1024:.0f} GB of memory; Linux {m['kernel']}; {', '.join(compilers)}; instruction sets "
            f"{', '.join(results.sets)}. Source of every figure: [{results.path.name}](../benchmarks/results/{results.path.name}).")


def parts(results):
    return table(["part", "commit", "date", "seconds", "load of the machine at its start"],
                 [[f"`{name}`", p["commit"], p["date"], p["seconds"], p["load"]] for name, p in results.parts.items()])


def limit(results):
    """GB/s that pass, by size: reading alone, and our passes."""
    sizes = sorted({points_of(n) for n in results.matching("read-1-thread/best/gauss/xyz/no-nan")})
    lines = []
    for n in sizes:
        cloud = f"gauss/xyz/no-nan/n:{n}"
        line = [results.bandwidth(f"read-{t}-thread/best/{cloud}") for t in (1, 2)]
        line += [results.bandwidth(f"{work}/{results.best}/{cloud}") for work in ("aabb", "dop26", "sphere-epos26")]
        lines.append([count(n), f"{16 * n / 1e6:.3g}"] + [number(v) for v in line])
    return table(["points", "MB", "read, one core", "read, two cores", f"AABB {results.best}, one core", "26-DOP",
                  "EPOS-26 (two passes)"], lines)


def growth(results):
    works = [(work, s) for work in ("aabb", "dop14", "dop26", "sphere-epos26", "sphere-exact") for s in results.sets]
    series = [(f"{w} {s}", [(points_of(n), results.us(n)) for n in results.matching(f"{w}/{s}/gauss/xyz/no-nan/")
                            if points_of(n) & (points_of(n) - 1) == 0]) for w, s in works]
    series.append(("clusters, 0.5 m, synth:street",
                   [(points_of(n), results.us(n)) for n in results.matching("clusters/street/")]))
    lines = []
    for label, pairs in series:
        if len(pairs) < 4:
            continue
        pairs.sort()
        per_point = {n: 1e3 * us / n for n, us in pairs}
        middle = min(per_point, key=lambda n: abs(n - 1e6))
        shown = [pairs[0][0], middle, pairs[-1][0]]
        lines.append([label, f"{count(shown[0])} to {count(shown[-1])}", f"{exponent(pairs):.3f}"]
                     + [number(per_point[n]) for n in shown])
    return table(["one thread", "points", "exponent", "ns a point at the least", "at about 1 M", "at the most"], lines)


def outside(row):
    return f"{row['outside']:.0f}" if row and "outside" in row else None


def box_peers(results):
    """Mpt/s in each level of memory, and the points left outside in the last."""
    lines = []
    for work in ("aabb", "dop26"):
        lines.append([f"{work} {results.best}"] + [number(results.speed(f"{work}/{results.best}/gauss/xyz/no-nan/n:{n}"))
                                                  for n in LEVELS] + ["0"])
    seen = dict.fromkeys(tuple(n.split("/")[i] for i in (0, 3)) for n in results.matching("[^/]*/peer/gauss/[^/]*/no-nan"))
    for peer, layout in seen:
        names = [f"{peer}/peer/gauss/{layout}/no-nan/n:{n}" for n in LEVELS]
        lines.append([peer] + [number(results.speed(n)) for n in names] + [outside(results.rows.get(names[-1]))])
    return table(["Mpt/s, one thread"] + [f"{level}, {count(n)}" for n, level in LEVELS.items()]
                 + [f"outside of {count(16000000)}"], lines)


def sphere_peers(results):
    lines = []
    for shape in ("gauss", "cube", "ball", "car", "golfball", "surface"):
        for n in (300, 100722, 1000000):
            cloud = f"{shape}/xyz/no-nan/n:{n}"
            line = [shape, count(n), number(results.ms(f"sphere-exact/{results.best}/{cloud}"))]
            for peer in ("cgal-min-sphere", "cgal-min-sphere-of-spheres"):
                line += [number(results.ms(f"{peer}/peer/{cloud}")), outside(results.rows.get(f"{peer}/peer/{cloud}"))]
            lines.append(line)
    return table(["points of", "points", f"smallest sphere {results.best}, ms (0 outside)", "Min_sphere_d, ms", "outside",
                  "Min_sphere_of_spheres_d, ms", "outside"], lines)


def radii_of_shapes(results):
    methods = ("sphere-ritter", "sphere-epos6", "sphere-epos14", "sphere-epos26", "sphere-epos98")
    lines = []
    for shape in ("gauss", "cube", "ball", "car", "golfball", "surface"):
        for n in (300, 100722, 1000000):
            rows = [results.rows.get(f"{m}/{results.best}/{shape}/xyz/no-nan/n:{n}") for m in methods]
            lines.append([f"{shape} ({count(n)})"] + [r and percent(100 * (r["over_optimum"] - 1), 3) for r in rows])
    return table(["radius over the smallest", "Ritter", "EPOS-6", "EPOS-14", "EPOS-26", "EPOS-98"], lines)


def ways_to_grow(results):
    lines = []
    for name in results.matching(r"[^/]*\+[^/]*/1-thread/"):
        both = [results.rows[name], results.rows[name.replace("1-thread", "2-threads")]]
        lines.append([name.split("/")[0].replace("+", ", "), count(points_of(name))]
                     + [number(points_of(name) / r["us"][0]) for r in both]
                     + [percent(100 * (both[0]["over_optimum"] - 1), 3)])
    return table(["points in a ball", "points", "Mpt/s, one thread", "two", "over the smallest"], lines)


def in_turns(results, pattern, sides, name_of=lambda n: n, peer=True):
    """Both times in ms (minima), the ratio, and the points outside a peer's box."""
    lines = []
    for name in results.matching(pattern):
        row = results.rows[name]
        ratio, of_minima = results.ratio(name)
        lines.append([name_of(name), number(row["first_us"] / 1e3), number(row["second_us"] / 1e3),
                      f"{number(ratio)} ({number(of_minima)})"] + ([outside(row)] if peer else []))
    return table(["in turns", *sides, "ratio: median of pairs (of minima)"] + (["outside"] if peer else []), lines)


def cluster_peers(results):
    def say(name):
        peer, scene, n, r = name.removeprefix("over-").split("/")
        return f"{peer}: {scene}, {count(points_of(n))} points, {r[2:]} m"
    return in_turns(results, "over-(pcl|nanoflann)/", ("peer, ms", "ours, ms"), say, False)


def cluster_threads(results):
    return in_turns(results, "threads-2/(street|sheets|sparse)", ("one thread, ms", "two, ms"),
                    lambda n: n.removeprefix("threads-2/"), False)


def ground(results):
    lines = [[n, number(results.ms(n)), f"{results.rows[n]['precision']:.4f}", f"{results.rows[n]['recall']:.4f}"]
             for n in results.matching("ground/")]
    return table(["synth:street, one thread", "ms", "precision", "recall"], lines)


def oriented(results):
    """ms and volume over the least known, by method and cloud."""
    clouds = dict.fromkeys(n.split("/")[2] for n in results.matching("obb-min/"))
    methods = ("obb-pca", "obb-dito14", "obb-yaw", "obb-lshape", "obb-min")
    lines = []
    for cloud in clouds:
        rows = [results.rows[f"{m}/{results.best}/{cloud}"] for m in methods]
        lines.append([cloud] + [f"{number(r['us'][0] / 1e3)} ({r['over_least']:.3f})" for r in rows])
    return table(["ms (volume over the least known)", *methods], lines)


def oriented_peers(results):
    return in_turns(results, "turns/", ("peer, ms", "ours, ms"), lambda n: n.removeprefix("turns/"))


def hulls(results):
    """ms; of what is fitted to the hull also the volume over the hull's."""
    lines = []
    for name in results.matching(f"hull/{results.best}/"):
        cloud = name.split("/", 2)[2]
        line = [f"{cloud.split('/')[0]} ({count(points_of(cloud))})", number(results.ms(f"hull/scalar/{cloud}")),
                number(results.ms(name))]
        line += [number(results.ms(f"{peer}/peer/{cloud}")) for peer in ("pcl::ConvexHull", "qhull-of-all-points")]
        line.append(outside(results.rows.get(f"pcl::ConvexHull/peer/{cloud}")))
        for work in ("cylinder", "capsule", "ellipsoid", "best"):
            row = results.rows.get(f"{work}/{results.best}/{cloud}")
            line.append(row and f"{number(row['us'][0] / 1e3)} ({row['over_hull']:.2f})")
        lines.append(line)
    return table(["ms (volume over the hull's)", "hull scalar", f"hull {results.best}", "pcl::ConvexHull",
                  "Qhull on all points", "outside PCL's", "cylinder", "capsule", "ellipsoid", "best"], lines)


def batches(results):
    return in_turns(results, "batch/", ("one by one, ms", "at once, ms"), lambda n: n.removeprefix("batch/"), False)


def pipeline(results):
    stages = ("filter", "ground", "cluster", "fit", "track", "total")
    lines = []
    for name in results.matching("pipeline/"):
        run = results.rows[name]
        lines.append([name[9:], f"{run['clusters']:.0f}"]
                     + [f"{number(run[s + '_p50'])} / {number(run[s + '_p99'])}" if s + "_p50" in run else None
                        for s in stages] + [number(run["max"]), number(run.get("first_max"))])
    return table(["ms, 50th / 99th percentile", "clusters", *stages, "greatest", "of the first five"], lines)


def speeds(results, works, clouds):
    """Mpt/s of each work and set in each cloud."""
    lines = [[f"{work} {s}"] + [number(results.speed(f"{work}/{s}/{cloud}")) for _, cloud in clouds]
             for work, sets in works for s in sets]
    return table(["Mpt/s, one thread"] + [label for label, _ in clouds], lines)


def levels(results):
    works = ("aabb", "dop14", "dop18", "dop26", "dop26-points", "unchecked-aabb", "unchecked-dop26", "tested-dop26")
    return speeds(results, [(w, results.sets) for w in works],
                  [(f"{v}, {count(n)}", f"gauss/xyz/no-nan/n:{n}") for n, v in LEVELS.items()])


def layouts(results):
    names = ("xyz", "packed", "xyzi", "indices", "groups", "double")
    return speeds(results, [("aabb", results.sets), ("dop26", results.sets)],
                  [(f"{LEVELS[n]} {x}", f"gauss/{x}/no-nan/n:{n}") for n in (32768, 16000000) for x in names])


def bad_points(results):
    works = [("aabb", results.sets), ("dop26", results.sets), ("pcl-dense", ["peer"]), ("pcl-non-dense", ["peer"])]
    return speeds(results, works, [(f"{LEVELS[n]} {b}", f"gauss/xyz/{b}/n:{n}") for n in (32768, 16000000)
                                   for b in ("no-nan", "one-nan", "1pc-nan")])


def scenes(results):
    return speeds(results, [("aabb", results.sets), ("dop26", results.sets)],
                  [(x, f"{x}/xyz/no-nan/n:128000") for x in ("gauss", "cube", "street")])
