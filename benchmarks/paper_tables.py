# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tables 1 to 5 of "Parallel Construction of Bounding Volumes" (SIGRAD 2010) on this machine. Of the paper
itself only ratios stand here: another machine's times compare with nothing."""
from results import count, number, points_of, table

# Vertices and triangles of Table 1; speed-ups by SSE of Tables 2 and 3; of Table 4 the optimal radius over
# the longest side, and the radii by SSE; of Table 5 one core's time over that of two and of four.
PAPER = {
    4010: ("Frog", 7964),
    7260: ("Chair", 14372),
    30892: ("Tiger", 61766),
    32875: ("Bunny", 65536),
    48485: ("Horse", 96966),
    100722: ("Golfball", 201440),
    327323: ("Hand", 654666),
}
SPEED_UPS = {
    "aabb": (9.11, 8.68, 8.64, 8.62, 8.72, 8.34, 4.40),
    "dop14": (9.23, 8.25, 8.20, 8.27, 8.49, 8.17, 7.12),
    "dop26": (8.78, 7.97, 7.84, 7.95, 8.20, 7.93, 7.38),
    "sphere-epos6": (3.32, 3.67, 4.31, 4.25, 4.13, 4.38, 3.73),
    "sphere-epos14": (3.68, 4.00, 4.67, 4.67, 4.40, 4.73, 4.31),
    "sphere-epos26": (3.69, 3.73, 4.63, 4.65, 4.37, 4.74, 4.51),
    "sphere-ritter": (2.78, 3.02, 3.30, 3.27, 3.00, 3.30, 2.81),
}
RADII = {
    "optimum": (0.59903, 0.63776, 0.51397, 0.64321, 0.62897, 0.50110, 0.52948),
    "sphere-ritter": (0.65040, 0.72789, 0.53835, 0.67694, 0.63476, 0.50350, 0.52951),
    "sphere-epos6": (0.61349, 0.68974, 0.52531, 0.65017, 0.63023, 0.50154, 0.52951),
    "sphere-epos14": (0.60019, 0.64359, 0.51507, 0.64423, 0.62899, 0.50145, 0.52951),
    "sphere-epos26": (0.59903, 0.63793, 0.51507, 0.64415, 0.62897, 0.50114, 0.52950),
}
TWO_CORES = dict(zip(PAPER, ("0.23", "0.37", "1.07", "1.01", "1.20", "1.51", "1.77")))
METHODS = [
    ("Ritter", "sphere-ritter"),
    ("EPOS-6", "sphere-epos6"),
    ("EPOS-14", "sphere-epos14"),
    ("EPOS-26", "sphere-epos26"),
    ("EPOS-98", "sphere-epos98"),
    ("smallest", "sphere-exact"),
]
VOLUMES = [("AABB", "aabb"), ("14-DOP", "dop14"), ("26-DOP", "dop26")]


def of_paper(figures, cloud):
    """The paper's figure for a stand-in of its meshes, or None."""
    scene, n = cloud.split("/")[0], points_of(cloud)
    return figures[list(PAPER).index(n)] if scene == "paper" and figures else None


def point_sets(results):
    """Clouds by the end of their rows' names: the stand-ins, then the real meshes."""
    clouds = [
        name.split("/", 2)[2]
        for name in results.matching("naive-dop26/peer/.*/xyz/no-nan/")
        if "/gauss/" not in name
    ]
    if not clouds:  # a file of before the naive loops of all volumes
        clouds = [f"paper/xyz/no-nan/n:{n}" for n in PAPER]
    return clouds


def label(cloud):
    scene, n = cloud.split("/")[0], points_of(cloud)
    return f"{'as ' + PAPER[n][0] if scene == 'paper' else scene} ({count(n)})"


def table_1(results):
    lines = []
    for cloud in point_sets(results):
        scene, n = cloud.split("/")[0], points_of(cloud)
        row = results.rows.get(f"aabb/{results.best}/{cloud}", {})
        if scene == "paper":
            lines.append(
                [
                    f"as {PAPER[n][0]}",
                    count(n),
                    f"{count(PAPER[n][1])} in the paper",
                    f"generated: `synth paper-{n}`",
                ]
            )
        else:
            source = "glmark2-data" if scene == "stanford-bunny" else "libcgal-demo"
            lines.append([scene, count(n), count(round(row.get("triangles", 0))), source])
    return table(["point set", "n_v", "n_t", "source"], lines)


