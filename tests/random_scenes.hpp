#pragma once

#include "scenes.hpp"
#include <packtrace/build.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

// Random scenes that use everything the scene language can express, built in code.
namespace packtrace::test {

class RandomScene {
public:
    explicit RandomScene(unsigned seed) : random_(seed)
    {
        scene.illumination = static_cast<Illumination>(below(5));
        scene = make_scene(scene.illumination);
        add_settings();
        add_camera();
        const int objects = 1 + below(6);
        for (int i = 0; i < objects; ++i)
            add_object();
        for (int i = below(4); i > 0; --i)
            add_light();
        if (chance(0.1))
            add_animation();
    }

    Scene scene;

    [[nodiscard]] int below(int count)
    {
        return static_cast<int>(random_.between(0.0, count));
    }

    [[nodiscard]] bool chance(double share)
    {
        return random_.between(0.0, 1.0) < share;
    }

    [[nodiscard]] Vec3 vector(double size)
    {
        return random_.inside(Vec3(-size), Vec3(size));
    }

private:
    void add_settings()
    {
        set_size(scene, 1 + below(9), 1 + below(9));
        scene.background = random_.inside(Vec3(0.0), Vec3(1.0));
        scene.max_depth = below(5);
        if (chance(0.3))
            scene.min_weight = random_.between(0, 0.2);
        scene.shadows = static_cast<ShadowKind>(below(3));
        if (scene.illumination == Illumination::general)
            scene.depth_limit = static_cast<DepthLimit>(below(2));
        if (chance(0.3))
            scene.camera.pixel_sample = {random_.between(0, 1), random_.between(0, 1)};
    }

    void add_camera()
    {
        Camera& camera = scene.camera;
        camera.viewport = {random_.between(0.5, 2), random_.between(0.5, 2)};
        camera.distance = random_.between(0.3, 2);
        if (chance(0.5))
            camera.fov = random_.between(10, 120);
        if (chance(0.2))
            return;
        camera.position = vector(6.0);
        camera.rotation = look_at(camera.position, vector(2.0) + Vec3(0, 0, 9), {0.1, 1, 0.02});
    }

    void add_object()
    {
        Object object = make_object(surface(), material(), name());
        if (std::holds_alternative<Plane>(object.surface) &&
            scene.illumination != Illumination::general && chance(0.5))
            object.material.checker =
                Checker{random_.inside(Vec3(0.0), Vec3(1.0)), random_.between(0.1, 2)};
        object.casts_shadow = !chance(0.2);
        scene.objects.push_back(placed(std::move(object)));
    }

    [[nodiscard]] Surface surface()
    {
        switch (below(8)) {
            case 0:
                return packtrace::sphere(vector(3.0) + Vec3(0, 0, 6), random_.between(0.05, 3));
            case 1:
                return packtrace::plane(vector(3.0), vector(1.0) + Vec3(0, 1.1, 0));
            case 2:
                return contours();
            case 3:
                return clipped(packtrace::quadric(coefficients()));
            default:
                return clipped(packtrace::quadric(static_cast<QuadricKind>(below(7))));
        }
    }

    /// Random coefficients of any sign whose surface is not empty.
    [[nodiscard]] std::array<double, 10> coefficients()
    {
        const double A = random_.between(0.2, 2);
        const double B = random_.between(-2, 2);
        const double C = random_.between(-2, 2);
        return {A,
                B,
                C,
                random_.between(-0.3, 0.3),
                0,
                random_.between(-0.3, 0.3),
                0,
                0,
                random_.between(-1, 1),
                -random_.between(0.5, 3)};
    }

    [[nodiscard]] Quadric clipped(Quadric quadric)
    {
        const double low = random_.between(-2, 0.5);
        const double high = low + random_.between(0.1, 3);
        switch (below(3)) {
            case 0:
                return quadric;
            case 1:
                return clip(std::move(quadric), low, high);
            default:
                return clip_and_cap(std::move(quadric), low, high);
        }
    }

    [[nodiscard]] std::vector<Vec3> ring(const Vec3& center, const Vec3& u, const Vec3& v)
    {
        std::vector<Vec3> corners;
        const int count = 3 + below(6);
        for (int i = 0; i < count; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / count;
            corners.push_back(center + std::cos(angle) * u + std::sin(angle) * v);
        }
        return corners;
    }

