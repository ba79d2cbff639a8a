# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
import ast
import doctest
import inspect
import os
import pathlib
import unittest

import pcl_bv

PACKAGE = pathlib.Path(pcl_bv.__file__).parent
PAGE = pathlib.Path(os.environ["PCL_BV_EXAMPLES"]).parent.parent / "docs" / "python.md"


def public():
    """Names and objects: functions, classes, and methods of these."""
    for name in pcl_bv.__all__:
        value = getattr(pcl_bv, name)
        if callable(value):
            yield name, value
        if inspect.isclass(value):
            for member in vars(value):
                if not member.startswith("_") and not isinstance(vars(value)[member], property):
                    yield f"{name}.{member}", getattr(value, member)


def stub():
    """What __init__.pyi says: parameters of functions and methods, and names of properties by class."""
    functions, properties = {}, {}
    for node in ast.parse((PACKAGE / "__init__.pyi").read_text()).body:
        if isinstance(node, ast.FunctionDef):
            functions[node.name] = node.args
        if isinstance(node, ast.ClassDef):
            properties[node.name] = set()
            for member in node.body:
                if isinstance(member, ast.AnnAssign) and member.target.id != "__hash__":
                    properties[node.name].add(member.target.id)
                elif isinstance(member, ast.FunctionDef):
                    if any(getattr(d, "id", "") == "property" for d in member.decorator_list):
                        properties[node.name].add(member.name)
                    else:
                        functions[f"{node.name}.{member.name}"] = member.args
    return functions, properties


def shape(arguments):
    """Of a stub, as of inspect.signature(): names with their kinds and defaults."""
    positional = arguments.posonlyargs + arguments.args
    given = [ast.literal_eval(d) for d in arguments.defaults]
    defaults = [None] * (len(positional) - len(given)) + given
    rows = [(a.arg, i < len(arguments.posonlyargs), d) for i, (a, d) in enumerate(zip(positional, defaults))]
    rows += [(a.arg, "keyword", None if d is None else ast.literal_eval(d))
             for a, d in zip(arguments.kwonlyargs, arguments.kw_defaults)]
    return [r for r in rows if r[0] != "self"] + ([arguments.kwarg.arg] if arguments.kwarg else [])


def shape_of(callable_):
    kinds = inspect.Parameter
    rows = []
    for p in inspect.signature(callable_).parameters.values():
        default = None if p.default is kinds.empty else p.default
        if p.name == "self":
            continue
        if p.kind is kinds.VAR_KEYWORD:
            rows.append(p.name)
        else:
            rows.append((p.name,
                         "keyword" if p.kind is kinds.KEYWORD_ONLY else p.kind is kinds.POSITIONAL_ONLY,
                         default))
    return rows


class Documentation(unittest.TestCase):
    def test_every_docstring_has_an_example_that_runs(self):
        runner = doctest.DocTestRunner(verbose=False)
        for name, value in [("pcl_bv", pcl_bv), *public()]:
            test = doctest.DocTestParser().get_doctest(inspect.getdoc(value) or "", {}, name, None, 0)
            self.assertTrue(test.examples, f"{name} has no example")
            runner.run(test)
        self.assertEqual(runner.summarize(verbose=False).failed, 0)

    def test_every_property_says_what_it_is(self):
        for name in pcl_bv.__all__:
            value = getattr(pcl_bv, name)
            for member, what in vars(value).items() if inspect.isclass(value) else ():
                if isinstance(what, property):
                    self.assertTrue(what.__doc__, f"{name}.{member}")

    def test_stubs_agree_with_what_is_there(self):
        functions, properties = stub()
        there = {name: value for name, value in public()}
        classes = {name for name, value in there.items() if inspect.isclass(value)}
        said = {name for name in functions if "__" not in name and "._" not in name}
        self.assertEqual(said, set(there) - classes)
        for name in said:
            self.assertEqual(shape_of(there[name]), shape(functions[name]), name)
        self.assertEqual(set(properties), classes)
        for name in classes:
            if name + ".__init__" in functions:
                self.assertEqual(shape_of(there[name]), shape(functions[name + ".__init__"]), name)
            found = {m for m, what in vars(there[name]).items() if isinstance(what, property)}
            self.assertEqual(properties[name], found, name)

    def test_the_package_is_typed(self):
        self.assertTrue((PACKAGE / "py.typed").exists())

    def test_the_examples_of_the_page_run(self):
        found = doctest.DocTestParser().get_doctest(PAGE.read_text(), {}, "python.md", str(PAGE), 0)
        self.assertGreater(len(found.examples), 20)
        runner = doctest.DocTestRunner(verbose=False)
        with __import__("tempfile").TemporaryDirectory() as folder:
            here = os.getcwd()
            os.chdir(folder)
            try:
                runner.run(found)
            finally:
                os.chdir(here)
        self.assertEqual(runner.summarize(verbose=False).failed, 0)


if __name__ == "__main__":
    unittest.main()
