# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Where a function's expressions stand: conditions, initialisers, and whole statements that end in `;`.

Goes by the shape of clang-formatted code, not by a grammar: what is taken for a slot and is none does not
compile once it is rewritten, and then counts for nothing.
"""
from typing import NamedTuple

from tokens import brackets_of, text_of, tokens_of

_SKIPPED_TO_SEMICOLON = {"using", "typedef", "static_assert", "friend", "throw", "goto", "break", "continue"}
_SKIPPED_TO_SEMICOLON |= {"extern", "delete"}
_CONTROL = {"if", "for", "while", "switch", "return", "else", "do", "case", "default"}
_TYPE_WORDS = {"const", "auto", "static", "unsigned", "int", "double", "float", "bool", "char", "mutable", "inline"}
_TYPE_WORDS |= {"thread_local", "typename", "HWY_ALIGN", "explicit", "virtual", "union", "class", "struct", "enum"}
_NOT_OF_TYPE = {"const", "static", "mutable", "inline", "thread_local", "HWY_ALIGN"}
_CONSTANT = {"constexpr", "consteval", "constinit"}
_ASSIGNMENTS = {"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="}


class Slot(NamedTuple):
    kind: str  # condition, value or statement
    first: int
    last: int  # one past it
    type: str  # of a value, where its declaration says it
    function: str


class Finder:
    """The slots of one file."""

    def __init__(self, text):
        self.tokens = tokens_of(text)
        self.ends = brackets_of(self.tokens)
        self._starts = {0}
        self._inside_for = set()  # what comes after a `;` there is no statement
        self._constant = []  # ranges that are worked out by the compiler
        self._functions = []  # (first, last, name)
        self._found = []
        for i in range(len(self.tokens)):
            self._visit(i)

    def slots(self):
        """In order. Of one that holds another (in a lambda), only the inner one."""
        found = sorted({(s.first, s.last): s for s in self._found if self._is_usable(s)}.values(),
                       key=lambda s: (s.first, -s.last))
        return [s for s, after in zip(found, [*found[1:], None]) if after is None or after.first >= s.last]

    def _is_usable(self, slot):
        if slot.first >= slot.last or any(a <= slot.first < b for a, b in self._constant):
            return False
        inside_function = any(a <= slot.first < b for a, b, _ in self._functions)
        one_part = self.tokens[slot.first].part == self.tokens[slot.last - 1].part
        return one_part and (inside_function or slot.kind != "statement")

    def _add(self, kind, first, last, type_=""):
        around = [f for f in self._functions if f[0] <= first < f[1]]
        self._found.append(Slot(kind, first, last, type_, around[-1][2] if around else ""))

    def _text(self, i):
        return self.tokens[i].text if 0 <= i < len(self.tokens) else ""

    def _is_start(self, i):
        return i in self._starts or (self._text(i - 1) in (";", "{", "}") and i not in self._inside_for)

    def _visit(self, i):
        token = self.tokens[i]
        if token.text in _CONTROL and token.kind == "word":
            self._visit_control(i)
        elif not self._is_start(i) or (token.kind != "word" and token.text not in ("*", "++", "--", "{", "[")):
            return
        elif token.text in ("public", "private", "protected"):
            self._starts.add(i + 2)
        elif token.text == "template" and i + 1 in self.ends:
            self._starts.add(self.ends[i + 1] + 1)
        elif token.text == "HWY_ATTR" or token.text in _SKIPPED_TO_SEMICOLON:
            self._constant.append((i, self._semicolon(i, len(self.tokens))))
        else:
            self._skip_macro(i)
            self._visit_simple(i)

    def _visit_control(self, i):
        word = self._text(i)
        if word in ("else", "do"):
            self._starts.add(i + 1)
        elif word in ("case", "default"):
            while self._text(i) not in (":", ";", ""):
                i += 1
            self._starts.add(i + 1)
        elif word == "return":
            end = self._semicolon(i, len(self.tokens))
            if end is not None:
                self._add("statement", i, end + 1)
        elif i + 1 in self.ends or self._text(i + 1) == "constexpr":
            self._visit_parentheses(i, word)

    def _visit_parentheses(self, i, word):
        constant = self._text(i + 1) == "constexpr"
        first = i + 2 + constant
        last = self.ends.get(first - 1)
        if last is None:
            return
        self._starts.add(last + 1)
        if word == "for":
            self._visit_for(first, last)
        elif word != "switch" and not constant:
            depth0 = self._at_depth0(first, last)
            if not any(self._text(k) in ("=", ";") for k in depth0):
                self._add("condition", first, last)

    def _visit_for(self, first, last):
        parts = [k for k in self._at_depth0(first, last) if self._text(k) == ";"]
        if len(parts) != 2:
            return
        if not self._is_expression(first, parts[0]):
            self._visit_declaration(first, parts[0])
        self._add("condition", parts[0] + 1, parts[1])
        self._add("value", parts[1] + 1, last)
        self._inside_for |= {parts[0] + 1, parts[1] + 1}

    def _skip_macro(self, i):
        """A macro's call without `;`, and then a statement."""
        if self._text(i).isupper() and i + 1 in self.ends and self._text(i + 1) == "(":
            after = self.ends[i + 1] + 1
            if after < len(self.tokens) and self.tokens[after].kind == "word":
                self._starts.add(after)

    def _at_depth0(self, first, last):
        i = first
        while i < last:
            yield i
            i = self.ends[i] + 1 if i in self.ends else i + 1

    def _semicolon(self, i, last):
        for k in self._at_depth0(i, last):
            if self._text(k) in (")", "]", "}"):
                return None
            if self._text(k) == ";":
                return k
        return None

    def _visit_simple(self, i):
        end, is_block = self._end_of_simple(i)
        if end is None:
            return
        words = {self._text(k) for k in self._at_depth0(i, end)}
        constant = bool(words & _CONSTANT)
        if is_block:
            self._visit_header(i, end, constant)
        elif constant or "operator" in words:
            self._constant.append((i, end))
        elif self._is_expression(i, end):
            self._add("statement", i, end + 1)
        else:
            self._visit_declaration(i, end)

    def _end_of_simple(self, i):
        """Its `;`, or the `{` that begins a block."""
        assigned = False
        for k in self._at_depth0(i, len(self.tokens)):
            text = self._text(k)
            if text in (")", "]", "}") or (text in _CONTROL and self.tokens[k].kind == "word"):
                return None, False
            if text == ";":
                return k, False
            if text in _ASSIGNMENTS and self._text(k - 1) != "operator":
                assigned = True
            if text == "{" and not assigned and self._text(self.ends.get(k, -2) + 1) not in (";", ",", ".", "{"):
                return k, True
            if text == "{" and self._text(i) in ("class", "struct", "enum", "union"):
                return k, True
        return None, False

    def _visit_header(self, i, brace, constant):
        last = self.ends.get(brace)
        if last is None or self._text(i) == "namespace":
            return
        if self._text(i) == "enum" or constant:
            self._constant.append((i, last))
        if self._text(i) in ("class", "struct", "union"):
            return
        name = None
        for k in self._at_depth0(i, brace):
            if name is None and self._text(k) == "(" and k > i:
                name = self._name_before(k, i)
                self._functions.append((i, last, name))
            elif name is not None and self._text(k) == ":":
                self._visit_initialisers(k + 1, brace)

    def _name_before(self, k, first):
        begin = k - 1
        while begin - 1 >= first and (self._text(begin - 1) in ("::", "operator", "~") or self._text(begin) == "::"):
            begin -= 1
        return text_of(self.tokens[begin:k])

    def _visit_initialisers(self, first, brace):
        for k in self._at_depth0(first, brace):
            if self._text(k) in ("(", "{") and k in self.ends:
                self._visit_elements(k)

    def _visit_elements(self, bracket):
        """The arguments of a constructor, or what stands in braces."""
        first, last = bracket + 1, self.ends[bracket]
        commas = [k for k in self._at_depth0(first, last) if self._text(k) == ","]
        for begin, end in zip([first, *(c + 1 for c in commas)], [*commas, last]):
            self._visit_value(begin, end, "")

    def _visit_value(self, begin, end, type_):
        if self._text(begin) == "." and self._text(begin + 2) == "=":
            begin += 3
        if self._text(begin) == "{" and begin in self.ends:
            self._visit_elements(begin)
        elif type_ or self._is_expression(begin, end) and not any(
            self._text(k) == "=" for k in self._at_depth0(begin, end)
        ):
            self._add("value", begin, end, type_)

    def _is_expression(self, first, last):
        """Not a declaration, in which two words stand side by side."""
        if self._text(first) in _TYPE_WORDS or self._text(first) == "[":
            return False
        before = ""
        for k in self._at_depth0(first, last):
            token = self.tokens[k]
            if token.kind == "word":
                if before in ("word", "close", "&"):
                    return False
                before = "word"
            elif k in self.ends:
                before = "close"
            elif token.text in ("&", "*", "&&") and k > first and not (token.spaced and self.tokens[k + 1].spaced):
                before = "&"
            elif token.text in ("::", ".", "->", "++", "--", "&", "*"):
                before = ""
            else:
                return True
        return True

    def _visit_declaration(self, first, last):
        where = list(self._at_depth0(first, last))
        for k in where:
            text = self._text(k)
            if text == "=":
                end = next((m for m in where if m > k and self._text(m) == ","), last)
                self._visit_value(k + 1, end, self._type_of(first, k - 1))
            elif text in ("(", "{") and k > first and self.tokens[k - 1].kind == "word" and k in self.ends:
                if not any(self._text(m) == "=" for m in where if m < k):
                    self._visit_elements(k)

    def _type_of(self, first, name):
        type_ = [t for t in self.tokens[first:name] if t.text not in _NOT_OF_TYPE]
        if any(t.text in ("auto", "&", "*", "&&", "[", "(", ",", "=") for t in type_):
            return ""
        return text_of(type_)
