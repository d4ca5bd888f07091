#include "scene/scene_writer.hpp"

#include <array>
#include <map>
#include <string>
#include <variant>

namespace packtrace::writer {
namespace {

// In the order of QuadricKind.
constexpr std::string_view quadrics[] = {"ellipsoid",   "cylinder",     "cone",   "paraboloid",
                                         "hyperboloid", "hyperboloid2", "saddle", "quadric"};

std::string_view keyword_of(const Surface& surface)
{
    if (std::holds_alternative<Sphere>(surface))
        return "sphere";
    if (const auto* quadric = std::get_if<Quadric>(&surface))
        return quadrics[static_cast<std::size_t>(quadric->kind)];
    return "plane";
}

/// Writes the keys of a surface's own.
struct SurfaceKeys {
    TextWriter& out;

    void operator()(const Sphere& sphere) const
    {
        out.put("center=").put(sphere.center).put("radius=").put(sphere.radius);
    }
    void operator()(const Plane& plane) const
    {
        out.put("point=").put(plane.point).put("normal=").put(plane.normal);
    }
    void operator()(const Quadric& quadric) const
    {
        if (quadric.kind == QuadricKind::general)
            out.put("coefficients=").put(std::span<const double>(quadric.coefficients));
        if (quadric.z_range) {
            const std::array<double, 2> ends{quadric.z_range->low, quadric.z_range->high};
            out.put(" z_range=").put(std::span<const double>(ends));
        }
        if (quadric.capped)
            out.put(" capped=true");
    }
};

void put_transform(TextWriter& out, const Mat4& transform)
{
    if (transform == Mat4(1.0))
        return;
    std::array<double, 12> rows{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            rows[static_cast<std::size_t>(4 * row + column)] = transform[column][row];
    out.put(" matrix=").put(std::span<const double>(rows));
}

void put_material(TextWriter& out, const Material& material, Illumination illumination,
                  const MaterialTexts& materials)
{
    const std::string text = material_text(material, illumination);
    const auto named = materials.find(material.name);
    if (named != materials.end() && named->second == text)
        out.put(" material=").put_name(material.name);
    else
        out.put(text);
}

/// Writes the names that the reader would not give on its own.
class Namer {
public:
    void put_name(TextWriter& out, std::string_view keyword, const std::string& name)
    {
        int& unnamed = unnamed_[std::string(keyword)];
        if (name.empty() || name == std::string(keyword) + ' ' + std::to_string(unnamed + 1))
            ++unnamed;
        else
            out.put(" name=").put_name(name);
    }

private:
    std::map<std::string, int> unnamed_;
};

}  // namespace

void write_objects(TextWriter& out, const Scene& scene, const MaterialTexts& materials)
{
    Namer namer;
    for (const Object& object : scene.objects) {
        const std::string_view keyword = keyword_of(object.surface);
        out.put(keyword).put("{");
        std::visit(SurfaceKeys{out}, object.surface);
        put_transform(out, object.transform);
        put_material(out, object.material, scene.illumination, materials);
        if (!object.casts_shadow)
            out.put(" casts_shadow=no");
        namer.put_name(out, keyword, object.name);
        out.put("}\n");
    }
}

}  // namespace packtrace::writer
