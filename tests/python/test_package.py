"""The package: its stubs agree with the compiled module, and everything public is documented."""

import ast
import inspect
import re
import unittest
from pathlib import Path

import packtrace as pt
from packtrace import _packtrace
from support import SOURCE

PACKAGE = Path(pt.__file__).parent


def public_names(thing):
    return {name for name in vars(thing) if not name.startswith("_")}


class TestPackage(unittest.TestCase):
    def test_stubs_name_what_the_module_has(self):
        stub = ast.parse((PACKAGE / "_packtrace.pyi").read_text())
        stubbed = {node.name: node for node in stub.body
                   if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        self.assertEqual(set(stubbed), public_names(_packtrace))
        for name, node in stubbed.items():
            if isinstance(node, ast.ClassDef) and not issubclass(getattr(_packtrace, name), Exception):
                methods = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
                self.assertEqual(methods - {"__init__"}, public_names(getattr(_packtrace, name)))

    def test_types_are_said(self):
        self.assertTrue((PACKAGE / "py.typed").exists())
        for name in pt.__all__:
            thing = getattr(pt, name)
            if inspect.isfunction(thing):
                for parameter in inspect.signature(thing).parameters.values():
                    self.assertIsNot(parameter.annotation, parameter.empty, f"{name}, {parameter}")
                self.assertIsNot(inspect.signature(thing).return_annotation, inspect.Signature.empty)

    def test_all_that_is_public_is_documented(self):
        for name in pt.__all__:
            thing = getattr(pt, name)
            if inspect.isclass(thing) or inspect.isfunction(thing):
                self.assertTrue(thing.__doc__, name)
                for member, value in vars(thing).items() if inspect.isclass(thing) else ():
                    if not member.startswith("_") and inspect.isfunction(value):
                        self.assertTrue(value.__doc__, f"{name}.{member}")

    def test_the_instruction_sets(self):
        self.assertTrue(any(isa["supported"] for isa in pt.isas()))

    def test_what_pip_is_told_is_so(self):
        project = (SOURCE / "pyproject.toml").read_text()
        pattern = re.search(r"^regex = '(.*)'$", project, re.MULTILINE)[1]
        version = re.search(pattern, (SOURCE / "CMakeLists.txt").read_text())["value"]
        self.assertEqual(version, pt.__version__)
        options = re.findall(r"^(PACKTRACE_\w+) =", project, re.MULTILINE)
        self.assertGreater(len(options), 3)
        for option in options:
            self.assertIn(f"option({option} ", (SOURCE / "CMakeLists.txt").read_text())
        target = re.search(r'^build.targets = \["(\w+)"\]', project, re.MULTILINE)[1]
        self.assertIn(f"pybind11_add_module({target} ", (SOURCE / "python/CMakeLists.txt").read_text())

    def test_the_version(self):
        self.assertRegex(pt.__version__, r"^\d+\.\d+\.\d+$")


if __name__ == "__main__":
    unittest.main()
