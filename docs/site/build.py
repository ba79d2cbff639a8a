#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Builds the site: pages, gallery, demo and C++ API. `./bootstrap site` calls it with everything.

usage: docs/site/build.py OUT [--build DIR] [--examples DIR]

Without --build (a folder of CMake) there are only the pages. Without --examples (the built programs of
examples/) the gallery has no output of C++. OUT is emptied first. Warnings and broken links are errors.
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys

try:
    import pages
except ImportError as error:
    print(f"build.py: {error}: install python3-markdown-it and python3-pygments", file=sys.stderr)
    sys.exit(77)  # the test is skipped
if not shutil.which("mandoc"):
    print("build.py: install mandoc", file=sys.stderr)
    sys.exit(77)
import check_links
import gallery

MARK = ".pcl_bv_site"


def version():
    text = (pages.ROOT / "CMakeLists.txt").read_text()
    return re.search(r"project\(pcl_bv VERSION ([\d.]+)", text)[1]


def write_api(out):
    """Doxygen's pages in out/api."""
    doxyfile = (pages.HERE / "Doxyfile").read_text()
    doxyfile += f'\nOUTPUT_DIRECTORY = "{out}"\nPROJECT_NUMBER = {version()}\n'
    number = subprocess.run(["doxygen", "--version"], check=True, stdout=subprocess.PIPE, text=True).stdout
    if tuple(map(int, re.findall(r"\d+", number)[:3])) >= (1, 9, 5):
        doxyfile += "HTML_COLORSTYLE = LIGHT\n"  # api.css makes it dark
    subprocess.run(["doxygen", "-"], check=True, cwd=pages.ROOT, input=doxyfile, text=True)
    link = '<a href="#nested-classes">Classes</a> &#124;\n'
    for page in (out / "api").glob("class*.html"):  # Doxygen links to private classes, which it leaves out
        text = page.read_text()
        if link in text and 'name="nested-classes"' not in text:
            page.write_text(text.replace(link, ""))


def empty(out):
    """Empties the folder, but no folder that was not made here."""
    if out.exists() and any(out.iterdir()) and not (out / MARK).exists():
        sys.exit(f"build.py: {out} is not empty, and not a site")
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    (out / MARK).touch()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path)
    parser.add_argument("--examples", type=pathlib.Path)
    arguments = parser.parse_args()
    out = arguments.out.resolve()
    empty(out)
    site = pages.Site(out, version())
    site.extra = [("gallery.html", "Gallery")]
    if arguments.build:
        build = arguments.build.resolve()
        site.extra += [("demo.html", "Live demo"), ("api/index.html", "C++ API")]
        import demo  # needs numpy

        demo.write(out, build / "bin", build / "nodes/live/page.html")
        write_api(out)
        examples = arguments.examples and arguments.examples.resolve()
        gallery.write(site, build / "bin", examples, build / "python")
    else:
        gallery.write(site)
    site.write_all()
    site.finish()
    broken = sorted(check_links.check(out))
    for path, link, reason in broken:
        print(f"{path.relative_to(out)}: {link}: {reason}", file=sys.stderr)
    print(f"{out}/index.html")
    sys.exit(bool(broken))


main()
