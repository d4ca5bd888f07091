"""Pictures: results of render, files, comparison, and display in notebooks."""

import os
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import numpy as np

import packtrace as pt
from support import SCENES, hand_scene, interrupt, program, reset_peak, resident_bytes


def lit_scene(**fields):
    scene = pt.Scene(objects=[pt.Object(pt.Sphere((0, 0, 3), 1), pt.ScratchMaterial(color=(1, 0, 0)))],
                     lights=[pt.Light(intensity=0.3), pt.Light("point", 0.7, (2, 3, 0))], **fields)
    scene.objects.append(pt.Object(pt.Plane((0, -1, 0)), pt.ScratchMaterial(reflective=0.5)))
    return scene


class TestPicture(unittest.TestCase):
    def test_a_number_of_a_picture_is_a_number(self):
        picture = pt.render(lit_scene(width=8, height=8))
        for number in (picture.mean(), picture.max(), np.sum(picture), picture[0, 0, 0]):
            self.assertIsInstance(number, np.floating)
        self.assertIsInstance(picture * 2, pt.Picture)
        self.assertIsInstance(picture.mean(axis=2), pt.Picture)

    def test_what_is_no_picture_is_not_shown_as_one(self):
        picture = pt.render(lit_scene(width=8, height=8))
        self.assertIsNotNone(picture._repr_png_())
        for other in (picture > 0, picture.astype(np.float16), picture[0], picture[:0]):
            self.assertIsNone(other._repr_png_())


