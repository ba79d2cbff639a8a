# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""HTML pages of the Markdown pages and of the files to which they link. A page has the path of its source."""
import html
import json
import pathlib
import posixpath
import re
import shutil
import subprocess
import urllib.parse

import pygments
import pygments.formatters
import pygments.lexers
import pygments.util
from markdown_it import MarkdownIt

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
OTHER_NAMES = {"README.md": "index.html", "examples": "gallery.html", "docs/man": "docs/man/pcd_bv.html"}
HIGHLIGHT = pygments.formatters.HtmlFormatter(nowrap=True)
STYLES = {"light": "friendly", "dark": "github-dark"}

GROUPS = {
    "Guide": ["docs/guide/ten-minutes.md", "docs/guide/volume.md", "docs/guide/tolerance.md",
              "docs/guide/tracking.md", "docs/guide/many-machines.md"],
    "Use": ["docs/pcd_bv.md", "docs/bv_stream.md", "docs/cpp.md", "docs/python.md", "docs/ros.md",
            "docs/live.md", "docs/your-robot.md", "docs/streaming.md", "docs/recordings.md",
            "docs/formats.md", "docs/many-machines.md", "docs/gpu.md", "docs/trees.md"],
    "Methods": ["docs/segmentation.md", "docs/tracking.md", "docs/numerics.md", "docs/references.md",
                "docs/glossary.md"],
    "Results": ["docs/benchmarks.md", "docs/comparison.md", "docs/segmentation-results.md",
                "docs/tracking-results.md", "docs/scores.md"],
    "Project": ["docs/platforms.md", "docs/architecture.md", "docs/kernels.md", "docs/adding-a-volume.md",
                "CONTRIBUTING.md", "SECURITY.md", "CHANGELOG.md", "LICENSE"],
}
COMMANDS = ["pcd_bv", "bv_stream", "pcd_bv_mpi", "synth"]


def target_of(source):
    """The path of the page of a source, both relative to the root."""
    if source in OTHER_NAMES:
        return OTHER_NAMES[source]
    if source.endswith(".md"):
        return source[:-3] + ".html"
    if source.endswith((".png", ".svg")):
        return source
    return source + ".html"


def slug(text, used):
    """The anchor that GitHub gives a heading."""
    name = re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")
    count = used.get(name, 0)
    used[name] = count + 1
    return f"{name}-{count}" if count else name


def highlighted(code, language):
    try:
        lexer = pygments.lexers.get_lexer_by_name(language)
    except pygments.util.ClassNotFound:
        return html.escape(code)
    return pygments.highlight(code, lexer, HIGHLIGHT)


class Page:
    """A page: its title, its HTML, its sections for the search, and the sources to which it links."""

    def __init__(self, source):
        self.source, self.target = source, target_of(source)
        self.links, self.sections = set(), []
        text = (ROOT / source).read_text()
        if source.endswith(".md"):
            self.title, self.body = self.markdown(text)
        else:
            self.title = pathlib.PurePosixPath(source).name
            self.body = self.code(text)

    def code(self, text):
        try:
            name = pygments.lexers.get_lexer_for_filename(self.source).aliases[0]
        except pygments.util.ClassNotFound:
            name = ""
        return f"<h1>{html.escape(self.source)}</h1>\n<pre><code>{highlighted(text, name)}</code></pre>"

    def markdown(self, text):
        options = {"html": True, "highlight": lambda code, name, _: highlighted(code, name)}
        parser = MarkdownIt("commonmark", options)
        parser.enable(["table", "strikethrough"])
        tokens = parser.parse(text)
        used, title = {}, None
        for index, token in enumerate(tokens):
            if token.type == "heading_open":
                words = plain(tokens[index + 1])
                token.attrSet("id", slug(words, used))
                title = title or words
                self.sections.append([words, token.attrs["id"], ""])
            elif token.type == "inline":
                self.link(token.children)
                if self.sections and tokens[index - 1].type != "heading_open":
                    self.sections[-1][2] += plain(token) + " "
            elif token.type == "fence" and self.sections:
                self.sections[-1][2] += token.content + " "
        body = parser.renderer.render(tokens, parser.options, {})
        body = body.replace("<table>", '<div class="table"><table>').replace("</table>", "</table></div>")
        return title or self.source, body

    def link(self, tokens):
        """Changes links to sources into links to their pages."""
        for token in tokens:
            name = {"link_open": "href", "image": "src"}.get(token.type)
            if not name or re.match(r"[a-z]+:|#|$", token.attrs[name]):
                continue
            path, _, anchor = token.attrs[name].partition("#")
            folder = posixpath.dirname(self.source)
            source = posixpath.normpath(posixpath.join(folder, urllib.parse.unquote(path)))
            self.links.add(source)
            token.attrs[name] = relative(self.target, target_of(source)) + (f"#{anchor}" if anchor else "")


