# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Arguments of the scripts that run the commands of a build folder. A wrong one is one line on stderr, status 2."""
import argparse
import pathlib


class Parser(argparse.ArgumentParser):
    """Has the usage of the script's docstring, and the argument BUILD_DIR with the commands that are needed."""

    def __init__(self, doc, commands):
        super().__init__(usage=doc.split("usage: ")[1].split("\n\n", maxsplit=1)[0], allow_abbrev=False)
        self.commands = commands
        self.add_argument("build", type=self.build_folder)

    def build_folder(self, text):
        for command in self.commands:
            if not pathlib.Path(text, "bin", command).is_file():
                raise argparse.ArgumentTypeError(f"'{text}' is no build folder: it has no bin/{command}")
        return text

    def error(self, message):
        self.exit(2, f"{self.prog}: {message}\n")


def count(text):
    """A number of things of which at least one is needed."""
    try:
        value = int(text)
    except ValueError:
        value = 0
    if value < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is not an integer from 1 on")
    return value


def existing_folder(text):
    """A folder that exists, for temporary files."""
    if not pathlib.Path(text).is_dir():
        raise argparse.ArgumentTypeError(f"'{text}' is no folder")
    return text


class Section:
    """The part of a page between the markers of a script, which the script writes."""

    def __init__(self, script, page):
        self.page, self.script = pathlib.Path(page), script
        self.begin, self.end = f"<!-- {script}: begin -->\n", f"<!-- {script}: end -->"
        self.around()

    def around(self):
        """The texts before and behind the section."""
        try:
            before, rest = self.page.read_text().split(self.begin)
            return before, rest.split(self.end)[1]
        except (OSError, ValueError, IndexError) as error:
            raise argparse.ArgumentTypeError(f"'{self.page}' has no section of {self.script}") from error

    def write(self, text):
        before, after = self.around()
        self.page.write_text(before + self.begin + text + "\n" + self.end + after)


def page_with(*scripts):
    """The type of an argument that is a page with the sections of scripts."""

    def page(text):
        for script in scripts:
            Section(script, text)
        return text

    return page
