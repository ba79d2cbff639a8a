# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""What is known of mutants from this run and earlier ones, and which of those not noticed have an explanation."""
import hashlib
import json

from build import ROOT, TEST_FOLDERS, tracked_files


def in_random_order(mutants, seed):
    """Spread over the files in proportion to what is in them; a slot's second mutant comes after all first ones. By
    what a mutant is, not by which others there are: a change of the code leaves nearly all in their order."""

    def drawn(mutant):
        return int.from_bytes(hashlib.sha256(f"{seed}|{mutant.identity}".encode()).digest()[:6], "big") / 2**48

    by_file = {}
    for mutant in sorted(mutants, key=drawn):
        by_file.setdefault(mutant.file, []).append(mutant)
    keyed = []
    for group in by_file.values():
        seen, first, later = set(), [], []
        for mutant in group:
            (later if mutant.slot in seen else first).append(mutant)
            seen.add(mutant.slot)
        keyed += [((k + drawn(m)) / len(group), m) for k, m in enumerate(first + later)]
    return [m for _, m in sorted(keyed, key=lambda pair: pair[0])]


def hash_of(names):
    total = hashlib.sha256()
    for name in names:
        total.update(name.encode() + b"\0" + (ROOT / name).read_bytes())
    return total.hexdigest()[:16]


class Results:
    """By the mutants' identities. A result holds while its source is the same and, of a mutant that no test
    noticed and that has no explanation, while the tests are."""

    def __init__(self, file, reasons):
        self._file = file
        self._reasons = reasons
        self._by_identity = json.loads(file.read_text()) if file.exists() else {}
        folders = tuple(f"tests/{folder}/" for folder in (*TEST_FOLDERS, "support"))
        self._tests = hash_of(n for n in tracked_files() if n.startswith(folders))
        self._sources = {}

    def _source(self, mutant):
        if mutant.file not in self._sources:
            self._sources[mutant.file] = hash_of([mutant.file])
        return self._sources[mutant.file]

    def get(self, mutant):
        """None if it has not been tried with the source as it is."""
        known = self._by_identity.get(mutant.identity)
        return known if known is not None and known["source"] == self._source(mutant) else None

    def is_settled(self, mutant):
        known = self.get(mutant)
        if known is None:
            return False
        return known["noticed_by"] is not None or known["tests"] == self._tests or key_of(mutant) in self._reasons

    def with_unsettled_first(self, mutants):
        """Those first that tests did not notice before the tests changed: to pass them over would flatter."""
        return sorted(mutants, key=lambda m: self.get(m) is None or self.is_settled(m))

    def put(self, mutant, noticed_by, reached):
        self._by_identity[mutant.identity] = {
            "noticed_by": noticed_by,
            "reached": reached,
            "source": self._source(mutant),
            "tests": self._tests,
            "place": f"{mutant.file}:{mutant.line}",
            "original": mutant.original,
            "mutated": mutant.mutated,
        }
        part = self._file.with_suffix(".part")
        part.write_text(json.dumps(self._by_identity, indent=1))
        part.replace(self._file)


def heading(mutant):
    return (f"{mutant.file}: {mutant.function}" + (f" #{mutant.ordinal + 1}" if mutant.ordinal else "")).strip()


def explained_in(text):
    """Reasons by (heading, original, mutated): blocks of four or more lines, parted by empty ones."""
    reasons = {}
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    for block in "\n".join(lines).strip().split("\n\n"):
        parts = block.strip().split("\n")
        if len(parts) > 3:
            reasons[tuple(p.strip() for p in parts[:3])] = " ".join(p.strip() for p in parts[3:])
        elif parts != [""]:
            raise SystemExit(f"explained.txt: no place, two texts and a reason in\n{block}")
    return reasons


def key_of(mutant):
    return heading(mutant), mutant.original, mutant.mutated
