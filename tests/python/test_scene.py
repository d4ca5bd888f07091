"""Scenes: from text, from files, built object by object, and back."""

import copy
import os
import pickle
import tempfile
import threading
import unittest
import warnings
from dataclasses import dataclass, replace

import numpy as np

import packtrace as pt
from support import SCENES, hand_scene


class TestText(unittest.TestCase):
    def test_reads_every_example_and_writes_what_reads_the_same(self):
        for file in sorted(SCENES.glob("*.scene")):
            with self.subTest(file.name):
                scene = pt.read_scene(file)
                text = scene.to_text()
                self.assertGreater(len(scene.objects), 0)
                self.assertEqual(scene.to_text(), text, "objects changed when Python took them")
                self.assertEqual(pt.Scene.from_text(text), scene)

    def test_threads_get_the_same_objects(self):
        text = "".join(f"sphere {{ center = ({i}, 0, 9)  radius = 1 }}\n" for i in range(2000))
        for _ in range(10):
            scene = pt.Scene.from_text(text)
            start = threading.Barrier(4)
            got = []

            def take():
                start.wait()
                got.append(scene.objects)

            workers = [threading.Thread(target=take) for _ in range(4)]
            for worker in workers:
                worker.start()
            for worker in workers:
                worker.join()
            self.assertEqual(len(got), 4)
            self.assertTrue(all(objects is scene.objects for objects in got))

    def test_names_in_scenes_need_not_be_utf8(self):
        text = b'sphere { name = "caf\xe9"  center = (0, 0, 5)  radius = 1 }'
        scene = pt.Scene.from_text(text)
        self.assertEqual(scene.objects[0].name, "caf\udce9")
        self.assertIn(b'"caf\xe9"', scene.to_text().encode(errors="surrogateescape"))
        self.assertEqual(pt.Scene.from_text(scene.to_text()), scene)
        self.assertEqual(pickle.loads(pickle.dumps(scene)), scene)
        self.assertEqual(copy.deepcopy(scene), scene)

    def test_file_names_may_be_bytes(self):
        file = SCENES / "four_spheres.scene"
        self.assertEqual(pt.read_scene(str(file).encode()), pt.read_scene(file))

    def test_file_names_need_not_be_utf8(self):
        with tempfile.TemporaryDirectory() as folder:
            name = os.fsencode(folder) + b"/\xff.scene"
            with open(name, "w") as file:
                file.write(hand_scene().to_text())
            self.assertEqual(pt.read_scene(name), hand_scene())
            self.assertEqual(pt.read_scene(os.fsdecode(name)), hand_scene())

    def test_what_is_no_text_is_refused(self):
        for wrong in (None, 5, ["sphere"]):
            with self.assertRaisesRegex(ValueError, "^text is .*; use a text$"):
                pt.Scene.from_text(wrong)
        for texts in (("\ud800",), ("sphere", "\ud800")):
            with self.assertRaisesRegex(ValueError, "surrogates"):
                pt.Scene.from_text(*texts)

    def test_wrong_text_is_refused_with_its_place(self):
        with self.assertRaisesRegex(pt.SceneError, r"^mine:1:10: unknown key 'raduis'"):
            pt.Scene.from_text("sphere { raduis = 1 }", "mine")
        with self.assertRaisesRegex(ValueError, "nowhere.scene"):
            pt.read_scene("nowhere.scene")

    def test_what_the_reader_mends_is_warned_of(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            pt.Scene.from_text("camera { rotation = (0.7071, 0, -0.7071, 0, 1, 0, 0.7071, 0, 0.7071) }\n"
                               "sphere { center = (0, 0, 3)  radius = 1 }")
        self.assertEqual(len(caught), 1)
        self.assertIn("rotation", str(caught[0].message))


class TestBuilding(unittest.TestCase):
    def test_a_scene_built_is_the_scene_read(self):
        read = pt.Scene.from_text("""
            illumination = whitted
            image_size = 64 x 48
            shadows = transparent
            camera { position = (1, 2, -3)  look_at = (0, 0, 4)  fov = 50 }
            material glass { specular = 0.1  transmissive = 0.8  ior = 1.5  shininess = 200 }
            sphere { name = "ball"  center = (0, 0, 4)  radius = 1  material = glass }
            plane { name = "floor"  point = (0, -1, 0)  normal = (0, 2, 0)
                    checker = rgb(1, 1, 1), rgb(0, 0, 0), 0.5  diffuse = 0.7 }
            cone { name = "hat"  z_range = (-1, 0)  capped = yes  rotate = (1, 0, 0, -90)
                   translate = (2, 1, 6)  scale = (1, 2, 1)  casts_shadow = no }
            quadric { name = "egg"  coefficients = (1, 2, 3, 0, 0, 0, 0, 0, 0, -1) }
            polygon { name = "sheet"  vertices = (-1, -1, 9), (-1, 1, 9), (1, 1, 9), (1, -1, 9)
                      vertices = (-0.5, -0.5, 9), (0.5, -0.5, 9), (0, 0.5, 9) }
            light { type = ambient  intensity = 0.2 }
            light { type = point  position = (2, 5, 0)  intensity = (0.5, 0.6, 0.7) }
            light { type = directional  direction = (1, 1, -1)  intensity = 0.1  casts_shadow = no }
        """)
        glass = pt.WhittedMaterial(name="glass", specular=0.1, transmissive=0.8, ior=1.5,
                                   shininess=200)
        built = pt.Scene(
            width=64, height=48, illumination="whitted", shadows="transparent",
            camera=pt.Camera.look_at((1, 2, -3), (0, 0, 4), fov=50),
            objects=[
                pt.Object(pt.Sphere((0, 0, 4), 1), glass, "ball"),
                pt.Object(pt.Plane((0, -1, 0), np.array([0, 2, 0])),
                          pt.WhittedMaterial(checker=pt.Checker(0, 0.5), diffuse=0.7), "floor"),
                replace(pt.Object(pt.Quadric("cone", z_range=(-1, 0), capped=True), name="hat",
                                  casts_shadow=False)
                        .rotate((1, 0, 0), -90).translate((2, 1, 6)).scale((1, 2, 1))),
                pt.Object(pt.Quadric(coefficients=(1, 2, 3, 0, 0, 0, 0, 0, 0, -1)), name="egg"),
                pt.Object(pt.Polygon([np.array([(-1, -1, 9), (-1, 1, 9), (1, 1, 9), (1, -1, 9.0)]),
                                      [(-0.5, -0.5, 9), (0.5, -0.5, 9), (0, 0.5, 9)]]), name="sheet"),
            ],
            lights=[pt.Light(intensity=0.2),
                    pt.Light("point", (0.5, 0.6, 0.7), (2, 5, 0)),
                    pt.Light("directional", 0.1, (1, 1, -1), casts_shadow=False)])
        self.assertEqual(built.to_text(), read.to_text())

    def test_changes_of_fields_count(self):
        scene = hand_scene()
        scene.objects[0].surface.radius=2
        del scene.objects[1:]
        self.assertIn("radius=2", scene.to_text())
        self.assertNotIn("floor", scene.to_text())

    def test_copies_and_pickles_are_the_same_scene(self):
        for make in (copy.copy, copy.deepcopy, lambda scene: pickle.loads(pickle.dumps(scene))):
            self.assertEqual(make(hand_scene()), hand_scene())

    def test_parts_that_hold_arrays_are_equal_by_their_numbers(self):
        zeros = np.zeros(3)
        self.assertIs(pt.Sphere(zeros) == pt.Sphere(np.zeros(3)), True)
        self.assertIs(pt.Sphere(zeros) == pt.Sphere((0, 0, 0)), True)
        self.assertIs(pt.Sphere([0, 0, 0]) == pt.Sphere((0, 0, 0)), True)
        self.assertIs(pt.Sphere(zeros) == pt.Sphere(np.ones(3)), False)
        self.assertIs(pt.Sphere(zeros) == pt.Sphere(np.zeros(2)), False)
        self.assertIs(pt.Sphere(zeros) != pt.Sphere(np.ones(3)), True)
        self.assertIs(pt.Sphere(zeros) == pt.Plane(zeros), False)
        self.assertIs(pt.Sphere(radius=np.float64(2)) == pt.Sphere(radius=2), True)
        corners = [(-1, -1, 9), (-1, 1, 9), (1, 1, 9)]
        self.assertEqual(pt.Polygon([np.array(corners)]), pt.Polygon([corners]))
        self.assertNotEqual(pt.Polygon([np.array(corners)]), pt.Polygon([corners, corners]))
        self.assertNotEqual(pt.Camera(fov=None), pt.Camera(fov=np.ones(1)))
        scene = pt.Scene(objects=[pt.Object(pt.Sphere(zeros), transform=np.eye(4))],
                         lights=[pt.Light(vector=zeros)])
        self.assertEqual(copy.deepcopy(scene), scene)
        other = copy.deepcopy(scene)
        other.objects[0].surface.center[2] = 1
        self.assertNotEqual(other, scene)

    def test_defaults_are_those_of_the_illumination(self):
        for illumination in ("scratch", "sketch", "whitted", "shader", "general"):
            with self.subTest(illumination):
                built = pt.Scene(illumination=illumination,
                                 objects=[pt.Object(pt.Sphere((0, 0, 3), 1), name="sphere 1")])
                read = pt.Scene.from_text(f"illumination = {illumination}\n"
                                          "sphere { center = (0, 0, 3) radius = 1 }")
                self.assertEqual(built.to_text(), read.to_text())

    def test_animations(self):
        scene = hand_scene()
        scene.animation = pt.Animation(4, pt.Orbit((0, 0, 5)))
        turned = np.asarray(scene.camera_at(1).position)
        self.assertAlmostEqual(np.linalg.norm(turned - (0, 0, 5)), 5)
        scene.animation = pt.Animation(3, keys=[pt.CameraKey(0), pt.CameraKey(2, (0, 0, 2),
                                                                              (0, 0, 3))])
        np.testing.assert_allclose(scene.camera_at(1).position, (0, 0, 1), atol=1e-15)
        with self.assertRaisesRegex(ValueError, "frame"):
            scene.camera_at(3)

    def test_generated_scenes(self):
        self.assertEqual(len(pt.generate_sphereflake(2).objects), 91)
        self.assertEqual(len(pt.generate_lattice(3).objects), 27)
        self.assertEqual(len(pt.generate_random_spheres(50, 0.01).objects), 50)
        for call, name in ((lambda: pt.generate_sphereflake(depth=2.5), "depth"),
                           (lambda: pt.generate_lattice(edge="3"), "edge"),
                           (lambda: pt.generate_random_spheres(2**40, 0.1), "count"),
                           (lambda: pt.generate_random_spheres(5, 0.1, seed=-1), "seed"),
                           (lambda: pt.generate_lattice(2, radius=None), "radius")):
            with self.assertRaisesRegex(ValueError, f"^{name} is .*; use a (whole )?number.*$"):
                call()
        with self.assertRaises(ValueError):
            pt.generate_lattice(0)


class TestErrors(unittest.TestCase):
    """Each message names the object, the fault, and a remedy."""

    def refuses(self, message, **fields):
        with self.assertRaisesRegex(ValueError, message):
            pt.Scene(**fields).validate()

    def test_values_of_the_wrong_type(self):
        ball = pt.Sphere((0, 0, 5), 1)
        self.refuses(r"^objects\[0\]: 'ball': center is \(0, 0\); use 3 numbers",
                     objects=[pt.Object(pt.Sphere((0, 0)), name="ball")])
        self.refuses(r"^objects\[1\]: radius is 'big'; use a number",
                     objects=[pt.Object(ball), pt.Object(pt.Sphere(radius="big"))])
        self.refuses(r"^objects\[0\]: is of the class Sphere; use an Object", objects=[ball])
        self.refuses(r"surface is None; use a Sphere", objects=[pt.Object(None)])
        self.refuses(r"material: .*class str; use the one that fits",
                     objects=[pt.Object(ball, "gold")])
        self.refuses(r"transform is \[1, 2\]; use 4 rows", objects=[pt.Object(ball, transform=[1, 2])])
        self.refuses(r"^objects\[0\]: transform is array\(\[\[1\., 0\., 0\.\], \[0\., 1\., 0\.\], "
                     r"\[0\., 0\., 1\.\]\]\); use 4 rows of 4 numbers\Z",
                     objects=[pt.Object(ball, transform=np.eye(3))])
        self.refuses(r"use a matrix with the last row \(0, 0, 0, 1\)",
                     objects=[pt.Object(ball, transform=np.ones((4, 4)))])
        self.refuses(r"kind is 'egg'; use one of 'ellipsoid'", objects=[pt.Object(pt.Quadric("egg"))])
        self.refuses(r"coefficients is \(1,\); use None, as the kind 'cone' has its own",
                     objects=[pt.Object(pt.Quadric("cone", (1,)))])
        self.refuses(r"^lights\[0\]: type is 'sun'; use one of 'ambient'", lights=[pt.Light("sun")])
        self.refuses(r"^illumination is 'dark'; use one of", illumination="dark")
        self.refuses(r"^width is 2.5; use a whole number", width=2.5)
        self.refuses(r"^width is 1099511627776; use a smaller whole number\Z",
                     width=2**40)
        self.refuses(r"^width is 1180591620717411303424; use a smaller whole number", width=2**70)
        self.refuses(r"^objects is 7; use a list", objects=7)
        self.refuses(r"^objects is <list_iterator.*>; use a list", objects=iter([pt.Object(ball)]))
        self.refuses(r"^objects\[0\]: name is '\\ud800'; use a text",
                     objects=[pt.Object(ball, name="\ud800")])
        self.refuses(r"^illumination is '\\ud800'; use one of", illumination="\ud800")
        self.refuses("^animation: is of the class int; use an Animation", animation=5)
        self.refuses("use the material class of its illumination",
                     objects=[pt.Object(ball, material=pt.WhittedMaterial())])

    def test_a_value_of_the_wrong_type_is_a_value_error_but_no_scene_error(self):
        for fields in ({"width": "a"}, {"objects": [pt.Object(pt.Sphere(radius="big"))]}):
            with self.assertRaises(ValueError) as refused:
                pt.Scene(**fields).validate()
            self.assertNotIsInstance(refused.exception, pt.SceneError)

    def test_messages_are_cut_between_characters(self):
        for letter in "é漢😀":
            self.refuses(f"^width is 'a{letter * 58}[.]{{3}}; use a whole number$",
                         width="a" + letter * 100)
        self.refuses("^width is 'a{58}'; use a whole number$", width="a" * 58)

        class Odd:
            def __repr__(self):
                return "\ud800"

        self.refuses(r"^width is \\ud800; use a whole number$", width=Odd())

    def test_a_list_may_shrink_while_it_is_read(self):
        center = []

        class Shrinking:
            def __float__(self):
                center.clear()
                return 1.0

        center += [Shrinking(), object(), object()]
        self.refuses(r"^objects\[0\]: center is \[\]; use 3 numbers",
                     objects=[pt.Object(pt.Sphere(center))])

    def test_values_that_no_scene_may_have(self):
        with self.assertRaisesRegex(pt.SceneError, "'width' x 'height' .*65537"):
            pt.Scene(width=65537).validate()
        with self.assertRaisesRegex(pt.SceneError, "'viewport'"):
            pt.Scene(camera=pt.Camera(viewport=(0, 1))).validate()
        with self.assertRaisesRegex(pt.SceneError, "ball.*radius.*above 0"):
            pt.Scene(objects=[pt.Object(pt.Sphere((0, 0, 5), -1), name="ball")]).validate()
        with self.assertRaisesRegex(pt.SceneError, "illumination"):
            pt.Scene(objects=[pt.Object(pt.Sphere(), pt.GeneralMaterial())]).validate()

    def test_what_is_in_a_list_is_named_by_its_index(self):
        ball = pt.Object(pt.Sphere((0, 0, 5), 1))
        self.refuses(r"^objects\[1\]: 'radius' is -1; use a number above 0$",
                     objects=[ball, pt.Object(pt.Sphere((0, 0, 5), -1))])
        self.refuses(r"^objects\[1\]: sphere 'big': 'radius' is -1; use a number above 0$",
                     objects=[ball, pt.Object(pt.Sphere((0, 0, 5), -1), name="big")])
        self.refuses(r"^lights\[1\]: 'intensity' is -1; use a number of 0 or more$",
                     objects=[ball], lights=[pt.Light(), pt.Light(intensity=-1)])
        self.refuses(r"^animation.keys\[1\]: frame 0 does not come after frame 0",
                     objects=[ball], animation=pt.Animation(9, keys=[pt.CameraKey(), pt.CameraKey()]))
        self.refuses(r"^animation.keys\[1\]: frame is 'x'; use a whole number", objects=[ball],
                     animation=pt.Animation(9, keys=[pt.CameraKey(), pt.CameraKey("x")]))
        self.refuses(r"^objects\[0\]: contours\[0\]\[2\] is \(0, 1\); use 3 numbers",
                     objects=[pt.Object(pt.Polygon([[(0, 0, 0), (1, 0, 0), (0, 1)]]))])
        with self.assertRaisesRegex(pt.SceneError, r"^objects\[0\]: 'radius'"):
            pt.render(pt.Scene(objects=[pt.Object(pt.Sphere(radius=0))]))
        # Messages about a text count from 1, as its names do, and give the position.
        with self.assertRaisesRegex(pt.SceneError, r"^mine:1:\d+: .*'intensity'"):
            pt.Scene.from_text("light { type = ambient intensity = -1 }", "mine")

    def test_a_misspelt_field_is_refused(self):
        sphere = pt.Sphere()
        with self.assertRaisesRegex(AttributeError,
                                    "^Sphere has no field 'radiuss'; did you mean 'radius'\\?$"):
            sphere.radiuss = 2
        self.assertEqual(sphere, pt.Sphere())
        with self.assertRaisesRegex(AttributeError, "'bachground'; did you mean 'background'"):
            hand_scene().bachground = 1
        with self.assertRaisesRegex(AttributeError, "'colour'; did you mean 'color'"):
            pt.WhittedMaterial().colour = 1
        with self.assertRaisesRegex(AttributeError, "^Light has no field 'x'; use one of: type, "
                                                    "intensity, vector, casts_shadow$"):
            pt.Light().x = 1

    def test_a_users_own_class_has_fields_of_its_own(self):
        @dataclass(eq=False)
        class Ball(pt.Sphere):
            weight: float = 1.0
            counter = 0

        ball = Ball((0, 0, 5), 1)
        ball.weight = 2
        ball.counter = 3
        ball._private = 4
        self.assertNotEqual(ball, Ball((0, 0, 5), 1))
        with self.assertRaises(AttributeError):
            ball.wait = 2

    def test_materials_may_be_made_when_they_are_asked_for(self):
        class Tinted(pt.Object):
            @property
            def material(self):
                return pt.ScratchMaterial(color=self._color)

            @material.setter
            def material(self, _):
                pass

        scene = pt.Scene(objects=[Tinted(pt.Sphere((x, 0, 5), 1)) for x in range(65)])
        colors = [(x / 64, 0.0, 0.0) for x in range(65)]
        for thing, color in zip(scene.objects, colors):
            thing._color = color
        self.assertEqual([thing.material.color
                          for thing in pt.Scene.from_text(scene.to_text()).objects], colors)

    def test_what_is_no_scene(self):
        with self.assertRaisesRegex(ValueError, "use a packtrace.Scene"):
            pt.render("a.scene")


if __name__ == "__main__":
    unittest.main()
