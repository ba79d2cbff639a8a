# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Rewrites a source so that one program holds all its mutants, each of which the environment can wake."""
import hashlib
import re
from typing import NamedTuple

from points import points_in
from slots import Finder
from tokens import text_of


class Mutant(NamedTuple):
    identity: str  # stays while the statement and the function's name do
    file: str
    line: int
    function: str
    original: str  # the slot's text
    mutated: str
    change: str
    ordinal: int  # among equal slots of a function
    slot: int = -1
    number: int = -1


class Arm(NamedTuple):
    """Where a mutant's text (or, with none, a slot) stands in the rewritten source."""

    start: int
    end: int
    identities: tuple


def mutants_of(text, path):
    """Lists of mutants by slot: [(slot, [Mutant])], in order."""
    finder = Finder(text)
    home = re.sub("(?<=/src/).*/", "", path)  # which folder below src a file lies in changes no mutant
    seen = {}
    result = []
    for slot in finder.slots():
        tokens = finder.tokens[slot.first : slot.last]
        points = points_in(finder.tokens, finder.ends, slot.first, slot.last)
        original = text_of(tokens)
        line = text.count("\n", 0, tokens[0].start) + 1
        key = (slot.function, original)
        seen[key] = ordinal = seen.get(key, -1) + 1
        made = []
        for point in points:
            place = f"{home}|{slot.function}|{original}|{ordinal}|{point.index - slot.first}"
            draw = int(hashlib.sha256(place.encode()).hexdigest(), 16)
            replacement = point.options[draw % len(point.options)]
            identity = hashlib.sha256(f"{place}|{replacement}".encode()).hexdigest()[:16]
            mutated = _mutated(tokens, point.index - slot.first, replacement)
            change = f"{finder.tokens[point.index].text} to {replacement or 'nothing'}"
            made.append(Mutant(identity, path, line, slot.function, original, mutated, change, ordinal))
        if made:
            result.append((slot, made))
    return finder, result


def _mutated(tokens, index, replacement):
    changed = list(tokens)
    changed[index] = tokens[index]._replace(text=replacement)
    return text_of(changed)


def rewrite(text, path, dropped, first_slot, first_number):
    """The rewritten source, its mutants (less those whose identity, or (file, function), is in `dropped`), its arms,
    and how many numbers that takes."""
    finder, by_slot = mutants_of(text, path)
    pieces, mutants, arms = [], [], []
    position = length = 0
    number = first_number
    for slot_number, (slot, made) in enumerate(by_slot, first_slot):
        made = [m._replace(slot=slot_number, number=k) for k, m in enumerate(made, number)]
        number += len(made)
        made = [m for m in made if m.identity not in dropped and (path, m.function) not in dropped]
        if not made:
            continue
        start, end = finder.tokens[slot.first].start, finder.tokens[slot.last - 1].end
        new, inner = _schemata(slot, made)
        new += "\n" * text.count("\n", start, end)
        length += start - position
        arms += [Arm(length + a, length + b, identities) for a, b, identities in inner]
        pieces += [text[position:start], new]
        length += len(new)
        position = end
        mutants += made
    return "".join(pieces) + text[position:], mutants, arms, number - first_number


def _schemata(slot, mutants):
    """The slot's new text, and where in it each mutant is."""
    text, ranges = "", []
    for mutant in mutants:
        begin = len(text)
        text += _branch(slot, mutant)
        ranges.append((begin, len(text), (mutant.identity,)))
    asleep = _arm(slot, mutants[0].original)
    number = mutants[0].slot
    if slot.kind == "statement":
        before, after = f"{{ if (PCL_BV_SLOT({number})) {{ ", f"{asleep} }} else {asleep} }}"
    else:
        before, after = f"(PCL_BV_SLOT({number}) ? (", f"{asleep}) : {asleep})"
    ranges = [(len(before) + a, len(before) + b, m) for a, b, m in ranges]
    text = before + text + after
    return text, [*ranges, (0, len(text), tuple(m.identity for m in mutants))]


def _branch(slot, mutant):
    if slot.kind == "statement":
        return f"if (PCL_BV_IS({mutant.number})) {_arm(slot, mutant.mutated)} else "
    return f"PCL_BV_IS({mutant.number}) ? {_arm(slot, mutant.mutated)} : "


def _arm(slot, text):
    # Sums and differences of Eigen's vectors differ in type, which a declared type or a statement evens out.
    if slot.kind == "statement":
        return f"{{ {text} }}"
    type_ = "bool" if slot.kind == "condition" else slot.type
    return f"static_cast<{type_}>({text})" if type_ else f"({text})"