    [[nodiscard]] Polygon contours()
    {
        const Vec3 center = vector(2.0) + Vec3(0, 0, 6);
        const Vec3 u = vector(3.0);
        const Vec3 v = glm::cross(u, vector(1.0) + Vec3(0.3));
        Polygon polygon = packtrace::polygon(ring(center, u, v));
        if (chance(0.4))
            polygon.contours.push_back(ring(center, 0.3 * u, 0.3 * v));
        return polygon;
    }

    [[nodiscard]] Object placed(Object object)
    {
        for (int i = below(4); i > 0; --i)
            switch (below(4)) {
                case 0:
                    object = translate(std::move(object), vector(2.0));
                    break;
                case 1:
                    object = rotate(std::move(object), vector(1.0) + Vec3(0, 0, 1.1),
                                    random_.between(-360, 360));
                    break;
                case 2:
                    object = packtrace::scale(std::move(object),
                                              random_.inside(Vec3(0.3), Vec3(2.0)) *
                                                  (chance(0.3) ? Vec3(-1, 1, 1) : Vec3(1.0)));
                    break;
                default: {
                    Mat4 shear(1.0);
                    shear[1][0] = random_.between(-1, 1);
                    object = transform(std::move(object), shear);
                }
            }
        return object;
    }

    [[nodiscard]] std::string name()
    {
        static const char* const names[] = {"the hat", "a\\b", "größe",     "tab\tbed", "# { } = ,",
                                            "x x x",   "nan",  "sphere 77", "'",        "\xff\xfe"};
        if (!chance(0.3))
            return "";
        const std::string name = names[below(10)];
        return chance(0.3) ? name : name + (" of " + std::to_string(scene.objects.size()));
    }

    [[nodiscard]] Rgb factor(double most)
    {
        return chance(0.5) ? Rgb(random_.between(0, most)) : random_.inside(Vec3(0.0), Vec3(most));
    }

    /// Some materials share a name; the colours of some of these differ.
    [[nodiscard]] Material material()
    {
        if (chance(0.2) && !scene.objects.empty()) {
            Material same = scene.objects.back().material;
            same.checker.reset();
            if (chance(0.5) && scene.illumination != Illumination::general)
                same.color = random_.inside(Vec3(0.0), Vec3(1.0));
            return same;
        }
        Material material = make_material(scene.illumination, chance(0.4) ? "stuff" : "");
        if (scene.illumination != Illumination::general)
            material.color = random_.inside(Vec3(0.0), Vec3(1.0));
        std::visit([&](auto& model) { fill(model); }, material.model);
        return material;
    }

    void fill(ScratchMaterial& model)
    {
        model = {chance(0.5) ? -1.0 : random_.between(0, 200), random_.between(0, 1)};
    }
    void fill(SketchMaterial& model)
    {
        model = {factor(1), factor(1), factor(0.5), factor(0.5), random_.between(0, 100), ior()};
    }
    void fill(WhittedMaterial& model)
    {
        model = {factor(1), factor(1), factor(0.5), factor(0.5), random_.between(0, 100), ior()};
    }
    void fill(ShaderMaterial& model)
    {
        model.reflectance = {random_.between(0, 1), random_.between(0, 1), random_.between(0, 1),
                             random_.between(0, 50)};
    }
    void fill(GeneralMaterial& model)
    {
        model = {factor(1), factor(1), factor(1), factor(0.5), factor(0.5), random_.between(0, 100),
                 ior()};
    }

    [[nodiscard]] double ior()
    {
        return chance(0.3) ? 1.0 : random_.between(0.6, 2);
    }

    void add_light()
    {
        Light light = ambient_light(factor(1));
        if (chance(0.7)) {
            light = chance(0.5) ? packtrace::point_light(vector(9.0), factor(1))
                                : directional_light(vector(9.0) + Vec3(0, 10, 0), factor(1));
            light.casts_shadow = !chance(0.2);
        }
        scene.lights.push_back(light);
    }

    void add_animation()
    {
        Animation animation;
        animation.frames = 2 + below(100);
        if (chance(0.5))
            animation.orbit = Orbit{
                scene.camera.position + Vec3(1, 0, 0.3), {0, 2, 0.5}, random_.between(-720, 720)};
        else
            animation.keys = {{0, vector(1.0), Vec3(0.3, 0, 9), {0, 1, 0}},
                              {1, vector(1.0), Vec3(0, 0.3, 9), {0.2, 1, 0}}};
        scene.animation = animation;
    }

    SceneRandom random_;
};

}  // namespace packtrace::test
