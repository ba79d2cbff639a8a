#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the rewriting takes for an expression, and what it leaves alone."""
import unittest

from rewrite import mutants_of, rewrite


def changes(text):
    return [(m.original, m.change) for _, made in mutants_of(text, "f.cpp")[1] for m in made]


def originals(text):
    return list(dict.fromkeys(original for original, _ in changes(text)))


def in_function(text):
    return "int f(int a, int b) {\n" + text + "\n}\n"


class Slots(unittest.TestCase):
    def test_conditions_and_statements_are_slots(self):
        text = in_function("if (a < b) return a + b;\nwhile (a != b)\n  a += b;\nelse\n  g(a, b - 1);")
        expected = ["a < b", "return a + b;", "a != b", "a += b;", "g(a, b - 1);"]
        self.assertEqual(originals(text), expected)

    def test_a_for_has_three(self):
        self.assertEqual(originals(in_function("for (int i = 0; i < b; i += 2)\n  ;")), ["0", "i < b", "i += 2"])

    def test_a_for_over_a_range_has_none(self):
        self.assertEqual(originals(in_function("for (const int i : v)\n  h(i);")), [])

    def test_declarations_give_their_type(self):
        text = in_function("const Eigen::Vector3d q = p - c;\nauto r = p - c;\nconst T& s = t[a + b];")
        self.assertEqual([s.type for s, _ in mutants_of(text, "f.cpp")[1]], ["Eigen::Vector3d", "", ""])

    def test_several_declarators_are_several_slots(self):
        self.assertEqual(originals(in_function("int x = a * b, y = 0;")), ["a * b", "0"])

    def test_elements_of_braces_and_arguments_of_constructors_are_slots(self):
        text = in_function("double low[2] = {a + 1, -b};\nstd::vector<int> v(a / b, c);")
        self.assertEqual(originals(text), ["a + 1", "-b", "a / b"])

    def test_members_of_a_constructor_are_slots(self):
        self.assertEqual(originals("struct S {\n  S(int a) : x(a + 1), y{a, 2} {}\n};"), ["a + 1", "2"])

    def test_statements_of_a_lambda_are_slots_of_their_own(self):
        text = in_function("sort(a, b + 1, [&](int x, int y) { return x < y; });")
        self.assertEqual(originals(text), ["return x < y;"])

    def test_what_the_compiler_works_out_is_none(self):
        text = "constexpr int k = 1 + 2;\nconstexpr int f(int a) {\n  return a + 1;\n}\nstatic_assert(1 < 2);\n"
        text += "enum E { a = 1 };\nusing T = A<1 + 2>;\nint g(int a = 3);\n"
        text += "inline constexpr int t = [] {\n  int s = 0;\n  return s;\n}();\n"
        self.assertEqual(originals(text + in_function("if constexpr (n < 3) h();")), [])

    def test_comments_strings_and_preprocessor_lines_are_none(self):
        text = '#define F(x) if (x < 3) \\\n  return x + 1;\n// if (a < b)\n/* return a + b; */\n'
        self.assertEqual(originals(text + in_function('g("a < b", \'+\', R"(a - b)");')), [])

    def test_a_statement_across_a_preprocessor_line_is_none(self):
        self.assertEqual(originals(in_function("return a +\n#if X\n       b;\n#else\n       c;\n#endif")), [])

    def test_functions_have_names(self):
        text = "double Obb::volume() const {\n  return a * b;\n}\ntemplate <class D>\nHWY_INLINE V<D> g(D d) {\n  return a + b;\n}\n"
        self.assertEqual([s.function for s, _ in mutants_of(text, "f.cpp")[1]], ["Obb::volume", "g"])


class Points(unittest.TestCase):
    def operators(self, expression):
        return [change.split(" to ")[0] for _, change in changes(in_function(f"return {expression};"))]

    def test_operators_have_spaces_on_both_sides(self):
        self.assertEqual(self.operators("a * b - *p && !c || -d < e->f"), ["*", "-", "&&", "!", "||", "-", "<"])

    def test_template_arguments_are_none(self):
        self.assertEqual(self.operators("std::get<0>(a) + g<A<int, 3>>(b) >> c"), ["+", ">>"])

    def test_numbers_change(self):
        expected = {"0": ["1"], "7": ["(7 + 1)"], "0U": ["1U"], "0.0": ["(0.0 + 1)"]}
        expected |= {"1.5F": ["(2 * 1.5F)", "(-1.5F)"], "0x1p-3": ["(2 * 0x1p-3)", "(-0x1p-3)"]}
        for number, others in expected.items():
            ((_, change),) = changes(in_function(f"return {number};"))
            self.assertIn(change, [f"{number} to {other}" for other in others])

    def test_only_calls_of_known_libraries_have_counterparts(self):
        self.assertEqual(self.operators("std::min(a, min(b, hn::Add(c, Add(d, limits::max()))))"), ["min", "Add"])


class Rewriting(unittest.TestCase):
    text = in_function("// why\nif (a <\n    b)\n  return a + b;\nconst double x = a * b;")

    def test_lines_stay(self):
        new, _, _, _ = rewrite(self.text, "f.cpp", set(), 0, 0)
        self.assertEqual(new.count("\n"), self.text.count("\n"))
        self.assertIn("static_cast<double>(a * b)", new.splitlines()[-2])

    def test_arms_are_where_mutants_are(self):
        new, mutants, arms, _ = rewrite(self.text, "f.cpp", set(), 0, 0)
        for mutant in mutants:
            found = [new[a.start : a.end] for a in arms if a.identities == (mutant.identity,)]
            self.assertIn(mutant.mutated, found[0])

    def test_what_is_dropped_leaves_numbers_and_text_of_others(self):
        _, mutants, _, count = rewrite(self.text, "f.cpp", set(), 5, 7)
        _, fewer, _, same = rewrite(self.text, "f.cpp", {mutants[0].identity}, 5, 7)
        self.assertEqual((fewer, same), (mutants[1:], count))
        everything = {m.identity for m in mutants}
        self.assertEqual(rewrite(self.text, "f.cpp", everything, 0, 0)[0], self.text)

    def test_identities_do_not_depend_on_lines(self):
        moved = rewrite("\n\n" + self.text, "f.cpp", set(), 0, 0)[1]
        self.assertEqual([m.identity for m in moved], [m.identity for m in rewrite(self.text, "f.cpp", set(), 0, 0)[1]])


if __name__ == "__main__":
    unittest.main()
