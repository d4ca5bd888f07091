#include "lab/soak/soak.hpp"
#include "render/precision.hpp"
#include <packtrace/write_scene.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <regex>
#include <set>

// The promises about pictures: the same bits in every way of a group, finite numbers, and the
// scalar kernel's colours wherever rounding does not decide them.
namespace packtrace::lab {
namespace {

/// The allowed difference of transparent shadows, as a share of the largest value: more than the
/// roundings of products of shares, far less than any share.
constexpr double single_shadow_difference = 1e-5;
constexpr double double_shadow_difference = 1e-13;

/// Values that may be off the reference's in any picture, and one of this many counted ones:
/// rounding decides some although both references agree.
constexpr std::size_t always_off = 9;
constexpr std::size_t values_an_off = 50;

/// Values are compared relative to the largest one, but at least this.
constexpr double least_unit = 1e-30;

/// Red, green and blue of each pixel.
using Values = std::vector<double>;

template <class Real>
Values values_of(const Image<Real>& image)
{
    return {image.rgb.begin(), image.rgb.end()};
}

Values picture(const Scene& scene, const SoakWay& way)
{
    return with_real(way.precision,
                     [&]<class Real>() { return values_of(render<Real>(scene, way.options)); });
}

std::string pixel_text(const Scene& scene, std::size_t value)
{
    const auto pixel = static_cast<int>(value / 3);
    return "pixel " + std::to_string(pixel % scene.width) + "," +
           std::to_string(pixel / scene.width);
}

/// Names the first value that is not finite; empty if all are.
std::string not_a_number(const Scene& scene, const Values& values)
{
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::isfinite(values[i]))
            return pixel_text(scene, i) + " is no finite number";
    return "";
}

double largest_value(const Values& values)
{
    double most = 0.0;
    for (const double value : values)
        most = std::max(most, std::abs(value));
    return most;
}

/// Shares of light through glass are multiplied in the order in which occluders are found, which
/// differs between lists and a BVH.
double allowed_difference(const Scene& scene, const SoakWay& a, const SoakWay& b,
                          const Values& values)
{
    const bool same_order =
        a.options.traversal == Traversal::list && b.options.traversal == Traversal::list;
    if (scene.shadows != ShadowKind::transparent || same_order)
        return 0.0;
    return (a.precision == Precision::single ? single_shadow_difference
                                             : double_shadow_difference) *
           largest_value(values);
}

std::string differing(const Scene& scene, const Values& a, const Values& b, double allowed)
{
    for (std::size_t i = 0; i < a.size(); ++i) {
        const bool same = std::memcmp(&a[i], &b[i], sizeof a[i]) == 0;
        if (!same && !(std::abs(a[i] - b[i]) <= allowed && allowed > 0.0))
            return "pictures differ at " + pixel_text(scene, i) + ": " + std::to_string(a[i]) +
                   " and " + std::to_string(b[i]);
    }
    return "";
}

std::string compare(const Scene& scene, const SoakWay& first, const Values& first_values,
                    const SoakWay& way, const Values& values)
{
    return differing(scene, first_values, values,
                     allowed_difference(scene, first, way, first_values));
}

SoakFinding finding_of_two(std::string what, const SoakWay& first, const SoakWay& second)
{
    const auto again = [first, second](const Scene& scene) {
        return compare(scene, first, picture(scene, first), second, picture(scene, second));
    };
    return {std::move(what), {first, second}, std::nullopt, again};
}

SoakFinding finding_of_one(std::string what, const SoakWay& way)
{
    const auto again = [way](const Scene& scene) {
        return not_a_number(scene, picture(scene, way));
    };
    return {std::move(what), {way}, std::nullopt, again};
}

/// An object's shape and placement as text, in which 0 has no sign.
std::string place_text(const Object& object)
{
    static const std::regex minus_zero("-0(?![.0-9e])");
    Scene alone;
    alone.objects.resize(1);
    alone.objects[0].surface = object.surface;
    alone.objects[0].transform = object.transform;
    return std::regex_replace(scene_text(alone), minus_zero, "0");
}

/// Whether two objects have the same shape and placement. A ray that leaves one of them then starts
/// on the other, too, and rounding decides whether it hits it.
bool has_twins(const Scene& scene)
{
    std::set<std::string> places;
    for (const Object& object : scene.objects)
        if (!places.insert(place_text(object)).second)
            return true;
    return false;
}

/// Compares the pictures of a group; `values` receives that of its first way.
std::optional<SoakFinding> check_group(const Scene& scene, const SoakGroup& group, Values& values)
{
    const SoakWay& first = group.ways.front();
    values = picture(scene, first);
    if (std::string what = not_a_number(scene, values); !what.empty())
        return finding_of_one(std::move(what), first);
    for (const SoakWay& way : group.ways) {
        std::string what = compare(scene, first, values, way, picture(scene, way));
        if (!what.empty())
            return finding_of_two(std::move(what), first, way);
    }
    return std::nullopt;
}

/// The scalar kernel in two precisions. Where both pictures agree, rounding does not decide.
struct References {
    SoakWay truth;
    SoakWay other;
    // Relative to the largest value:
    double agree;   ///< a value counts if the two differ by at most this
    double differ;  ///< and is off if it differs from the truth by more than this
};

References references_of(Precision precision, SelfHits self_hits)
{
    const bool single = precision == Precision::single;
    return {scalar_way(Precision::double_, self_hits),
            scalar_way(single ? precision : Precision::extended, self_hits), single ? 1e-4 : 1e-9,
            single ? 3e-2 : 1e-4};
}

/// What is wrong with a picture's values compared with the references; empty for nothing. Edges and
/// paths through much glass do not count, as the references differ there.
std::string off_reference(const Scene& scene, const Values& values, const Values& truth,
                          const Values& other, const References& references)
{
    const double unit = std::max(largest_value(truth), least_unit);
    std::size_t counted = 0;
    std::size_t off = 0;
    std::size_t where = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!(std::abs(truth[i] - other[i]) <= references.agree * unit))
            continue;
        ++counted;
        if (std::abs(values[i] - truth[i]) <= references.differ * unit)
            continue;
        if (off++ == 0)
            where = i;
    }
    // Where rounding chooses one of two colours, it chooses the same for both references about as
    // often as not. The value then counts, but the picture may have the other colour.
    const std::size_t not_counted = values.size() - counted;
    const std::size_t allowed = always_off + counted / values_an_off + not_counted;
    if (off <= allowed)
        return "";
    return std::to_string(off) + " of " + std::to_string(counted) +
           " values are off the scalar kernel's, first at " + pixel_text(scene, where) + ": " +
           std::to_string(values[where]) + ", which should be " + std::to_string(truth[where]);
}

