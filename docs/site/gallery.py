# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""The gallery: pictures with the commands that draw them, and the examples with their code and output."""
import html
import os
import re
import subprocess
import sys
import tempfile

from pages import ROOT, highlighted

OBJECTS = "--range 1:40 --ground zones --cluster 0.5 --min-size 30"
# Title, and commands that write the picture NAME.png.
PICTURES = {
    "street": ("Objects of a street", f"""synth street:128000:2 street.pcd
pcd_bv {OBJECTS} --image street.png street.pcd"""),
    "above": ("The same from above, as 26-DOPs", f"""synth street:128000:2 street.pcd
pcd_bv {OBJECTS} --volume dop26 --view top --image above.png street.pcd"""),
    "shapes": ("Four volumes around one object", """synth paper-4010 frog.pcd
pcd_bv --volume aabb,obb-min,sphere-exact,dop26 --image shapes.png frog.pcd"""),
    "hull": ("The convex hull", """synth paper-4010 frog.pcd
pcd_bv --volume hull --image hull.png frog.pcd"""),
    "prisms": ("Outlines that follow bays", f"""synth rural-road:128000:1 road.pcd
pcd_bv {OBJECTS} --volume prism --concave 0.5 --image prisms.png road.pcd"""),
    "tile": ("Objects of a map", """synth town-objects:1:1:300000 tiles
pcd_bv --cluster 0.5 --image tile.png tiles/000_000.pcd"""),
    "rig": ("Two LiDARs in the frame of a robot", """synth rig:30 rig.mcap
bv_stream --source rig.mcap --target-frame base_link --fixed-frame odom --deskew on --track --rate max \\
  --sink image:pictures --sink jsonl:rig.jsonl
mv pictures/frame000029.png rig.png"""),
}


def run(arguments, folder, **variables):
    done = subprocess.run(arguments, cwd=folder, env={**os.environ, **variables}, text=True, timeout=300,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if done.returncode != 0:
        raise SystemExit(f"site: status {done.returncode} of {arguments}:\n{done.stdout}")
    return done.stdout


def pictures(out, programs):
    """Figures; the pictures are written to out/gallery, if there are programs."""
    figures = []
    for name, (title, commands) in PICTURES.items():
        image = ""
        if programs:
            (out / "gallery").mkdir(exist_ok=True)
            with tempfile.TemporaryDirectory() as folder:
                run(["bash", "-euc", commands], folder, PATH=f"{programs}:{os.environ['PATH']}")
                (out / f"gallery/{name}.png").write_bytes(open(f"{folder}/{name}.png", "rb").read())
            image = (f'<a href="gallery/{name}.png"><img src="gallery/{name}.png" loading="lazy" '
                     f'width="1600" height="1000" alt="{html.escape(title)}"></a>')
        code = f'<pre><code>{highlighted(commands, "sh")}</code></pre>'
        figures.append(f"<figure><figcaption>{title}</figcaption>{image}{code}</figure>")
    return f'<div class="cards">{"".join(figures)}</div>'


def purpose(text):
    """What an example shows: its first comment after those of the licence, or its docstring."""
    if (docstring := re.search(r'"""(.*?)"""', text, re.DOTALL)) is not None:
        return docstring[1].strip()
    lines = [line[3:] for line in text.splitlines() if line.startswith("// ")]
    return " ".join(line for line in lines if not line.startswith("SPDX-"))


def example(path, output):
    text = path.read_text()
    language = "python" if path.suffix == ".py" else "cpp"
    anchor = path.name.replace(".", "-")
    code = f"<pre><code>{highlighted(text, language)}</code></pre>"
    parts = [f'<h3 id="{anchor}">{path.name}</h3>', f"<p>{html.escape(purpose(text))}</p>",
             f"<details><summary>Code</summary>{code}</details>"]
    if output is not None:
        parts.append(f"<pre><code>{html.escape(output.rstrip() or '(prints nothing)')}</code></pre>")
    return path.name, anchor, purpose(text), "\n".join(parts)


def output_of(path, examples, package):
    """What an example prints, or None if it was not built."""
    with tempfile.TemporaryDirectory() as folder:
        if path.suffix == ".py":
            return run([sys.executable, "-B", path], folder, PYTHONPATH=str(package)) if package else None
        program = examples / path.stem if examples else None
        return run([program], folder) if program and program.is_file() else None


def write(site, programs=None, examples=None, package=None):
    """Writes gallery.html. Without programs there are no pictures, and without built examples no output."""
    words = "Each picture with the commands that draw it, without other data. A click shows the full size."
    sections, body = [], ["<h1>Gallery</h1>", f"<p>{words}</p>", pictures(site.out, programs)]
    for folder, title in {"examples": "Examples in C++", "examples/python": "Examples in Python"}.items():
        body.append(f'<h2 id="{title.split()[-1].lower().replace("+", "p")}">{title}</h2>')
        for path in sorted((ROOT / folder).glob("*.py" if "python" in folder else "*.cpp")):
            name, anchor, words, part = example(path, output_of(path, examples, package))
            sections.append([name, anchor, words])
            body.append(part)
    site.write("gallery.html", "Gallery", "\n".join(body), sections)
