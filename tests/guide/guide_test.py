#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the commands of the guide, and compares what they print with what its pages show.

usage: tests/guide/guide_test.py BIN_DIR PAGE.md... [--pictures FOLDER]

The blocks ```sh of a page run one after another in an empty folder. In the block ```text after one, `...`
stands for any text. A picture docs/images/guide-NAME.png is NAME.png of the page's commands; --pictures
writes all of them, with ImageMagick.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PICTURE = re.compile(r"\.\./images/guide-([a-z-]+\.png)")
# The dark background becomes one colour.
SMALL = ["-level", "9%,100%", "-resize", "720x", "+dither", "-colors", "24"]
LONGEST = 300  # seconds for a block


def run_block(commands, folder, programs):
    """Standard output and error of a block. Any free port is used, so that tests can run side by side; sources that
    are repeated for the reader are played once."""
    environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8"}
    commands = re.sub(r" --loop \d+", "", commands.replace("ws:8765", "ws:0"))
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", commands], cwd=folder, env=environment,
                          text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=LONGEST,
                          check=False)
    if done.returncode != 0:
        raise AssertionError(f"status {done.returncode} of\n{commands}\n{done.stdout}")
    return done.stdout


def check_shown(shown, printed):
    """Each shown line must be printed, in this order; `...` is any text within a line, or any lines."""
    lines = iter(printed.splitlines())
    for line in shown.splitlines():
        pattern = ".*".join(re.escape(part) for part in line.rstrip().split("..."))
        if not any(re.fullmatch(pattern, candidate.rstrip()) for candidate in lines):
            raise AssertionError(f"the page shows\n{line}\nwhich is not printed in this order:\n{printed}")


def run_page(page, programs, pictures):
    text = page.read_text()
    with tempfile.TemporaryDirectory() as folder:
        printed, count = None, 0
        for kind, content in BLOCK.findall(text):
            if kind == "sh":
                printed, count = run_block(content, folder, programs), count + 1
            elif kind == "text":
                if printed is None:
                    raise AssertionError(f"no commands before\n{content}")
                check_shown(content, printed)
        for name in PICTURE.findall(text):
            drawn = pathlib.Path(folder, name)
            if not drawn.is_file():
                raise AssertionError(f"no command draws {name}")
            if not (page.parent / f"../images/guide-{name}").is_file() and not pictures:
                raise AssertionError(f"docs/images has no guide-{name}: run this test with --pictures")
            if pictures:
                subprocess.run(["convert", drawn, *SMALL, f"PNG8:{pictures}/guide-{name}"], check=True)
    if count == 0:
        raise AssertionError("has no commands")
    print(f"{page.name}: {count} blocks")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("programs", type=pathlib.Path)
    parser.add_argument("pages", type=pathlib.Path, nargs="+")
    parser.add_argument("--pictures", type=pathlib.Path)
    arguments = parser.parse_args()
    failed = False
    for page in arguments.pages:
        try:
            run_page(page, arguments.programs.resolve(), arguments.pictures)
        except AssertionError as error:
            failed = True
            print(f"{page}: {error}", file=sys.stderr)
    sys.exit(failed)


main()