def speed_ups(results, work, naive=None, plain=None, peers=()):
    """ms of one core, and speed-ups over two sequential columns: S (naive loop), S' (scalar reference). Then
    others who solve the same, with the points that they leave outside."""
    lines = []
    for cloud in point_sets(results):
        sequential = results.ms(f"{naive}/peer/{cloud}")
        scalar = results.ms(f"{work}/scalar/{cloud}")
        line = [label(cloud)] + [
            number(results.ms(f"{loop}/peer/{cloud}")) for loop in (naive, plain) if loop
        ]
        line.append(number(scalar))
        for s in results.sets[1:]:
            time = results.ms(f"{work}/{s}/{cloud}")
            line.append(number(time))
            if naive:
                line.append(time and sequential and f"{sequential / time:.2f}")
            line.append(time and scalar and f"{scalar / time:.2f}")
        for peer in peers:
            row = results.rows.get(f"{peer}/peer/{cloud}")
            line += [number(row["us"][0] / 1e3), f"{row['outside']:.0f}"] if row else [None, None]
        lines.append(line + ([of_paper(SPEED_UPS[work], cloud)] if work in SPEED_UPS else []))
    head = ["point set"] + ["naive, -O2"] * bool(naive) + ["plain, -O3"] * bool(plain) + ["scalar, -O3"]
    head += [h for s in results.sets[1:] for h in ([s, "S", "S'"] if naive else [s, "S'"])]
    head += [h for peer in peers for h in (peer, "outside")]
    return table(head + ["paper's S"] * (work in SPEED_UPS), lines)


def table_2(results):
    plain = {"dop26": "plain-dop26"}
    parts = [
        f"{title}, ms:\n\n{speed_ups(results, work, f'naive-{work}', plain.get(work))}"
        for title, work in VOLUMES
    ]
    return "\n\n".join(parts)


def table_3(results):
    cgal = ("cgal-min-sphere", "cgal-min-sphere-of-spheres")
    parts = [
        f"{title}, ms:\n\n{speed_ups(results, work, peers=cgal if work == 'sphere-exact' else ())}"
        for title, work in METHODS
    ]
    return "\n\n".join(parts)


def table_4(results):
    """Radii over the box's longest side, in brackets over the optimum; then the paper's, over its optimum."""
    lines = []
    for cloud in point_sets(results):
        rows = [results.rows.get(f"{work}/{results.best}/{cloud}", {}) for _, work in METHODS]
        if not all("radius" in row for row in rows):
            continue
        line = [label(cloud), f"{rows[-1]['radius']:.5f}"]
        line += [f"{r['radius']:.5f} ({100 * (r['over_optimum'] - 1):.2f} %)" for r in rows[:-1]]
        if cloud.startswith("stanford-bunny"):
            cloud = "paper/xyz/no-nan/n:32875"  # that very mesh, of which glmark2 has more vertices
        optimum = of_paper(RADII["optimum"], cloud)
        line.append(optimum and f"{optimum:.5f}")
        for method in ("sphere-ritter", "sphere-epos26"):
            radius = of_paper(RADII[method], cloud)
            line.append(radius and f"{100 * (radius / optimum - 1):.2f} %")
        lines.append(line)
    return table(
        ["point set", "optimum"]
        + [title for title, _ in METHODS[:-1]]
        + ["paper: optimum", "Ritter over it", "EPOS-26 over it"],
        lines,
    )


def table_5(results):
    """26-DOP: ms on one core and on more (minima of pairs in turns), the median of the pairs' ratios."""
    names = results.matching(r"threads-\d+/[^/]*/[^/]*/(?!gauss)[^/]*/xyz/no-nan/n:\d+/wait:own")
    kinds = sorted(
        {tuple(name.split("/")[:3]) for name in names}, key=lambda k: (k[0], results.sets.index(k[2]))
    )
    head, lines = ["point set"], []
    for threads, _, s in kinds:
        cores = threads.split("-")[1]
        head += [f"{s}, 1 core", f"{cores} cores", "ratio"]
    for cloud in point_sets(results):
        line = [label(cloud)]
        for threads, work, s in kinds:
            row = results.rows.get(f"{threads}/{work}/{s}/{cloud}/wait:own")
            line += (
                [number(row["first_us"] / 1e3), number(row["second_us"] / 1e3), f"{row['ratio']:.2f}"]
                if row
                else [None] * 3
            )
        scene, n = cloud.split("/")[0], points_of(cloud)
        lines.append(line + [TWO_CORES[n] if scene == "paper" else None])
    return table(head + ["paper: 2 cores"], lines)
