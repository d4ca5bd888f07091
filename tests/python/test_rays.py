"""Rays: answers equal those of the program, bit for bit; arrays are neither copied nor converted."""

import dataclasses
import signal
import threading
import unittest
import warnings

import numpy as np

import packtrace as pt
from support import HAND_SCENE, SCENES, hand_scene, interrupt, random_rays, reset_peak, resident_bytes
from support import rows_of_program

DTYPES = (np.float32, np.float64)


def precision(dtype):
    return "single" if dtype == np.float32 else "double"


def columns(origins, directions):
    count = len(origins)
    return [*origins.T, *directions.T, np.zeros(count), np.full(count, np.inf)]


class TestAnswers(unittest.TestCase):
    def check_program(self, text, dtype, **options):
        """Closest hits, all hits and occlusion equal those that the program prints."""
        words = [word for key, value in options.items() for word in (f"--{key}", value)]
        words += ["--precision", precision(dtype)]
        scene = pt.Scene.from_text(text)
        names = [item.name for item in scene.objects]
        rays = pt.RayScene(scene, **options)
        origins, directions = random_rays(5000, dtype)
        hits = rays.closest(origins, directions)
        expected = rows_of_program(text, columns(origins, directions), *words)
        self.assertEqual([row[0] == "1" for row in expected], list(hits.hit))
        for i in np.flatnonzero(hits.hit):
            self.assertEqual(expected[i][2], names[hits.object[i]])
        numbers = np.array([[row[1], *row[3:]] for row in expected if row[0] == "1"], np.float64)
        found = np.column_stack([hits.t, hits.normal])[hits.hit]
        np.testing.assert_array_equal(numbers, found)
        every = rays.all_hits(origins, directions)
        expected = rows_of_program(text, columns(origins, directions), *words, "--all")
        np.testing.assert_array_equal([int(row[0]) for row in expected], every.ray)
        self.assertEqual([row[2] for row in expected], [names[number] for number in every.object])
        np.testing.assert_array_equal(np.array([[row[1], *row[3:]] for row in expected], np.float64),
                                      np.column_stack([every.t, every.normal]))
        np.testing.assert_array_equal(rays.occluded(origins, directions), hits.hit)

    def test_the_answers_are_the_programs(self):
        for dtype in DTYPES:
            for options in ({}, {"accuracy": "fast"} if dtype == np.float32 else {},
                            {"kernel": "scalar"}):
                with self.subTest(dtype=dtype, **options):
                    self.check_program(HAND_SCENE, dtype, **options)
        self.check_program(pt.read_scene(SCENES / "four_spheres.scene").to_text(), np.float64)

    def test_bounds_are_the_programs(self):
        for dtype in DTYPES:
            origins, directions = random_rays(200, dtype)
            rays = pt.RayScene(hand_scene())
            hits = rays.closest(origins, directions, detail="t")
            bounds = rays.bounds(origins, directions, hits.object)
            expected = rows_of_program(HAND_SCENE, columns(origins, directions), "--bounds",
                                       "--precision", precision(dtype))
            np.testing.assert_array_equal(
                np.array([row[-2:] for row in expected if row[0] == "1"], np.float64),
                bounds[hits.hit])
            self.assertTrue((bounds[~hits.hit] == (np.inf, -np.inf)).all())
            np.testing.assert_array_equal(
                rays.bounds(origins, directions, 1),
                rays.bounds(origins, directions, np.ones(len(directions), np.int32)))

    def test_hits_are_one_or_another(self):
        rays = pt.RayScene(hand_scene())
        hits = rays.closest(*random_rays(3))
        self.assertEqual(hits, hits)
        self.assertNotEqual(hits, rays.closest(*random_rays(3)))

    def test_hits_worked_out_by_hand(self):
        rays = pt.RayScene(hand_scene())
        hits = rays.closest((0, 0, 0), [(0, 0, 1.0), (0, -2, 0), (0, 1, 0)])
        np.testing.assert_array_equal(hits.t, [4, 1, np.inf])
        np.testing.assert_array_equal(hits.object, [0, 1, -1])
        np.testing.assert_array_equal(hits.normal, [(0, 0, -1), (0, 1, 0), (0, 0, 0)])
        np.testing.assert_array_equal(hits.point, [(0, 0, 4), (0, -2, 0), [np.nan] * 3])
        beyond = rays.closest((0, 0, 0), (0, 0, 1), t_min=4.5)
        self.assertEqual((beyond.t, beyond.object), (6, 0))
        self.assertFalse(rays.occluded((0, 0, 0), (0, 0, 1), t_max=4))
        every = rays.all_hits((0, 0, 0), [(0, 1, 0), (0, 0, 1)])
        np.testing.assert_array_equal(every.offsets, [0, 0, 2])
        np.testing.assert_array_equal(every.t, [4, 6])

    def test_points_of_both_kernels(self):
        origins, directions = random_rays(1000)
        for kernel in ("packet", "scalar"):
            hits = pt.RayScene(hand_scene(), kernel=kernel).closest(origins, directions)
            points = origins + hits.t[:, None] * directions
            np.testing.assert_allclose(hits.point[hits.hit], points[hits.hit], atol=1e-12)
            self.assertTrue(np.isnan(hits.point[~hits.hit]).all())
            self.assertFalse(hits.normal[~hits.hit].any())

    def test_rays_that_leave_hits(self):
        for dtype in DTYPES:
            rays = pt.RayScene(hand_scene())
            origins, directions = random_rays(20000, dtype)
            first = rays.closest(origins, directions, detail="start")
            on = rays.closest(first.leave(directions), directions)
            every = rays.all_hits(origins, directions)
            counts = np.diff(every.offsets)
            # A ray that continues straight on hits one surface less.
            self.assertGreater((counts > 1).sum(), 100)
            self.assertGreater(np.mean(on.hit == (counts > 1)), 0.999)
            second = every.t[every.offsets[:-1][counts > 1] + 1]
            both = on.hit[counts > 1]
            far = (first.t + on.t)[counts > 1]
            np.testing.assert_allclose(far[both], second[both], rtol=1e-4)
        with self.assertRaisesRegex(ValueError, 'detail="start"'):
            rays.closest(origins, directions).leave(directions)

    def test_lights(self):
        scene = hand_scene()
        scene.lights = [pt.Light("point", 1, (0, 4, 5)), pt.Light("ambient", 1),
                        pt.Light("directional", 1, (0, 1, 0))]
        rays = pt.RayScene(scene)
        # The ball's shadow on the floor: the light is 4 above its centre and 6 above the floor.
        edge = 6 * np.tan(np.arcsin(1 / 4))
        places = np.array([[edge - 0.01, -2, 5], [edge + 0.01, -2, 5], [0, 0.9, 5], [0, 1.1, 5],
                           [np.nan, 0, 0]])
        places[:, 1] += 1e-9
        self.assertEqual(rays.lit(places, 0).tolist(), [False, True, False, True, False])
        self.assertEqual(rays.lit(places, 2).tolist(), [True, True, False, True, False])
        for dtype in DTYPES:
            origins, directions = random_rays(20000, dtype)
            hits = rays.closest(origins, directions, detail="start")
            for light, way in ((0, np.array([0, 4, 5]) - hits.point), (2, np.array([0, 1.0, 0]))):
                way = np.broadcast_to(way, hits.point.shape).astype(dtype)
                lit = rays.lit(hits, light)
                self.assertEqual(lit.shape, hits.t.shape)
                self.assertFalse(lit[~hits.hit].any())
                self.assertTrue(lit.any())
                dark = rays.occluded(hits.leave(way).origin, way, 0, 1.0 - 1e-5 if light == 0 else np.inf)
                self.assertGreater(np.mean((lit == ~dark)[hits.hit]), 0.9999)
        for light in (1, 3, -1):
            with self.assertRaisesRegex(ValueError, rf"^lights\[{light}\]"):
                rays.lit(hits, light)
        for light in (1.5, "a", None, 2**70):
            with self.assertRaisesRegex(ValueError, "^light is .*; use a whole number"):
                rays.lit(hits, light)
        with self.assertRaisesRegex(ValueError, 'detail="start"'):
            rays.lit(rays.closest(origins, directions), 0)
        with self.assertRaisesRegex(ValueError, "shape"):
            rays.lit(np.zeros((4, 2)), 0)

    def test_threads_change_nothing(self):
        origins, directions = random_rays(100_000)
        answers = [pt.RayScene(hand_scene(), threads=threads).closest(origins, directions)
                   for threads in (1, 2, 0)]
        for answer in answers[1:]:
            np.testing.assert_array_equal(answers[0].t, answer.t)
            np.testing.assert_array_equal(answers[0].normal, answer.normal)

    def test_several_threads_may_ask_at_once(self):
        origins, directions = random_rays(50_000)
        rays = pt.RayScene(hand_scene())
        answers = [None] * 4

        def ask(number):
            answers[number] = rays.closest(origins, directions).t

        workers = [threading.Thread(target=ask, args=(number,)) for number in range(4)]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
        for answer in answers:
            np.testing.assert_array_equal(answer, answers[0])


