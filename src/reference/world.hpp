#pragma once

#include "core/cut_rays.hpp"
#include "reference/surfaces/bodies.hpp"
#include "reference/surfaces/hits.hpp"
#include "reference/vec3.hpp"
#include <packtrace/image.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

// The scene in the notes' terms: canvas, paints, lights, surfaces and materials.
namespace packtrace::reference {

template <class Real>
inline constexpr Real infinity = std::numeric_limits<Real>::infinity();

/// Note 001's canvas and viewport, with the rotation already applied.
template <class Real>
struct Canvas {
    Vec3<Real> position;  ///< of the camera
    Vec3<Real> right;     ///< rotation * (Vw/Cw, 0, 0)
    Vec3<Real> up;        ///< rotation * (0, Vh/Ch, 0)
    Vec3<Real> forward;   ///< rotation * (0, 0, d)
    /// Canvas coordinates of the sample in column 0 and row 0.
    Real first_x{};
    Real first_y{};
    Real half_width{};  ///< of the canvas, pixels
    Real half_height{};

    explicit Canvas(const Scene& scene)
    {
        const CameraBasis basis = camera_basis(scene.camera, scene.width, scene.height);
        position = Vec3<Real>(basis.origin);
        right = Vec3<Real>(basis.right);
        up = Vec3<Real>(basis.up);
        forward = Vec3<Real>(basis.forward);
        const Vec2 sample = scene.camera.pixel_sample;
        half_width = static_cast<Real>(scene.width) / 2;
        half_height = static_cast<Real>(scene.height) / 2;
        first_x = static_cast<Real>(sample.x) - half_width;
        first_y = half_height - static_cast<Real>(sample.y);
    }

    /// camera.rotation * (x*Vw/Cw, y*Vh/Ch, d) for the pixel in column `i` and row `j`.
    [[nodiscard]] Vec3<Real> canvas_to_viewport(int i, int j) const
    {
        const Real x = first_x + static_cast<Real>(i);
        const Real y = first_y - static_cast<Real>(j);
        return x * right + y * up + forward;
    }

    /// The same through the place `sample` of the pixel, in the units of Camera::pixel_sample.
    [[nodiscard]] Vec3<Real> canvas_to_viewport(int i, int j, const Vec2& sample) const
    {
        const Real x = static_cast<Real>(sample.x) - half_width + static_cast<Real>(i);
        const Real y = half_height - static_cast<Real>(sample.y) - static_cast<Real>(j);
        return x * right + y * up + forward;
    }
};

template <class Real>
void put_pixel(Image<Real>& image, int i, int j, const Color<Real>& color)
{
    Real* pixel = image.pixel(i, j);
    pixel[0] = color.x;
    pixel[1] = color.y;
    pixel[2] = color.z;
}

/// An object's colour, or two colours in a checker along a plane's axes.
template <class Real>
struct Paint {
    Color<Real> color;
    bool checkered = false;
    Color<Real> other;
    Real size = 1;
    Vec3<Real> point;
    Vec3<Real> u;
    Vec3<Real> v;
};

template <class Real>
[[nodiscard]] Paint<Real> make_paint(const Object& object)
{
    Paint<Real> paint;
    paint.color = Color<Real>(object.material.color);
    const auto* plane = std::get_if<Plane>(&object.surface);
    if (!object.material.checker || !plane)
        return paint;
    paint.checkered = true;
    paint.other = Color<Real>(object.material.checker->other);
    paint.size = static_cast<Real>(object.material.checker->size);
    paint.point = Vec3<Real>(plane->point);
    paint.u = Vec3<Real>(plane->u);
    paint.v = Vec3<Real>(plane->v);
    return paint;
}

/// The colour of the checker's square that holds `own`, a point in the plane's own space.
template <class Real>
[[nodiscard]] Color<Real> checker_color(const Paint<Real>& paint, const Vec3<Real>& own)
{
    const Vec3<Real> from_corner = own - paint.point;
    const Real squares = std::floor(dot(from_corner, paint.u) / paint.size) +
                         std::floor(dot(from_corner, paint.v) / paint.size);
    const bool even = std::floor(squares / 2) * 2 == squares;
    return even ? paint.color : paint.other;
}

/// The colour of object number `object` at the world point `P`.
template <class Real>
[[nodiscard]] Color<Real> color_at(const Paint<Real>& paint, const Bodies<Real>& bodies, int object,
                                   const Vec3<Real>& P)
{
    return paint.checkered ? checker_color(paint, own_point(bodies, object, P)) : paint.color;
}

template <class Real>
struct LightSource {
    LightType type = LightType::ambient;
    Color<Real> intensity;
    Vec3<Real> vector;  ///< a point light's position, or the direction towards a directional light
    Vec3<Real> unit;    ///< the direction towards a directional light, normalised
    int number = 0;     ///< index in Scene::lights
    bool casts_shadow = true;
};

/// What all notes need of a scene, converted once to the precision of the reference.
template <class Real>
struct World {
    Bodies<Real> bodies;
    Bodies<Real> occluders;           ///< those that cast shadows
    std::vector<Paint<Real>> paints;  ///< by object number
    std::vector<LightSource<Real>> lights;
    Color<Real> ambient;  ///< sum of the ambient lights
    Color<Real> background;
    ShadowKind shadows;
    int max_depth;
    Real min_weight;  ///< least_traced_weight()
    Canvas<Real> canvas;
    SelfHits self_hits;

    explicit World(const Scene& scene, SelfHits self_hits = default_self_hits);
};

template <class Real>
World<Real>::World(const Scene& scene, SelfHits rule)
    : bodies(scene, rule),
      occluders(scene, rule, [](const Object& object) { return object.casts_shadow; }),
      background(scene.background),
      shadows(scene.shadows),
      max_depth(scene.max_depth),
      min_weight(static_cast<Real>(least_traced_weight(scene.min_weight))),
      canvas(scene),
      self_hits(rule)
{
    for (const Object& object : scene.objects)
        paints.push_back(make_paint<Real>(object));
    for (const Light& light : scene.lights) {
        const Vec3<Real> vector(light.vector);
        const bool directional = light.type == LightType::directional;
        lights.push_back({light.type, Color<Real>(light.intensity), vector,
                          directional ? normalize(vector) : Vec3<Real>(),
                          static_cast<int>(lights.size()), light.casts_shadow});
        if (light.type == LightType::ambient)
            ambient += Color<Real>(light.intensity);
    }
}

/// An object's material in the scene's illumination model.
template <class Model>
[[nodiscard]] const Model& model_of(const Object& object)
{
    if (const auto* model = std::get_if<Model>(&object.material.model))
        return *model;
    throw std::invalid_argument("object '" + object.name +
                                "' has a material of another illumination model");
}

}  // namespace packtrace::reference
