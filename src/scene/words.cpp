#include "scene/words.hpp"

#include <algorithm>
#include <vector>

#include "scene/quadric_kinds.hpp"

namespace packtrace::language {
namespace {

bool is_of_kind(const Surface& surface, const Surface& blank)
{
    const auto* const quadric = std::get_if<Quadric>(&surface);
    return surface.index() == blank.index() &&
           (quadric == nullptr || quadric->kind == std::get<Quadric>(blank).kind);
}

}  // namespace

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