def plain(token):
    return "".join(" " if child.type == "softbreak" else child.content for child in token.children)


def relative(page, target):
    return posixpath.relpath(target, posixpath.dirname(page) or ".")


class Site:
    """The pages in the folder `out`, with one frame around each: the navigation and the search."""

    def __init__(self, out, version):
        self.out, self.version = out, version
        self.titles, self.index = {}, []
        for source in [source for group in GROUPS.values() for source in group]:
            self.titles[target_of(source)] = Page(source).title
        self.extra = []  # further pages of the navigation: (target, title)

    def write_all(self):
        """The README and what is reachable from it."""
        waiting = ["README.md", *[source for group in GROUPS.values() for source in group]]
        done = set(OTHER_NAMES) - {"README.md"}
        while waiting:
            source = waiting.pop()
            if source in done:
                continue
            done.add(source)
            if not (ROOT / source).is_file():
                raise SystemExit(f"site: a page links to {source}, which is not there")
            if source.endswith((".png", ".svg")):
                (self.out / source).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT / source, self.out / source)
                continue
            page = Page(source)
            waiting += sorted(page.links)
            if page.target == "index.html":
                page.body = page.body.replace("</h1>", f"</h1>\n{self.buttons()}", 1)
            self.write(page.target, page.title, page.body, page.sections)
        self.write_manuals()

    def buttons(self):
        """Buttons on the first page."""
        targets = [(target_of(GROUPS["Guide"][0]), "Begin in ten minutes"), *self.extra]
        links = [f'<a href="{target}">{title}</a>' for target, title in targets]
        return f'<p class="buttons">{" ".join(links)}</p>'

    def write_manuals(self):
        for name in COMMANDS:
            command = ["mandoc", "-T", "html", "-O", "fragment", ROOT / f"docs/man/{name}.1"]
            made = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
            made = made.replace("<table", '<div class="table"><table').replace("</table>", "</table></div>")
            words = re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]+>", " ", made)))
            self.write(f"docs/man/{name}.html", f"{name}(1)", f'<div class="manual">{made}</div>',
                       [[f"{name}(1)", "", words]])

    def write(self, target, title, body, sections=()):
        for heading, anchor, text in sections:
            address = f"{target}#{anchor}" if anchor else target
            self.index.append([title, heading, address, re.sub(r"\s+", " ", text)])
        path = self.out / target
        path.parent.mkdir(parents=True, exist_ok=True)
        frame = (HERE / "frame.html").read_text()
        root = relative(target, ".")
        for name, text in {"title": html.escape(title), "root": root, "version": html.escape(self.version),
                           "navigation": self.navigation(target), "body": body}.items():
            frame = frame.replace(f"{{{{{name}}}}}", text)
        path.write_text(frame)

    def navigation(self, page):
        def item(target, title):
            here = ' aria-current="page"' if target == page else ""
            return f'<li><a href="{relative(page, target)}"{here}>{html.escape(title)}</a></li>'

        parts = ["<ul>", *[item(target, title) for target, title in self.extra], "</ul>"]
        for name, sources in GROUPS.items():
            targets = [target_of(source) for source in sources]
            items = [item(target, self.titles[target]) for target in targets]
            if name == "Use":
                items += [item(f"docs/man/{command}.html", f"man {command}") for command in COMMANDS]
            parts += [f"<h2>{name}</h2>", "<ul>", *items, "</ul>"]
        return "\n".join(parts)

    def finish(self):
        """Writes what all pages share."""
        (self.out / "search-index.js").write_text(f"window.searchIndex = {json.dumps(self.index)};\n")
        for name in ["style.css", "search.js"]:
            shutil.copy(HERE / name, self.out / name)
        light, dark = colour_rules(STYLES["light"]), colour_rules(STYLES["dark"])
        (self.out / "code.css").write_text(f"{light}\n@media (prefers-color-scheme: dark) {{\n{dark}\n}}\n")


def colour_rules(style):
    """CSS of the words in code, without that of code itself."""
    rules = pygments.formatters.HtmlFormatter(style=style).get_style_defs("pre")
    return re.sub(r"^(pre|td|span)[^.\n]*\{.*\}\n|^pre \.hll .*\n", "", rules, flags=re.MULTILINE)