std::string off_reference_again(const Scene& scene, const SoakWay& way,
                                const References& references)
{
    return off_reference(scene, picture(scene, way), picture(scene, references.truth),
                         picture(scene, references.other), references);
}

std::optional<SoakFinding> check_reference(const Scene& scene, const SoakWay& way,
                                           const Values& values, SelfHits self_hits)
{
    // By note 004 the scalar kernel shades in an object's own space, which kernels do not.
    if (scene.illumination == Illumination::shader)
        return std::nullopt;
    const References references = references_of(way.precision, self_hits);
    const Values truth = picture(scene, references.truth);
    if (std::string what = not_a_number(scene, truth); !what.empty())
        return finding_of_one(std::move(what), references.truth);
    std::string what =
        off_reference(scene, values, truth, picture(scene, references.other), references);
    if (what.empty())
        return std::nullopt;
    const auto again = [way, references](const Scene& other) {
        return off_reference_again(other, way, references);
    };
    return SoakFinding{std::move(what), {way, references.truth}, std::nullopt, again};
}

std::optional<SoakFinding> check_mode(const Scene& scene, Precision precision, Accuracy accuracy,
                                      SelfHits self_hits, bool aligned)
{
    Values first;
    Values values;
    const bool twins = has_twins(scene);
    const std::vector<SoakGroup> groups = packet_groups(precision, accuracy, self_hits);
    for (SoakGroup group : groups) {
        // Special kernels prune the later of two twins, the general kernel does not.
        if (twins)
            std::erase_if(group.ways, [](const SoakWay& way) { return way.options.force_general; });
        if (auto finding = check_group(scene, group, values))
            return finding;
        if (first.empty())
            first = values;
    }
    // By the note's rule rays start 0.001 away, which matters for small objects. In aligned scenes
    // rounding decides, differently in each kernel.
    if (accuracy == Accuracy::fast || groups.empty() || twins || self_hits == SelfHits::note ||
        aligned)
        return std::nullopt;
    return check_reference(scene, groups.front().ways.front(), first, self_hits);
}

}  // namespace

std::optional<SoakFinding> check_pictures(const Scene& scene, SelfHits self_hits, bool aligned)
{
    if (auto finding = check_mode(scene, Precision::double_, Accuracy::exact, self_hits, aligned))
        return finding;
    if (auto finding = check_mode(scene, Precision::single, Accuracy::exact, self_hits, aligned))
        return finding;
    return check_mode(scene, Precision::single, Accuracy::fast, self_hits, aligned);
}

}  // namespace packtrace::lab
