"""The programs of docs/python.md run, and print the output that the page shows."""

import contextlib
import io
import os
import re
import tempfile
import unittest

import packtrace as pt
from support import SOURCE


class TestDocumentation(unittest.TestCase):
    def test_programs_print_what_the_page_says(self):
        page = (SOURCE / "docs/python.md").read_text()
        programs = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
        expected = "".join(re.findall(r"```output\n(.*?)```", page, re.DOTALL))
        self.assertGreaterEqual(len(programs), 2)
        here = os.getcwd()
        printed = io.StringIO()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(printed):
            os.chdir(folder)
            try:
                exec("".join(programs), {})
                self.assertEqual(pt.read_image("ball.png").shape, (240, 320, 3))
            finally:
                os.chdir(here)
        self.assertEqual(printed.getvalue(), expected)


if __name__ == "__main__":
    unittest.main()