class TestRender(unittest.TestCase):
    def test_the_picture_is_the_programs(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("four_spheres", "nested_glass", "polygons"):
                file = SCENES / f"{name}.scene"
                picture = Path(folder) / f"{name}.pfm"
                program("render", file, "--size", "60x40", "-o", picture)
                ours = pt.render(pt.read_scene(file), width=60, height=40)
                np.testing.assert_array_equal(pt.read_image(picture), ours)
                self.assertEqual((ours.shape, ours.dtype), ((40, 60, 3), np.float32))

    def test_doubles(self):
        scene = lit_scene(width=40, height=30)
        exact = pt.render(scene, dtype=np.float64)
        self.assertEqual((exact.shape, exact.dtype), ((30, 40, 3), np.float64))
        self.assertEqual(pt.render(scene, dtype=None).dtype, np.float32)
        scalar = pt.render(scene, dtype=np.float64, kernel="scalar")
        self.assertLess(pt.compare(exact, scalar).max_abs, 1e-9)

    def test_sizes(self):
        scene = lit_scene(width=200, height=100)
        self.assertEqual(pt.render(scene).shape, (100, 200, 3))
        self.assertEqual(pt.render(scene, width=50).shape, (25, 50, 3))
        self.assertEqual(pt.render(scene, height=10).shape, (10, 20, 3))
        self.assertEqual(pt.render(scene, width=7, height=9).shape, (9, 7, 3))
        self.assertEqual((scene.width, scene.height), (200, 100))

    def test_frames_samples_and_options(self):
        scene = lit_scene(width=32, height=32)
        once = pt.render(scene)
        self.assertTrue((pt.render(scene, samples=4, threads=1) != once).any())
        np.testing.assert_array_equal(pt.render(scene, force_general=True, lanes=8, threads=2), once)
        scene.animation = pt.Animation(2, pt.Orbit((0, 0, 3)))
        np.testing.assert_array_equal(pt.render(scene, frame=0), once)
        self.assertTrue((pt.render(scene, frame=1) != once).any())

    def test_what_min_weight_leaves_out_is_said(self):
        scene = lit_scene(width=32, height=32, min_weight=0.6)
        self.assertIsNone(pt.render(lit_scene(), width=8).cut)
        cut = pt.render(scene).cut
        self.assertGreater(cut.rays, 0)
        self.assertGreater(cut.bound, 0)

    def test_the_array_is_the_renderers_own(self):
        scene = lit_scene(width=2000, height=2000)
        pt.render(scene)
        before, _ = resident_bytes()
        reset_peak()
        picture = pt.render(scene)
        self.assertLess(resident_bytes()[1] - before, 1.5 * picture.nbytes)

    def test_progress(self):
        shares = []
        pt.render(lit_scene(), width=256, progress=shares.append)
        self.assertEqual(shares, sorted(shares))
        self.assertEqual(shares[-1], 1)
        calls = []

        def stop(share):
            calls.append(share)
            raise ZeroDivisionError("enough")

        with self.assertRaisesRegex(ZeroDivisionError, "enough"):
            pt.render(lit_scene(), width=1024, progress=stop)
        self.assertEqual(len(calls), 1)
        self.assertLess(calls[0], 1)

    def test_ctrl_c_stops_rendering(self):
        flake = pt.generate_sphereflake(4)
        # The calls take seconds and minutes; the signal arrives long before their end.
        for call in (lambda: pt.render(lit_scene(), width=2048, samples=64),
                     lambda: pt.render(flake, width=2000, height=2000, kernel="scalar", threads=2),
                     lambda: pt.render(flake, width=2000, height=2000, kernel="scalar",
                                       progress=lambda share: None)):
            interrupt(self, call)

    def test_a_picture_without_memory_says_so(self):
        # In a process of its own, whose memory is limited.
        done = subprocess.run([sys.executable, "-c", """if True:
            import resource
            import packtrace as pt
            pt.render(pt.Scene(), width=8, threads=1)
            resource.setrlimit(resource.RLIMIT_AS, (2**32, 2**32))
            try:
                pt.render(pt.Scene(), width=40000, height=30000)
            except MemoryError as error:
                print(error)"""], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout, "not enough memory for 40000 x 30000 pixels, which alone take "
                                      "14.4 GB; render fewer pixels at once\n")

    def test_progress_that_is_no_function_is_refused(self):
        for call in (pt.render, pt.report):
            with self.assertRaisesRegex(TypeError, "^progress is 3; use a function or None$"):
                call(lit_scene(), progress=3)

    def test_a_forked_process_renders(self):
        # Without the threads of its parent. In a process of its own, which has no other threads.
        done = subprocess.run([sys.executable, "-c", """if True:
            import os
            import packtrace as pt
            scene = pt.generate_sphereflake(1)
            picture = pt.render(scene, width=32, threads=1)
            child = os.fork()
            if child == 0:
                os._exit(3 if (pt.render(scene, width=32, threads=1) == picture).all() else 4)
            print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))"""],
                              capture_output=True, text=True, check=True, timeout=60)
        self.assertEqual(done.stdout, "3\n")

    def test_many_renders_take_no_more_memory(self):
        scene = lit_scene(width=16, height=16)
        for _ in range(500):
            pt.render(scene)
        before, _ = resident_bytes()
        for _ in range(2000):
            pt.render(scene)
        self.assertLess(resident_bytes()[0] - before, 4_000_000)

    def test_regions(self):
        scene = lit_scene(width=100, height=80)
        whole = pt.render(scene)
        np.testing.assert_array_equal(pt.render(scene, region=(30, 20, 50, 7)), whole[20:27, 30:80])

    def test_other_threads_run_meanwhile(self):
        ends = []

        def work():
            ends.append(time.monotonic())
            pt.render(lit_scene(), width=1024, samples=16)
            ends.append(time.monotonic())

        worker = threading.Thread(target=work)
        worker.start()
        ticks = []
        while worker.is_alive():
            ticks.append(time.monotonic())
            time.sleep(0.0005)
        margin = (ends[1] - ends[0]) / 4
        self.assertTrue(any(ends[0] + margin < tick < ends[1] - margin for tick in ticks))

    def test_wrong_options_are_refused(self):
        scene = lit_scene()
        for message, options in (("width is 0; use a number of pixels", {"width": 0}),
                                 ("height is 1.5; use a whole number", {"height": 1.5}),
                                 ("dtype is int32; use np.float32", {"dtype": np.int32}),
                                 ("^dtype is 'x'; use np.float32", {"dtype": "x"}),
                                 ("^height is 4294967296; use a smaller whole number$", {"height": 2**32}),
                                 ("^the scalar kernel has no isa", {"kernel": "scalar", "isa": "avx2"}),
                                 ("^the scalar kernel has no force_general",
                                  {"kernel": "scalar", "force_general": True}),
                                 ("threads is 1000000; use 0, .* up to 1024", {"threads": 10**6}),
                                 ("^width is -109.*; use a larger whole number$", {"width": -2**40}),
                                 ("samples", {"samples": 0}),
                                 ("adaptive", {"adaptive": -1.0, "samples": 4}),
                                 ("accuracy is 'auto'; use one of 'fast', 'exact'",
                                  {"accuracy": "auto"}),
                                 ("region is .*use four whole numbers", {"region": (1, 2)}),
                                 ("region", {"region": (500, 0, 50, 1)}),
                                 ("no animation", {"frame": 0})):
            with self.subTest(message), self.assertRaisesRegex(ValueError, message):
                pt.render(scene, **options)
        with self.assertRaisesRegex(pt.SceneError, "radius"):
            pt.render(pt.Scene(objects=[pt.Object(pt.Sphere(radius=0))]))


class TestCompare(unittest.TestCase):
    def test_the_distance_of_two_pictures(self):
        a = np.zeros((4, 5, 3), np.float32)
        b = a.copy()
        b[1, 2, 0] = 0.5
        b[3, 0, 1] = 0.001
        found = pt.compare(a, b, worst=1)
        self.assertEqual((found.max_abs, found.pixels, found.pixels_off), (0.5, 20, 1))
        self.assertEqual(found.worst, [pt.PixelError(2, 1, 0.5)])
        self.assertAlmostEqual(found.rmse, np.sqrt(np.mean((a - b).astype(float) ** 2)), 12)
        self.assertEqual(pt.compare(a, a).psnr, np.inf)
        self.assertEqual(pt.heatmap(a, b).shape, a.shape)
        self.assertEqual(pt.compare(a[:, ::-1], b[:, ::-1]).max_abs, 0.5)

    def test_wrong_pictures_are_refused(self):
        a = np.zeros((4, 5, 3), np.float32)
        for message, b in ((r"b has shape \(4, 5\)", a[:, :, 0]), (r"a is float32 and b float64", a),
                           (r"b is uint8", a.astype(np.uint8)), (r"b has shape \(0, 5, 3\)", a[:0])):
            b = b.astype(np.float64) if "float64" in message else b
            with self.subTest(message), self.assertRaisesRegex(ValueError, message):
                pt.compare(a, b)
        with self.assertRaisesRegex(ValueError, "5.*4.*5.*3|size"):
            pt.compare(a, a[:3])

    def test_wrong_numbers_are_refused_in_one_line(self):
        a = np.zeros((4, 5, 3), np.float32)
        calls = {"gamma is 'a'; use a number": lambda: pt.to_png(a, gamma="a"),
                 "gamma is None; use a number": lambda: pt.write_image("a.png", a, gamma=None),
                 "gamma is beyond double": lambda: pt.to_png(a, gamma=10**400),
                 "gamma: only PNG has one": lambda: pt.write_image("a.pfm", a, gamma=2.2),
                 "gamma: only PNG has one; ": lambda: pt.write_image("a.hdr", a, gamma=2.2),
                 "threshold is '1'; use a number": lambda: pt.compare(a, a, threshold="1"),
                 "worst is 1.5; use a whole number": lambda: pt.compare(a, a, worst=1.5),
                 "worst is -1; use a whole number": lambda: pt.compare(a, a, worst=-1),
                 "depth is 1.5; use a whole number": lambda: pt.generate_sphereflake(1.5),
                 "frame is 1.5; use a whole number": lambda: hand_scene().camera_at(1.5)}
        for message, call in calls.items():
            with self.subTest(message), self.assertRaisesRegex(ValueError, f"^{message}[^\n]*$"):
                call()


class TestFiles(unittest.TestCase):
    def test_files_hold_the_picture(self):
        picture = pt.render(lit_scene(), width=30, height=20)
        with tempfile.TemporaryDirectory() as folder:
            picture.save(f"{folder}/a.pfm")
            np.testing.assert_array_equal(pt.read_image(Path(folder) / "a.pfm"), picture)
            picture.save(f"{folder}/a.png", gamma=2.2)
            self.assertEqual(Path(folder, "a.png").read_bytes(), pt.to_png(picture, gamma=2.2))
            with self.assertRaisesRegex(pt.ImageError, "a.gif"):
                picture.save(f"{folder}/a.gif")
            with self.assertRaisesRegex(OSError, "none.png"):
                pt.read_image(f"{folder}/none.png")

    def test_names_need_not_be_utf8(self):
        picture = pt.render(lit_scene(), width=30, height=20)
        with tempfile.TemporaryDirectory() as folder:
            name = os.fsencode(folder) + b"/\xff.pfm"
            picture.save(name)
            self.assertEqual(os.listdir(os.fsencode(folder)), [b"\xff.pfm"])
            np.testing.assert_array_equal(pt.read_image(os.fsdecode(name)), picture)
            with self.assertRaisesRegex(pt.ImageError, r"\\xfe\.png: can't read"):
                pt.read_image(os.fsencode(folder) + b"/\xfe.png")

    def test_notebooks_show_pictures(self):
        picture = pt.render(lit_scene(), width=30, height=20, dtype=np.float64)
        shown = picture._repr_png_()
        self.assertEqual(shown[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", shown[16:24]), (30, 20))
        self.assertIsNotNone(picture[::2, ::-3]._repr_png_())
        self.assertIsNone(picture[0]._repr_png_())


class TestReport(unittest.TestCase):
    def test_rows_are_those_of_the_program(self):
        scene = lit_scene(width=16, height=16)
        steps = []
        rows = pt.report({"ball": scene}, threads=[1], repetitions=1, truth_samples=16, samples=[1, 2],
                         min_weights=[0.0], adaptive=[(4, 0.1)],
                         progress=lambda what, share: steps.append((what, share)))
        self.assertGreater(len(rows), 5)
        self.assertGreater(len(steps), 0)
        self.assertEqual({row["study"] for row in rows}, {"arithmetic", "depth", "weight", "sampling"})
        for row in rows:
            self.assertEqual((row["scene"], row["width"], row["pixels"]), ("ball", 16, 256))
            self.assertGreater(row["median_s"], 0)
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "a.scene").write_text(scene.to_text())
            program("report", Path(folder, "a.scene"), "--quick", "--repetitions", 1, "-o", folder)
            header = Path(folder, "report.csv").read_text().splitlines()[0]
        self.assertEqual(list(rows[0]), header.split(","))

    def test_progress_ends_a_report(self):
        calls = []

        def stop(what, share):
            calls.append(what)
            if what == "comparing":
                raise KeyError("enough")

        with self.assertRaisesRegex(KeyError, "enough"):
            pt.report(lit_scene(width=16, height=16), threads=[1], truth_samples=16, samples=[1], adaptive=[],
                      progress=stop)
        self.assertEqual(calls.count("comparing"), 1)

    def test_wrong_options_are_refused(self):
        with self.assertRaisesRegex(ValueError, "adaptive is .*use pairs"):
            pt.report(hand_scene(), adaptive=[(1, 2, 3)])
        with self.assertRaisesRegex(ValueError, "threads is 'two'; use"):
            pt.report(hand_scene(), threads=["two"])
        with self.assertRaisesRegex(ValueError, "^threads is 1; use a list$"):
            pt.report(hand_scene(), threads=1)


if __name__ == "__main__":
    unittest.main()
