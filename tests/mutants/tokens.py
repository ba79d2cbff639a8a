# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""C++ source as a list of tokens, with what brackets belong together."""
import re
from typing import NamedTuple

_PATTERN = re.compile(
    r"""
    (?P<space>\s+)
  | (?P<comment>//(?:\\\n|[^\n])*|/\*.*?\*/)
  | (?P<string>(?:u8|[uUL])?R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"|(?:u8|[uUL])?"(?:\\.|[^"\\])*"\w*)
  | (?P<character>(?:u8|[uUL])?'(?:\\.|[^'\\])+')
  | (?P<number>\.?\d(?:[eEpP][+-]|'?[\w.])*)
  | (?P<word>[A-Za-z_]\w*)
  | (?P<mark_of>\.\.\.|<=>|<<=|>>=|->\*|::|->|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|.)
    """,
    re.VERBOSE | re.DOTALL,
)
_DIRECTIVE = re.compile(r"[ \t]*#(?:\\\n|[^\n])*")


class Token(NamedTuple):
    kind: str  # word, number, string, character or mark
    text: str
    start: int
    end: int
    spaced: bool  # white space comes before it
    part: int  # how many preprocessor lines come before it


def tokens_of(text):
    """Tokens without comments and preprocessor lines."""
    tokens = []
    position, part, spaced, at_line_start = 0, 0, False, True
    while position < len(text):
        if at_line_start and (directive := _DIRECTIVE.match(text, position)):
            position, part, spaced = directive.end(), part + 1, True
            continue
        found = _PATTERN.match(text, position)
        position = found.end()
        kind = "mark" if found.lastgroup == "mark_of" else found.lastgroup
        kind = "string" if kind == "mark" and found.group("string") else kind
        if kind in ("space", "comment"):
            spaced = True
            at_line_start = at_line_start or "\n" in found.group() or found.group().startswith("//")
            at_line_start = at_line_start and text[position - 1] == "\n"
            continue
        _append(tokens, kind, found, spaced, part)
        spaced = at_line_start = False
    return tokens


def _append(tokens, kind, found, spaced, part):
    if found.group() == ">>" and not spaced:  # The ends of two lists of template arguments.
        for k in range(2):
            tokens.append(Token(kind, ">", found.start() + k, found.start() + k + 1, False, part))
        return
    tokens.append(Token(kind, found.group(), found.start(), found.end(), spaced, part))


def brackets_of(tokens):
    """From each ( [ { and each < of template arguments to its end, by index."""
    ends = {}
    open_at = []
    closer = {"(": ")", "[": "]", "{": "}"}
    for i, token in enumerate(tokens):
        if token.kind != "mark":
            continue
        if token.text in closer:
            open_at.append(i)
        elif token.text in closer.values() and open_at and closer[tokens[open_at[-1]].text] == token.text:
            ends[open_at.pop()] = i
    for i in range(1, len(tokens)):
        end = _end_of_angle(tokens, ends, i)
        if end is not None:
            ends[i] = end
    return ends


def _end_of_angle(tokens, ends, i):
    # Formatted code has spaces around comparisons, and none before template arguments but after `template`.
    before = tokens[i - 1]
    opens = tokens[i].text == "<" and before.kind == "word" and before.text != "operator"
    if not opens or (tokens[i].spaced and before.text != "template"):
        return None
    depth = 1
    k = i + 1
    while k < len(tokens):
        text = tokens[k].text
        if tokens[k].kind == "mark":
            if text in "([{" and k in ends:
                k = ends[k]
            elif text == "<" and not tokens[k].spaced:
                depth += 1
            elif text == ">" and not tokens[k].spaced:
                depth -= 1
            elif text in ";)]}":
                return None
        if depth == 0:
            return k
        k += 1
    return None


def text_of(tokens):
    """The tokens on one line, spaced as they were."""
    return "".join((" " if t.spaced and k > 0 else "") + t.text for k, t in enumerate(tokens))
