#include "scene/language/keys.hpp"
#include "scene/language/words.hpp"
#include "scene/vectors.hpp"
#include <packtrace/build.hpp>

#include <glm/ext/matrix_transform.hpp>

#include <stdexcept>
#include <utility>

namespace packtrace {

Scene make_scene(Illumination illumination)
{
    return language::default_scene(illumination);
}

Material make_material(Illumination illumination, const std::string& name)
{
    Material material = language::default_material(illumination);
    material.name = name;
    return material;
}

Sphere sphere(const Vec3& center, double radius)
{
    return {center, radius};
}

Plane plane(const Vec3& point, const Vec3& normal)
{
    Plane result{.point = point, .normal = language::unit_vector(normal)};
    plane_axes(result);
    return result;
}

Quadric ellipsoid()
{
    return quadric(QuadricKind::ellipsoid);
}

Quadric cylinder()
{
    return quadric(QuadricKind::cylinder);
}

Quadric cone()
{
    return quadric(QuadricKind::cone);
}

Quadric paraboloid()
{
    return quadric(QuadricKind::paraboloid);
}

Quadric hyperboloid()
{
    return quadric(QuadricKind::hyperboloid);
}

Quadric hyperboloid2()
{
    return quadric(QuadricKind::hyperboloid2);
}

Quadric saddle()
{
    return quadric(QuadricKind::saddle);
}

Quadric quadric(const std::array<double, 10>& coefficients)
{
    return {.coefficients = coefficients};
}

Quadric quadric(QuadricKind kind)
{
    Quadric result{.kind = kind};
    if (const QuadricKindInfo* const info = find_quadric_kind(kind))
        result.coefficients = info->coefficients;
    return result;
}

Quadric clip(Quadric quadric, double low, double high)
{
    quadric.z_range = ZRange{low, high};
    quadric.capped = false;
    return quadric;
}

Quadric clip_and_cap(Quadric quadric, double low, double high)
{
    quadric.z_range = ZRange{low, high};
    quadric.capped = true;
    return quadric;
}

Polygon polygon(std::vector<Vec3> corners)
{
    Polygon result;
    result.contours.push_back(std::move(corners));
    return result;
}

Object make_object(Surface surface, Material material, std::string name)
{
    return {
        .name = std::move(name), .surface = std::move(surface), .material = std::move(material)};
}

Object translate(Object object, const Vec3& by)
{
    return transform(std::move(object), glm::translate(Mat4(1.0), by));
}

Object rotate(Object object, const Vec3& axis, double degrees)
{
    if (axis == Vec3(0.0))
        throw std::invalid_argument(
            "rotate: the axis is (0, 0, 0), which points nowhere; give it any other length");
    return transform(std::move(object),
                     language::axis_rotation(language::unit_vector(axis), degrees));
}

Object scale(Object object, const Vec3& factors)
{
    return transform(std::move(object), glm::scale(Mat4(1.0), factors));
}

Object scale(Object object, double factor)
{
    return scale(std::move(object), Vec3(factor));
}

Object transform(Object object, const Mat4& matrix)
{
    object.transform = matrix * object.transform;
    return object;
}

Light ambient_light(const Rgb& intensity)
{
    return {LightType::ambient, intensity, Vec3(0.0), true};
}

Light point_light(const Vec3& position, const Rgb& intensity)
{
    return {LightType::point, intensity, position, true};
}

Light directional_light(const Vec3& towards, const Rgb& intensity)
{
    return {LightType::directional, intensity, towards, true};
}

}  // namespace packtrace
