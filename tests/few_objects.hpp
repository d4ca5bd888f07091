#pragma once

#include "scenes.hpp"
#include <packtrace/build.hpp>

#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

namespace packtrace::test {

/// The usual number of scenes, or more if the environment asks for more.
[[nodiscard]] inline unsigned scene_count(unsigned usual)
{
    const char* const asked = std::getenv("PACKTRACE_FUSED_SCENES");
    return asked != nullptr ? static_cast<unsigned>(std::atoi(asked)) : usual;
}

/// Scenes of a few spheres, grounds and planes, some with quadrics and polygons. They challenge the
/// bounds of culling: bodies overlap or touch, eyes and lights are inside bodies, sizes and
/// distances span many magnitudes.
class FewObjects {
public:
    explicit FewObjects(unsigned seed) : random_(seed)
    {
        const Illumination kinds[] = {Illumination::scratch, Illumination::general,
                                      Illumination::whitted};
        scene = make_scene(kinds[below(3)]);
        set_size(scene, 9 + below(40), 5 + below(30));
        scene.max_depth = below(6);
        scene.background = random_.inside(Vec3(0.0), Vec3(0.5));
        add_objects();
        add_lights();
        add_camera();
    }

    Scene scene;

private:
    int below(int count)
    {
        return static_cast<int>(random_.between(0.0, count));
    }
    bool chance(double share)
    {
        return random_.between(0.0, 1.0) < share;
    }
    Vec3 vector(double size)
    {
        return random_.inside(Vec3(-size), Vec3(size));
    }
    /// From 10^-most to 10^most.
    double magnitude(double most)
    {
        return std::pow(10.0, random_.between(-most, most));
    }

    Material material()
    {
        Material any = make_material(scene.illumination);
        any.color = random_.inside(Vec3(0.0), Vec3(1.0));
        const double mirror = chance(0.7) ? random_.between(0.1, 0.9) : 0.0;
        if (auto* scratch = std::get_if<ScratchMaterial>(&any.model)) {
            scratch->specular = chance(0.7) ? random_.between(1, 1000) : -1.0;
            scratch->reflective = mirror;
        } else if (auto* whitted = std::get_if<WhittedMaterial>(&any.model)) {
            whitted->ambient = Rgb(0.5);
            whitted->diffuse = Rgb(0.6);
            whitted->specular = Rgb(mirror);
            whitted->shininess = random_.between(1, 200);
        } else if (auto* general = std::get_if<GeneralMaterial>(&any.model)) {
            general->ambient = 0.5 * any.color;
            general->diffuse = any.color;
            any.color = Rgb(1.0);
            general->reflect =
                chance(0.5) ? Rgb(mirror) : mirror * random_.inside(Vec3(0.0), Vec3(1.0));
            general->highlight = Rgb(chance(0.5) ? 0.5 : 0.0);
            general->shininess = random_.between(1, 200);
        }
        return any;
    }

    void add(Surface surface)
    {
        add(make_object(std::move(surface), material()));
    }
    void add(Object object)
    {
        if (std::holds_alternative<Plane>(object.surface) && chance(0.4) &&
            scene.illumination != Illumination::general)
            object.material.checker =
                Checker{random_.inside(Vec3(0.0), Vec3(1.0)), random_.between(0.1, 2)};
        object.casts_shadow = !chance(0.1);
        scene.objects.push_back(std::move(object));
    }

