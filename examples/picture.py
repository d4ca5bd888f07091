"""Ten lines to a picture: picture.png, the same as picture.cpp's."""

import packtrace as pt

red = pt.ScratchMaterial(color=(1, 0.2, 0.1))
scene = pt.Scene(
    camera=pt.Camera(fov=50),
    objects=[pt.Object(pt.Sphere((0, 0, 5), 1), red), pt.Object(pt.Plane((0, -1, 0)))],
    lights=[pt.Light(intensity=0.2), pt.Light("point", 0.8, (-3, 4, 0))])
pt.render(scene).save("picture.png")