class TestArrays(unittest.TestCase):
    def setUp(self):
        self.rays = pt.RayScene(hand_scene())

    def test_any_strides_give_the_same_answer(self):
        for dtype in DTYPES:
            origins, directions = random_rays(10_000, dtype)
            expected = self.rays.closest(origins, directions)
            wide = np.zeros((20_000, 7), dtype)
            wide[::2, 1:4], wide[::2, 4:7] = origins, directions
            unaligned = np.frombuffer(b"x" + np.ascontiguousarray(directions).tobytes(), np.uint8)[1:]
            unaligned = unaligned.view(dtype).reshape(-1, 3)
            for given in ((np.ascontiguousarray(origins), np.ascontiguousarray(directions)),
                          (wide[::2, 1:4], wide[::2, 4:7]), (origins, unaligned),
                          (origins[::-1][::-1], directions)):
                hits = self.rays.closest(*given, np.zeros(10_000, dtype), np.inf)
                np.testing.assert_array_equal(hits.t, expected.t)
                np.testing.assert_array_equal(hits.normal, expected.normal)
            back = self.rays.closest(origins[::-1], directions[::-1])
            np.testing.assert_array_equal(back.object[::-1], expected.object)

    def test_numbers_of_other_scenes_are_refused(self):
        origins, directions = random_rays(10)
        hits = self.rays.closest(origins, directions, detail="start")
        starts = hits.leave(directions)
        starts.surface[3] = 10**6
        with self.assertRaisesRegex(ValueError, "surface 1000000 of"):
            self.rays.closest(starts, directions)
        hits.surface[3] = 10**6
        lit = pt.RayScene(pt.Scene(objects=[pt.Object(pt.Sphere((0, 0, 5), 1))],
                                   lights=[pt.Light("point", 1, (0, 5, 0))]))
        with self.assertRaisesRegex(ValueError, "surface [0-9]+ of 1;"):
            lit.lit(hits, 0)
        hits.surface = hits.surface[:5]
        with self.assertRaisesRegex(ValueError, r"hits.surface is int32 of shape \(5,\)"):
            lit.lit(hits, 0)
        for number in (2**32, -2**32, 2**31):
            with self.assertRaisesRegex(ValueError, str(number)):
                self.rays.bounds((0, 0, 0), (0, 0, 1), np.int64(number))
            with self.assertRaisesRegex(ValueError, str(number)):
                self.rays.transform(np.array([number]), np.eye(4)[None])

    def test_parts_of_starts_and_hits_that_were_replaced_are_refused_in_one_line(self):
        origins, directions = random_rays(10)
        lit = pt.RayScene(pt.Scene(objects=[pt.Object(pt.Sphere((0, 0, 5), 1))],
                                   lights=[pt.Light("point", 1, (0, 5, 0))]))
        hits = lit.closest(origins, directions, detail="start")
        starts = hits.leave(directions)
        for wrong in (starts.surface[:1], starts.surface.astype(np.int64), None, [0] * 10):
            changed = dataclasses.replace(starts, surface=wrong)
            with self.assertRaisesRegex(ValueError, r"^starts.surface is .*; use [^\n]*\Z"):
                lit.closest(changed, directions)
            changed = dataclasses.replace(hits, surface=[] if wrong is None else wrong)
            with self.assertRaisesRegex(ValueError, r"^hits.surface is .*; use [^\n]*\Z"):
                lit.lit(changed, 0)
        for wrong in (starts.point[:1], starts.point.astype(np.float32), None):
            changed = dataclasses.replace(starts, point=wrong)
            with self.assertRaisesRegex(ValueError, r"^starts.point is .*; use [^\n]*\Z"):
                lit.closest(changed, directions)
        one = pt.Starts(starts.origin[3], starts.point[3], starts.surface[3])
        self.assertEqual(lit.closest(one, directions[3]).t, lit.closest(starts, directions).t[3])

    def test_the_compiled_part_reads_no_further_than_arrays_go(self):
        # Arguments that rays.py refuses before they reach the compiled part.
        rays = [np.ones((10, 3)), np.ones((10, 3)), np.zeros(10), np.ones(10)]
        hits = [np.empty(10), np.empty(10, np.int32), None, None, None, None, None]
        for points, surfaces in ((10, 1), (1, 10)):
            with self.assertRaisesRegex(ValueError, "1 .*10 rays"):
                self.rays._native.closest(*rays, np.ones((points, 3)), np.zeros(surfaces, np.int32),
                                          *hits)

    def test_starts_and_hits_are_no_vectors(self):
        origins, directions = random_rays(10)
        hits = self.rays.closest(origins, directions, detail="start")
        starts = hits.leave(directions)
        for ask in (self.rays.occluded, self.rays.all_hits,
                    lambda a, b: self.rays.bounds(a, b, hits.object)):
            with self.assertRaisesRegex(ValueError, "^origins are Starts, which are for the origins of"
                                                    " closest alone"):
                ask(starts, directions)
        with self.assertRaisesRegex(ValueError, "^points are Starts"):
            self.rays.lit(starts, 0)
        with self.assertRaisesRegex(ValueError, "^origins are Hits; use .*hits.point"):
            self.rays.closest(hits, directions)
        with self.assertRaisesRegex(ValueError, "^origins is None, which is no array of vectors"):
            self.rays.closest(dataclasses.replace(starts, origin=None), directions)
        with self.assertRaisesRegex(ValueError, r"^directions is 'x'; use an array of shape \(10, 3\)"):
            hits.leave("x")

    def test_what_is_no_number_or_array_is_refused(self):
        for ends in ((None, 9), (0, None)):
            with self.assertRaisesRegex(ValueError, "None; use a number"):
                self.rays.closest((0, 0, 0), (0, 0, 1), *ends)
        origins, directions = random_rays(10)
        hits = self.rays.closest(origins, directions, detail="normal")
        with self.assertRaisesRegex(ValueError, "out is a int"):
            self.rays.closest(origins, directions, out=3)
        hits.normal = np.ascontiguousarray(hits.normal)
        with self.assertRaisesRegex(ValueError, "out.normal has strides"):
            self.rays.closest(origins, directions, detail="normal", out=hits)
        hits.normal = hits.normal.tolist()
        with self.assertRaisesRegex(ValueError, "out.normal is a list"):
            self.rays.closest(origins, directions, detail="normal", out=hits)
        starts = self.rays.closest(origins, directions, detail="start")
        with self.assertRaisesRegex(ValueError, "these hits need"):
            starts.leave(directions[:5])
        for wrong in ((10**400, 0, 0), "abc", {}):
            with self.assertRaisesRegex(ValueError, "is no array of vectors"):
                self.rays.closest(wrong, directions)
        for wrong in (10**400, "a", 1j):
            with self.assertRaisesRegex(ValueError, "^t_max is .*; use a number"):
                self.rays.closest(origins, directions, 0, wrong)
        with self.assertRaisesRegex(ValueError, "zero byte"):
            pt.read_scene("a\0b")

    def test_texts_are_no_numbers(self):
        directions = [(0, 0, 1.0)] * 2
        hits = self.rays.closest((0, 0, 0), directions, detail="start")
        asks = (self.rays.closest, self.rays.occluded, self.rays.all_hits,
                lambda *rays: self.rays.bounds(*rays[:2], 0, *rays[2:]))
        for text in ("1", b"1", "far", np.str_("1"), np.array("1"), np.array("1", object), ["1", 2],
                     [1, b"2"]):
            for ask in asks:
                with self.assertRaisesRegex(ValueError, r"^t_min is [^\n]*; use a number[^\n]*\Z"):
                    ask((0, 0, 0), directions, text)
                with self.assertRaisesRegex(ValueError, r"^t_max is [^\n]*; use a number[^\n]*\Z"):
                    ask((0, 0, 0), directions, 0, text)
        for texts in ("abc", ("0", "0", "1"), (0, None, "1"), (0, 0, np.str_("1"))):
            for rays in ((texts, (0, 0, 1)), ((0, 0, 0), texts)):
                with self.assertRaisesRegex(ValueError, r"is no array of vectors; use [^\n]*\Z"):
                    self.rays.closest(*rays)
            with self.assertRaisesRegex(ValueError, "^points is .*is no array of vectors"):
                self.rays.lit(texts, 0)
            with self.assertRaisesRegex(ValueError, "^directions is .*; use an array of shape"):
                hits.leave(texts)

    def test_answers_have_the_shape_and_dtype_of_the_rays(self):
        for dtype in DTYPES:
            for shape in ((), (0,), (4,), (2, 3), (2, 3, 4)):
                directions = np.zeros((*shape, 3), dtype)
                directions[..., 2] = 1
                hits = self.rays.closest(np.zeros(3, dtype), directions, detail="start")
                for array in (hits.t, hits.normal, hits.point, hits.outer_start):
                    self.assertEqual(array.dtype, dtype)
                self.assertEqual(hits.t.shape, shape)
                self.assertEqual(hits.normal.shape, (*shape, 3))
                self.assertTrue((hits.t == 4).all() and (hits.normal == (0, 0, -1)).all())
                self.assertEqual(self.rays.occluded(directions, directions).shape, shape)
                self.assertEqual(self.rays.closest(hits.leave(directions), directions).t.shape, shape)

    def test_out_is_overwritten(self):
        origins, directions = random_rays(1000)
        hits = self.rays.closest(origins, directions)
        expected = hits.t.copy()
        hits.t[:] = -1
        memory = hits.normal.__array_interface__["data"]
        again = self.rays.closest(origins, directions, out=hits)
        self.assertIs(again, hits)
        self.assertEqual(memory, again.normal.__array_interface__["data"])
        np.testing.assert_array_equal(hits.t, expected)
        with self.assertRaisesRegex(ValueError, r"out.t is float64 of shape \(1000,\)"):
            self.rays.closest(origins[:5], directions[:5], out=hits)
        with self.assertRaisesRegex(ValueError, "out.normal is not None"):
            self.rays.closest(origins, directions, out=hits, detail="t")
        hits.t.flags.writeable = False
        with self.assertRaisesRegex(ValueError, "^out.t is read-only; use hits"):
            self.rays.closest(origins, directions, out=hits)

    def test_wrong_arrays_are_refused(self):
        good = np.zeros((5, 3))
        for message, arguments in (
                (r"origins has shape \(5, 2\); use \(..., 3\)", (good[:, :2], good)),
                (r"directions has shape \(3, 5\)", (good, good.T)),
                (r"origins is int64; use float32 or float64", (good.astype(int), good)),
                (r"directions is >f8", (good, good.astype(">f8"))),
                (r"origins is object", (good.astype(object), good)),
                (r"origins are float64 and directions float32", (good, good.astype(np.float32))),
                (r"origins have shape \(5, 3\) and directions \(4, 3\)", (good, good[:4])),
                (r"t_min has shape \(4,\); use a number or the rays' shape \(5,\)",
                 (good, good, np.zeros(4))),
                (r"t_max is float32 and origins float64", (good, good, 0, np.ones(5, np.float32))),
                (r"t_max is 'far'; use a number", (good, good, 0, "far")),
                (r"is no array of vectors", ("north", good))):
            with self.subTest(message), self.assertRaisesRegex(ValueError, message):
                self.rays.closest(*arguments)
        with self.assertRaisesRegex(ValueError, "detail is 'most'; use one of 't', 'normal'"):
            self.rays.closest(good, good, detail="most")
        with self.assertRaisesRegex(ValueError, r"^object\[4\] is 3; use -1 to 2"):
            self.rays.bounds(good, good, np.array([0, 0, 0, 0, 3]))
        with self.assertRaisesRegex(ValueError, "object is float64"):
            self.rays.bounds(good, good, np.zeros(5))

    def test_wrong_options_are_refused(self):
        scene = hand_scene()
        for message, options in (("kernel is 'gpu'; use one of 'packet', 'scalar'", {"kernel": "gpu"}),
                                 ("isa.*mmx", {"isa": "mmx"}),
                                 ("threads is -1", {"threads": -1}),
                                 ("threads is 1000000; use 0, .* up to 1024", {"threads": 10**6}),
                                 ("lanes is 'many'", {"lanes": "many"}),
                                 ("lanes is 3; use 0, for the most, or", {"lanes": 3}),
                                 ("^dtype is 'x'; use np.float32 or np.float64", {"dtype": "x"}),
                                 ("dtype is int64", {"dtype": int})):
            with self.subTest(message), self.assertRaisesRegex(ValueError, message):
                pt.RayScene(scene, **options)
        for choice in ({"isa": "avx2"}, {"lanes": 8}, {"traversal": "tree"}, {"accuracy": "fast"}):
            with self.assertRaisesRegex(ValueError, "^the scalar kernel has no [^\n]*; leave it out"):
                pt.RayScene(scene, kernel="scalar", **choice)
        with self.assertRaisesRegex(pt.SceneError, "radius"):
            pt.RayScene(pt.Scene(objects=[pt.Object(pt.Sphere(radius=-1))]))

    def test_rays_that_mean_nothing_hit_nothing(self):
        origins, directions = random_rays(100)
        origins[::2, 1] = np.nan
        hits = self.rays.closest(origins, directions)
        self.assertFalse(hits.hit[::2].any())
        self.assertTrue(hits.hit[1::2].any())


    def test_t_max_beyond_float32_is_infinity(self):
        origins, directions = random_rays(100, np.float32)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            for most in (1e300, np.float64(1e300), [1e300] * 100):
                hits = self.rays.closest(origins, directions, 0, most)
                np.testing.assert_array_equal(hits.t, self.rays.closest(origins, directions).t)

    def test_vectors_beyond_float32_are_refused(self):
        origins, directions = random_rays(100, np.float32)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaisesRegex(ValueError, "^directions is .*, beyond float32; use"):
                self.rays.closest(origins, (0, 0, 1e300))
            with self.assertRaisesRegex(ValueError, "^origins is .*, beyond float32; use"):
                self.rays.occluded((0, np.inf, -1e300), directions)
            hits = self.rays.closest(origins, directions, detail="start")
            with self.assertRaisesRegex(ValueError, "^directions is .*, beyond float32; use"):
                hits.leave((0, 0, 1e300))
            # As in arrays, infinity itself is not checked.
            self.assertFalse(self.rays.occluded((0, 0, np.inf), directions).any())

    def test_a_negative_t_min_is_refused(self):
        asks = (self.rays.closest, self.rays.occluded, self.rays.all_hits,
                lambda *rays: self.rays.bounds(*rays[:2], 0, *rays[2:]))
        for dtype in DTYPES:
            origins, directions = random_rays(5, dtype)
            several = np.array([0, np.nan, -2, 1, -1], dtype)
            for ask in asks:
                with self.assertRaisesRegex(ValueError, r"^t_min is -0\.5; use 0 or more$"):
                    ask(origins, directions, -0.5)
                with self.assertRaisesRegex(ValueError, r"^t_min has -2\.0; use 0 or more$"):
                    ask(origins, directions, several)
                ask(origins[:0], directions[:0], several[:0])
            least = np.array([0, -0.0, np.nan, np.inf, 0], dtype)
            self.assertFalse(self.rays.closest(origins, directions, least).hit[2:4].any())
            self.assertFalse(self.rays.occluded(origins, directions, np.nan).any())

    def test_lit_refuses_numbers_of_no_surface(self):
        lit = pt.RayScene(pt.Scene(objects=[pt.Object(pt.Sphere((0, 0, 5), 1))],
                                   lights=[pt.Light("point", 1, (0, 5, 0))]))
        hits = lit.closest((0, 0, 0), [(0, 0, 1.0), (0, 1, 0)], detail="start")
        self.assertFalse(lit.lit(hits, 0)[1])
        hits.surface[0] = -1
        lit.lit(hits, 0)
        for number in (-2, -12345):
            hits.surface[0] = number
            with self.assertRaisesRegex(ValueError, f"^hits.surface has {number}; use"):
                lit.lit(hits, 0)


