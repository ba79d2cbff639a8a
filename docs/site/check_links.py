#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""usage: docs/site/check_links.py FOLDER: fails if a page links to a file or an anchor that is not there."""
import html.parser
import os
import pathlib
import sys
import urllib.parse


class Links(html.parser.HTMLParser):
    """The links of a page and its anchors."""

    def __init__(self, path):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(path.read_text())

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ("id", "name") and tag != "meta":
                self.anchors.add(value)
            elif name in ("href", "src") and value is not None:
                self.links.append(value)


def check(folder):
    """Yields each broken link with its page."""
    pages = {path: Links(path) for path in folder.rglob("*.html")}
    for path, page in pages.items():
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:  # external links are not checked
                continue
            name = urllib.parse.unquote(parts.path)
            target = pathlib.Path(os.path.normpath(path.parent / name)) if name else path
            if not target.is_relative_to(folder):
                yield path, link, "outside the site"
            elif not target.is_file():
                yield path, link, "no such file"
            elif parts.fragment and target in pages:
                if urllib.parse.unquote(parts.fragment) not in pages[target].anchors:
                    yield path, link, "no such anchor"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1]).resolve()
    broken = sorted(check(folder))
    for path, link, reason in broken:
        print(f"{path.relative_to(folder)}: {link}: {reason}", file=sys.stderr)
    pages = sum(1 for _ in folder.rglob("*.html"))
    print(f"{pages} pages, {len(broken)} broken links")
    sys.exit(bool(broken) or pages == 0)


if __name__ == "__main__":
    main()
