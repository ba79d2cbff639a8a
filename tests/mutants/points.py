# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""What may be changed in an expression: operators, constants, and calls that have a counterpart."""
import re
from typing import NamedTuple

BINARY = {
    "<": ("<=", ">", ">="),
    "<=": ("<", ">=", ">"),
    ">": (">=", "<", "<="),
    ">=": (">", "<=", "<"),
    "==": ("!=",),
    "!=": ("==",),
    "+": ("-",),
    "-": ("+",),
    "*": ("/",),
    "/": ("*",),
    "%": ("/",),
    "&&": ("||",),
    "||": ("&&",),
    "<<": (">>",),
    ">>": ("<<",),
    "&": ("|",),
    "|": ("&",),
    "^": ("|",),
    "+=": ("-=",),
    "-=": ("+=",),
    "*=": ("/=",),
    "/=": ("*=",),
    "|=": ("&=",),
    "&=": ("|=",),
}
UNARY = ("!", "-", "~")
_PAIRS = [
    ("min", "max"),
    ("min_element", "max_element"),
    ("floor", "ceil"),
    ("Min", "Max"),
    ("Add", "Sub"),
    ("Lt", "Le"),
    ("Gt", "Ge"),
    ("Eq", "Ne"),
    ("And", "Or"),
    ("AllTrue", "AllFalse"),
    ("HWY_MIN", "HWY_MAX"),
    ("cwiseMin", "cwiseMax"),
    ("minCoeff", "maxCoeff"),
    ("true", "false"),
]
COUNTERPARTS = {a: b for a, b in _PAIRS} | {b: a for a, b in _PAIRS} | {"Mul": "Add"}
_OF_STD = {"min", "max", "min_element", "max_element", "floor", "ceil"}
_OF_HIGHWAY = {"Min", "Max", "Add", "Sub", "Mul", "Lt", "Le", "Gt", "Ge", "Eq", "Ne", "And", "Or", "AllTrue"}
_OF_HIGHWAY |= {"AllFalse"}


class Point(NamedTuple):
    index: int  # of the token that is replaced
    options: tuple  # of which one becomes a mutant


def points_in(tokens, ends, first, last):
    """Points between two tokens, template arguments excepted."""
    found = []
    i = first
    while i < last:
        if tokens[i].text == "<" and i in ends:
            i = ends[i]
        else:
            options = _options(tokens, i, first, last)
            if options:
                found.append(Point(i, options))
        i += 1
    return found


def _options(tokens, i, first, last):
    token = tokens[i]
    if token.kind == "number":
        return _other_numbers(token.text)
    if token.kind == "word":
        return _other_word(tokens, i)
    follows_space = i + 1 < last and tokens[i + 1].spaced
    if token.text in BINARY and token.spaced and follows_space and i > first:
        return BINARY[token.text]
    if token.text in UNARY and not follows_space and _is_unary(tokens, i, first):
        return ("",)
    return ()


def _is_unary(tokens, i, first):
    if i == first or tokens[i - 1].text == "return":
        return True
    before = tokens[i - 1]
    return before.kind == "mark" and before.text not in (")", "]", "}", "++", "--")


def _other_numbers(text):
    digits = text.replace("'", "")
    hexadecimal = digits[:2] in ("0x", "0X")
    is_float = "p" in digits.lower() if hexadecimal else re.search(r"[.eE]", digits)
    if not is_float:
        return ("1" + digits[1:],) if re.fullmatch(r"0[uUlL]*", digits) else (f"({text} + 1)",)
    return (f"({text} + 1)",) if re.fullmatch(r"[0.]+[fFlL]?", digits) else (f"(2 * {text})", f"(-{text})")


def _other_word(tokens, i):
    text = tokens[i].text
    if text not in COUNTERPARTS:
        return ()
    space = tokens[i - 2].text if i > 1 and tokens[i - 1].text == "::" else ""
    if text in _OF_STD and space != "std" or text in _OF_HIGHWAY and space != "hn":
        return ()
    return (COUNTERPARTS[text],)
