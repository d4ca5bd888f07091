#include "scene/numbers.hpp"
#include "scene/quadric_kinds.hpp"
#include "scene/scene_builder.hpp"
#include "scene/values.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace packtrace::reader {
namespace {

constexpr std::string_view sphere_form = "(1, 1, 1, 0, 0, 0, 0, 0, 0, -1)";

std::array<double, 10> read_coefficients(const Field& field)
{
    const std::vector<double> numbers = read_numbers(field, 10, sphere_form);
    std::array<double, 10> coefficients{};
    std::copy(numbers.begin(), numbers.end(), coefficients.begin());
    return coefficients;
}

ZRange read_z_range(const Field& field)
{
    const Vec2 ends = read_pair(field);
    if (!(ends.x < ends.y))
        fail(field.source, field.entry.value[0].at,
             "'z_range' is (" + to_text(ends.x) + ", " + to_text(ends.y) +
                 "), upside down or empty; write the lower end first, then a higher one");
    return {ends.x, ends.y};
}

void build_clipping(const Block& block, Quadric& quadric)
{
    block.set("z_range", quadric.z_range, read_z_range);
    block.set("capped", quadric.capped, read_flag);
    if (quadric.capped && !quadric.z_range)
        block.find("capped")->fail(
            "'capped' closes the ends of a z_range, and there is none; add for example "
            "z_range = (-1, 1) or remove it");
}

}  // namespace

Quadric build_quadric(const Block& block, std::string_view keyword)
{
    Quadric quadric;
    const auto named =
        std::find_if(quadric_kinds().begin(), quadric_kinds().end(),
                     [&](const QuadricKindInfo& candidate) { return candidate.name == keyword; });
    if (named != quadric_kinds().end()) {
        quadric.kind = named->kind;
        quadric.coefficients = named->coefficients;
    } else {
        quadric.coefficients = read_coefficients(block.require("coefficients", sphere_form));
    }
    build_clipping(block, quadric);
    return quadric;
}

}  // namespace packtrace::reader