class TestMoving(unittest.TestCase):
    """Answers after a move equal those of a new scene."""

    def setUp(self):
        self.scene = pt.generate_random_spheres(200, 0.02)
        self.rays = {dtype: random_rays(20_000, dtype) for dtype in DTYPES}

    def assert_like_new(self, moved):
        for dtype in DTYPES:
            found = moved.closest(*self.rays[dtype])
            expected = pt.RayScene(self.scene).closest(*self.rays[dtype])
            np.testing.assert_array_equal(found.object, expected.object)
            np.testing.assert_array_equal(found.t, expected.t)
            self.assertTrue(found.hit.any())

    def test_update(self):
        rays = pt.RayScene(self.scene)
        self.assert_like_new(rays)
        for number in range(3):
            for i, item in enumerate(self.scene.objects):
                self.scene.objects[i] = item.translate((0.01 * number, 0.02, 0))
            done = rays.update(self.scene)
            self.assert_like_new(rays)
        self.assertFalse(done.rebuilt)
        self.assertGreater(done.cost, 0)

    def test_update_keeps_number_and_lights(self):
        point = np.zeros(3)
        for first in (np.float32, None):    # the precision that is prepared in advance
            scene = pt.Scene(objects=[pt.Object(pt.Sphere((0, 3, 0), 1))],
                             lights=[pt.Light("point", 1, (0, 9, 0))])
            rays = pt.RayScene(scene, dtype=first)
            scene.lights = []
            scene.objects[0].casts_shadow = False
            rays.update(scene)
            self.assertFalse(rays.lit(point.astype(np.float32), 0))
            self.assertFalse(rays.lit(point, 0))
            scene.objects.append(pt.Object(pt.Sphere((0, 0, 5), 1)))
            with self.assertRaisesRegex(ValueError, "has 2 objects"):
                rays.update(scene)
            self.assertEqual(rays.closest((0, 0, 0), (0.0, 0.0, 1.0)).object, -1)

    def test_transforms(self):
        rays = pt.RayScene(self.scene)
        self.assert_like_new(rays)
        random = np.random.default_rng(5)
        for _ in range(3):
            objects = np.arange(0, 200, 3)
            transforms = np.tile(np.eye(4), (len(objects), 1, 1))
            transforms[:, :3, 3] = random.uniform(-0.05, 0.05, (len(objects), 3))
            done = rays.transform(objects, transforms)
            for number, transform in zip(objects, transforms):
                self.scene.objects[number].transform = transform
            self.assert_like_new(rays)
        self.assertFalse(done.rebuilt)
        self.assertFalse(rays.transform([], np.empty((0, 4, 4))).rebuilt)
        self.assert_like_new(rays)

    def test_updates_get_their_turn_while_others_ask(self):
        rays = pt.RayScene(self.scene, threads=1)
        asked = random_rays(100_000)
        stop = threading.Event()
        counts = [0] * 3

        def ask(number):
            while not stop.is_set():
                rays.closest(*asked)
                counts[number] += 1

        workers = [threading.Thread(target=ask, args=(number,)) for number in range(3)]
        for worker in workers:
            worker.start()
        try:
            for _ in range(20):
                rays.update(self.scene)
        finally:
            stop.set()
            for worker in workers:
                worker.join()
        # Each update waits for the running queries, not for all later ones.
        self.assertLess(sum(counts), 1000)

    def test_wrong_moves_change_nothing(self):
        rays = pt.RayScene(self.scene)
        self.assert_like_new(rays)
        flat = np.diag((1.0, 0, 1, 1))
        with self.assertRaisesRegex(pt.SceneError, r"^objects\[4\]: the transform is singular"):
            rays.transform([3, 4], [np.diag((2.0, 2, 2, 1)), flat])
        for message, arguments in (("objects are float64", ([1.5], np.eye(4)[None])),
                                   (r"transforms are float64 of shape \(4, 4\)", ([1], np.eye(4))),
                                   (r"^transforms\[1\]: the last row",
                                    ([1, 2], np.stack((np.eye(4), np.ones((4, 4)))))),
                                   (r"^objects\[0\] is 200; use 0 to 199", ([200], np.eye(4)[None]))):
            with self.subTest(message), self.assertRaisesRegex(ValueError, message):
                rays.transform(*arguments)
        with self.assertRaisesRegex(ValueError, "object"):
            rays.update(hand_scene())
        self.assert_like_new(rays)


