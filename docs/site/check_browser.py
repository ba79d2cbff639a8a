#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""usage: docs/site/check_browser.py SITE [PICTURES]

Opens the pages of a site in Chromium without a screen. Fails if a page is wider than a phone or has an
error in its console, if the search finds nothing, or if the demo does not play. Writes pictures of the main
pages, for a phone and a desk, light and dark, to the folder PICTURES. Needs the packages chromium and
chromium-driver.
"""
import base64
import json
import pathlib
import subprocess
import sys
import time
import urllib.request

PORT = 18768
PHONE, DESK = (390, 844), (1280, 860)
MAIN = ["index", "docs/guide/ten-minutes", "docs/benchmarks", "gallery", "docs/man/pcd_bv", "api/index",
        "api/classpcl__bv_1_1Obb", "demo"]
API = 25  # pages of the API, of about 800
FLAGS = """--headless=new --no-sandbox --no-first-run --disable-background-networking --disable-sync
--use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader""".split()
SEARCH = """const field = document.getElementById("search");
field.focus();
field.value = "sphere";
setTimeout(() => {
  field.dispatchEvent(new Event("input"));
  arguments[0](document.querySelectorAll("#found a").length);
}, 2000);"""


def call(path, body=None, method="POST"):
    data = json.dumps(body or {}).encode() if method == "POST" else None
    request = urllib.request.Request(f"http://127.0.0.1:{PORT}{path}", data, method=method)
    with urllib.request.urlopen(request, timeout=120) as answer:
        return json.load(answer)["value"]


class Browser:
    """A session of chromedriver, which must run."""

    def __init__(self, site):
        options = {"browserName": "chrome", "goog:loggingPrefs": {"browser": "ALL"},
                   "goog:chromeOptions": {"args": FLAGS}}
        self.site = site
        self.path = f"/session/{call('/session', {'capabilities': {'alwaysMatch': options}})['sessionId']}"

    def command(self, name, **parameters):
        return call(f"{self.path}/goog/cdp/execute", {"cmd": name, "params": parameters})

    def screen(self, size, dark):
        width, height = size
        self.command("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                     mobile=size == PHONE)
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.command("Emulation.setEmulatedMedia", features=[scheme])

    def open(self, page):
        call(f"{self.path}/url", {"url": (self.site / page).as_uri()})

    def run(self, script, kind="sync"):
        return call(f"{self.path}/execute/{kind}", {"script": script, "args": []})

    def errors(self):
        entries = call(f"{self.path}/se/log", {"type": "browser"})
        return [entry["message"] for entry in entries if entry["level"] == "SEVERE"]

    def picture(self):
        return base64.b64decode(self.command("Page.captureScreenshot")["data"])


def check(browser, site):
    """Yields what is wrong, as lines."""
    browser.screen(PHONE, False)
    api = sorted((site / "api").glob("*.html"))
    pages = [page for page in sorted(site.rglob("*.html")) if not page.is_relative_to(site / "api")]
    for page in pages + api[:: max(1, len(api) // API)]:
        name = page.relative_to(site)
        browser.open(name)
        width = browser.run("return document.documentElement.scrollWidth")
        if width > PHONE[0]:
            yield f"{name}: is {width} pixels wide on a phone of {PHONE[0]}"
        yield from (f"{name}: {error}" for error in browser.errors())
    browser.open("index.html")
    if browser.run(SEARCH, "async") == 0:
        yield "index.html: the search finds nothing for: sphere"
    if (site / "demo.html").is_file():
        browser.open("demo.html")
        end = time.monotonic() + 60
        while (frames := browser.run("return window.pclBv?.frames ?? 0")) < 5 and time.monotonic() < end:
            time.sleep(0.2)
        if frames < 5 or browser.run("return window.pclBv.state.error") != "":
            yield f"demo.html: showed {frames} frames"


def write_pictures(browser, site, folder):
    folder.mkdir(parents=True, exist_ok=True)
    for size in (PHONE, DESK):
        for dark in (False, True):
            browser.screen(size, dark)
            for page in [name for name in MAIN if (site / f"{name}.html").is_file()]:
                browser.open(f"{page}.html")
                time.sleep(6 if page == "demo" else 0.5)
                name = f"{page.replace('/', '-')}-{size[0]}-{'dark' if dark else 'light'}.png"
                (folder / name).write_bytes(browser.picture())


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    site = pathlib.Path(sys.argv[1]).resolve()
    driver = subprocess.Popen(["chromedriver", f"--port={PORT}"], stdout=subprocess.DEVNULL)
    try:
        time.sleep(2)
        browser = Browser(site)
        wrong = list(check(browser, site))
        if len(sys.argv) == 3:
            write_pictures(browser, site, pathlib.Path(sys.argv[2]))
        call(browser.path, method="DELETE")
    finally:
        driver.terminate()
        driver.wait()
    print("\n".join(wrong) or "no page is too wide for a phone or has an error; search and demo work")
    sys.exit(bool(wrong))


main()
