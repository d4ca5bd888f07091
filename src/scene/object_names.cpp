#include "scene/object_names.hpp"

#include "scene/language/quote.hpp"
#include "scene/language/words.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace packtrace::language {
namespace {

std::string numbered(std::string_view kind, std::size_t number)
{
    return std::string(kind) + ' ' + std::to_string(number);
}

/// The number in a name like "sphere 12"; 0 for other names.
std::size_t number_after(std::string_view kind, std::string_view name)
{
    if (!name.starts_with(kind) || name.size() < kind.size() + 2 || name[kind.size()] != ' ' ||
        name[kind.size() + 1] == '0')
        return 0;
    std::size_t number = 0;
    const auto [end, error] =
        std::from_chars(name.data() + kind.size() + 1, name.data() + name.size(), number);
    return error == std::errc{} && end == name.data() + name.size() ? number : 0;
}

std::size_t kind_of(const Surface& surface)
{
    return static_cast<std::size_t>(&word_of(surface) - surface_words().data());
}

/// Whether two names may be equal. False is certain.
bool may_repeat(const Scene& scene)
{
    std::vector<std::size_t> hashes;
    std::vector<std::string_view> like_defaults;
    DefaultNames defaults;
    for (const Object& object : scene.objects) {
        if (defaults.takes(object))
            continue;
        hashes.push_back(std::hash<std::string_view>{}(object.name));
        if (object.name.back() >= '0' && object.name.back() <= '9')
            like_defaults.push_back(object.name);
    }
    std::sort(hashes.begin(), hashes.end());
    return std::adjacent_find(hashes.begin(), hashes.end()) != hashes.end() ||
           std::any_of(like_defaults.begin(), like_defaults.end(),
                       [&](std::string_view name) { return defaults.contains(name); });
}

}  // namespace

bool DefaultNames::takes(const Object& object)
{
    const std::size_t kind = kind_of(object.surface);
    if (!object.name.empty() &&
        number_after(surface_words()[kind].word, object.name) != counts_[kind] + 1)
        return false;
    ++counts_[kind];
    return true;
}

bool DefaultNames::contains(std::string_view name) const
{
    const auto words = surface_words();
    for (std::size_t kind = 0; kind < words.size(); ++kind)
        if (const std::size_t number = number_after(words[kind].word, name);
            number > 0 && number <= counts_[kind])
            return true;
    return false;
}

std::string label_of(std::string_view kind, const std::optional<std::string>& own,
                     std::size_t number)
{
    return own ? std::string(kind) + ' ' + quote(*own) : numbered(kind, number);
}

std::string label_of(const Scene& scene, std::size_t object)
{
    // A surface without a value has no kind, so all objects count.
    if (const Object& bare = scene.objects[object]; bare.surface.valueless_by_exception())
        return label_of("object", bare.name.empty() ? std::nullopt : std::optional(bare.name),
                        object + 1);
    const std::string_view kind = word_of(scene.objects[object].surface).word;
    DefaultNames defaults;
    std::size_t number = 0;
    bool by_default = false;
    for (std::size_t i = 0; i <= object; ++i) {
        by_default = defaults.takes(scene.objects[i]);
        if (by_default && word_of(scene.objects[i].surface).word == kind)
            ++number;
    }
    return label_of(kind, by_default ? std::nullopt : std::optional(scene.objects[object].name),
                    number);
}

std::optional<DuplicateName> find_duplicate_name(const Scene& scene)
{
    if (!may_repeat(scene))
        return std::nullopt;
    std::unordered_map<std::string, std::size_t> seen;
    std::unordered_map<std::string_view, std::size_t> numbers;
    DefaultNames defaults;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        const std::string_view kind = word_of(object.surface).word;
        const std::string name =
            defaults.takes(object) ? numbered(kind, ++numbers[kind]) : object.name;
        const auto [earlier, added] = seen.emplace(name, i);
        if (!added)
            return DuplicateName{i, earlier->second};
    }
    return std::nullopt;
}

}  // namespace packtrace::language
