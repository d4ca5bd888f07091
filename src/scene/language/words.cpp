#include "scene/language/words.hpp"

#include <algorithm>
#include <vector>

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

namespace packtrace::language {
namespace {

bool is_of_kind(const Surface& surface, const Surface& blank)
{
    const auto* const quadric = std::get_if<Quadric>(&surface);
    return surface.index() == blank.index() &&
           (quadric == nullptr || quadric->kind == std::get<Quadric>(blank).kind);
}

}  // namespace

std::vector<Spelling<QuadricKind>> spellings(QuadricKind)
{
    std::vector<Spelling<QuadricKind>> words;
    for (const QuadricKindInfo& info : quadric_kinds())
        words.push_back({info.kind, info.name});
    words.push_back({QuadricKind::general, "general"});
    return words;
}

std::span<const SurfaceWord> surface_words()
{
    static const std::vector<SurfaceWord> words = [] {
        std::vector<SurfaceWord> all{{"sphere", Sphere{}, ""}, {"plane", Plane{}, ""}};
        for (const QuadricKindInfo& info : quadric_kinds())
            all.push_back(
                {info.name, Quadric{info.kind, info.coefficients, {}, false}, info.equation});
        all.push_back(
            {"quadric", Quadric{}, "Ax² + By² + Cz² + Dxy + Exz + Fyz + Gx + Hy + Iz + J = 0"});
        all.push_back({"polygon", Polygon{}, "flat, of any outline, holes by the even-odd rule"});
        return all;
    }();
    return words;
}

const SurfaceWord& word_of(const Surface& surface)
{
    const auto words = surface_words();
    const auto found = std::find_if(words.begin(), words.end(), [&](const SurfaceWord& word) {
        return is_of_kind(surface, word.blank);
    });
    return found == words.end() ? word_of(Surface(Quadric{})) : *found;
}

}  // namespace packtrace::language