class TestInterrupts(unittest.TestCase):
    def test_ctrl_c_stops_a_long_call(self):
        rays = pt.RayScene(hand_scene(), threads=1)
        count = 3_000_000
        directions = np.broadcast_to((0.0, 0.0, 1.0), (count, 3))
        # Bounds take seconds; the signal arrives long before their end.
        interrupt(self, lambda: rays.bounds((0, 0, 0), directions, np.zeros(count, np.int32)))

    def test_ctrl_c_stops_the_scalar_kernel(self):
        scene = pt.generate_sphereflake(4)
        scene.lights = [pt.Light("point", 1, (0, 5, 0))]
        count = 1_000_000    # a minute on one thread
        directions = np.broadcast_to((0.0, 0.0, 1.0), (count, 3))
        for threads in (1, 2, 0):
            rays = pt.RayScene(scene, kernel="scalar", threads=threads, dtype=np.float64)
            for ask in (rays.closest, rays.occluded, rays.all_hits):
                with self.subTest(threads=threads, ask=ask.__name__):
                    interrupt(self, lambda: ask((0, 0, -5), directions))
            with self.subTest(threads=threads, ask="lit"):
                interrupt(self, lambda: rays.lit(directions, 0))

    def test_ctrl_c_leaves_a_scene_that_answers(self):
        rays = pt.RayScene(pt.generate_sphereflake(4), kernel="scalar", threads=2)
        directions = np.broadcast_to((0.0, 0.0, 1.0), (1_000_000, 3))
        before = rays.closest((0, 0, -5), directions[:100])
        interrupt(self, lambda: rays.closest((0, 0, -5), directions))
        np.testing.assert_array_equal(rays.closest((0, 0, -5), directions[:100]).t, before.t)

    def test_a_signal_that_raises_nothing_changes_nothing(self):
        arrived = []
        scene = pt.generate_sphereflake(4)    # a second of work
        before = signal.signal(signal.SIGALRM, lambda *_: arrived.append(1))
        signal.setitimer(signal.ITIMER_REAL, 0.02, 0.02)
        try:
            origins, directions = random_rays(20_000)
            rays = pt.RayScene(scene, kernel="scalar", threads=2)
            found = rays.closest(origins, directions)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)
        self.assertGreater(len(arrived), 0)
        expected = pt.RayScene(scene, kernel="scalar").closest(origins, directions)
        np.testing.assert_array_equal(found.t, expected.t)


class TestMemory(unittest.TestCase):
    """The peak of memory shows whether rays were copied: a copy of these takes 96 MB or more."""

    def peak_above(self, work):
        work()
        before, _ = resident_bytes()
        reset_peak()
        work()
        return resident_bytes()[1] - before

    def test_rays_are_not_copied(self):
        count = 4_000_000
        for dtype in DTYPES:
            one_vector = count * 3 * np.dtype(dtype).itemsize
            for order in ("F", "C"):
                origins = np.zeros((count, 3), dtype, order)
                directions = np.ones((count, 3), dtype, order)
                rays = pt.RayScene(hand_scene(), dtype=dtype)
                hits = rays.closest(origins, directions, detail="t")
                mask = rays.occluded(origins, directions)
                with self.subTest(dtype=dtype, order=order):
                    peak = self.peak_above(
                        lambda: rays.closest(origins, directions, out=hits, detail="t"))
                    self.assertLess(peak, one_vector / 3)
                    peak = self.peak_above(lambda: rays.occluded(origins, directions))
                    self.assertLess(peak, mask.nbytes + one_vector / 3)


if __name__ == "__main__":
    unittest.main()
