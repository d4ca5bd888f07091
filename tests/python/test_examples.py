"""The Python examples run, and print the right results."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import packtrace as pt
from support import SOURCE


class TestExamples(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_in_folder(self, *command):
        return subprocess.run(command, cwd=self.folder, capture_output=True, text=True,
                              check=True).stdout

    def run_example(self, name):
        return self.run_in_folder(sys.executable, "-B", SOURCE / "examples" / name)

    def test_picture_is_that_of_cpp(self):
        self.run_example("picture.py")
        ours = (self.folder / "picture.png").read_bytes()
        self.run_in_folder(Path(os.environ["PACKTRACE_EXAMPLES"]) / "picture")
        self.assertEqual((self.folder / "picture.png").read_bytes(), ours)
        self.assertEqual(pt.read_image(self.folder / "picture.png").shape, (512, 512, 3))

    def test_first_hit_prints_a_hit_and_a_miss(self):
        printed = self.run_example("first_hit.py")
        self.assertRegex(printed, r"^\[4\.0\d+ +inf\] \[ ?0 -1\]")

    def test_million_rays_prints_what_cpp_does(self):
        ours = self.run_example("million_rays.py")
        self.assertRegex(ours, r"^\d+ of 1000000 rays hit\nray \d+ hits object \d+ at t = 0.50")
        self.assertEqual(ours, self.run_in_folder(
            Path(os.environ["PACKTRACE_EXAMPLES"]) / "million_rays"))

    def test_lens_focuses_as_optics_says(self):
        printed = self.run_example("lens.py")
        lensmaker, traced = map(float, re.search(r"focus: ([\d.]+) .* ([\d.]+) traced",
                                                 printed).groups())
        self.assertAlmostEqual(lensmaker, traced, 5)
        radii = [float(number) for number in re.findall(r"RMS radius (\S+) mm", printed)]
        self.assertEqual(len(radii), 3)
        # Spherical aberration of a fraction of a millimetre, then a single point, then coma.
        self.assertTrue(0.05 < radii[0] < 0.5, radii)
        self.assertLess(radii[1], 1e-13)
        self.assertTrue(0.005 < radii[2] < 0.05, radii)
        focus = float(re.search(r"stigmatic, on axis: best focus at z = (\S+),", printed)[1])
        self.assertEqual(focus, 100)
        self.assertGreater((self.folder / "lens.png").stat().st_size, 5000)


if __name__ == "__main__":
    unittest.main()
