#include "scene/quadric_kinds.hpp"

namespace packtrace {

std::span<const QuadricKindInfo> quadric_kinds()
{
    static constexpr QuadricKindInfo kinds[] = {
        {QuadricKind::ellipsoid, "ellipsoid", {1, 1, 1, 0, 0, 0, 0, 0, 0, -1}, "x² + y² + z² = 1"},
        {QuadricKind::cylinder, "cylinder", {1, 1, 0, 0, 0, 0, 0, 0, 0, -1}, "x² + y² = 1"},
        {QuadricKind::cone, "cone", {1, 1, -1, 0, 0, 0, 0, 0, 0, 0}, "x² + y² = z²"},
        {QuadricKind::paraboloid, "paraboloid", {1, 1, 0, 0, 0, 0, 0, 0, -1, 0}, "x² + y² = z"},
        {QuadricKind::hyperboloid,
         "hyperboloid",
         {1, 1, -1, 0, 0, 0, 0, 0, 0, -1},
         "x² + y² - z² = 1, of one sheet"},
        {QuadricKind::hyperboloid2,
         "hyperboloid2",
         {1, 1, -1, 0, 0, 0, 0, 0, 0, 1},
         "x² + y² - z² = -1, of two sheets"},
        {QuadricKind::saddle, "saddle", {1, -1, 0, 0, 0, 0, 0, 0, -1, 0}, "x² - y² = z"},
    };
    return kinds;
}

const QuadricKindInfo* find_quadric_kind(QuadricKind kind)
{
    for (const QuadricKindInfo& info : quadric_kinds())
        if (info.kind == kind)
            return &info;
    return nullptr;
}

}  // namespace packtrace