    void add_objects()
    {
        const double spread = chance(0.2) ? magnitude(4) : 1.0;
        const Vec3 middle = chance(0.15) ? vector(1e4) : Vec3(0, 0, 6);
        middle_ = middle;
        for (int i = below(9); i > 0; --i)
            add(sphere(middle + vector(3.0 * spread),
                       spread * (chance(0.2) ? magnitude(3) : random_.between(0.1, 2))));
        for (int i = chance(0.6) ? 1 + below(2) : 0; i > 0; --i) {
            const double radius = std::pow(10.0, random_.between(2, 7));
            const Vec3 up = glm::normalize(vector(0.5) + Vec3(0, 1, 0));
            add(sphere(middle - (radius + random_.between(0.0, 2.0)) * up, radius));
        }
        for (int i = chance(0.4) ? 1 + below(6) : 0; i > 0; --i)
            add(plane(middle + vector(4.0), vector(1.0) + Vec3(0.01)));
        // Contacts: spheres that touch the first one to the last digit, and spheres in the same
        // place.
        if (!scene.objects.empty() && chance(0.4)) {
            const auto* first = std::get_if<Sphere>(&scene.objects.front().surface);
            if (first != nullptr)
                add(sphere(first->center + Vec3(0, 2 * first->radius, 0), first->radius));
        }
        if (scene.objects.empty() || chance(0.1))
            add(sphere(middle, 1.0));
        if (chance(0.4))
            add_others(spread);
    }

    /// Whole, clipped, or clipped and capped; sometimes unbounded.
    Quadric any_quadric()
    {
        const QuadricKind kinds[] = {QuadricKind::ellipsoid,   QuadricKind::cylinder,
                                     QuadricKind::cone,        QuadricKind::paraboloid,
                                     QuadricKind::hyperboloid, QuadricKind::hyperboloid2,
                                     QuadricKind::saddle};
        const Quadric whole = quadric(kinds[below(7)]);
        const double low = random_.between(-2, 0.5);
        const double high = low + random_.between(0.1, 3);
        if (whole.kind == QuadricKind::ellipsoid && chance(0.7))
            return whole;
        if (chance(0.05) && whole.kind != QuadricKind::ellipsoid)
            return whole;
        return chance(0.5) && whole.kind != QuadricKind::saddle ? clip_and_cap(whole, low, high)
                                                                : clip(whole, low, high);
    }

    /// A star of five or seven corners, or a few corners around a point.
    Polygon any_polygon()
    {
        std::vector<Vec3> corners;
        const int count = 3 + below(6);
        const int step = count >= 5 && count % 2 == 1 && chance(0.5) ? 2 : 1;
        for (int i = 0; i < count; ++i) {
            const double turn = 6.283185307179586 * step * i / count;
            const double radius = chance(0.5) ? 1.0 : random_.between(0.3, 2);
            corners.push_back({radius * std::cos(turn), radius * std::sin(turn), 0});
        }
        return polygon(corners);
    }

    void add_others(double spread)
    {
        for (int i = 1 + below(5); i > 0; --i) {
            Object object = chance(0.3) ? make_object(any_polygon(), material())
                                        : make_object(any_quadric(), material());
            const double size = spread * (chance(0.2) ? magnitude(2) : random_.between(0.3, 2));
            object = scale(std::move(object), random_.inside(Vec3(0.3 * size), Vec3(size)));
            object = rotate(std::move(object), vector(1.0) + Vec3(0.01), random_.between(0, 360));
            add(translate(std::move(object), middle_ + vector(3.0 * spread)));
        }
    }

    void add_lights()
    {
        if (chance(0.8))
            scene.lights.push_back(ambient_light(Rgb(0.2)));
        for (int i = below(4); i > 0; --i) {
            const Rgb intensity = random_.inside(Vec3(0.0), Vec3(0.6));
            const double far = chance(0.2) ? magnitude(5) : 4.0;
            Light light = chance(0.5) ? point_light(middle_ + vector(far), intensity)
                                      : directional_light(vector(far) + Vec3(1e-3), intensity);
            light.casts_shadow = !chance(0.1);
            scene.lights.push_back(light);
        }
    }

    void add_camera()
    {
        Camera& camera = scene.camera;
        camera.fov = random_.between(1, 120);
        camera.position = middle_ + (chance(0.2) ? vector(1.0) : vector(9.0));
        if (chance(0.15))
            camera.position += vector(1.0) * magnitude(4);
        camera.rotation = look_at(camera.position, middle_ + vector(2.0), Vec3(0.1, 1, 0.02));
        camera.pixel_sample = {random_.between(0, 1), random_.between(0, 1)};
    }

    SceneRandom random_;
    Vec3 middle_{0.0};
};

}  // namespace packtrace::test
