#include "cli/options/shard.hpp"
#include "cli/study/study.hpp"
#include "core/checksum.hpp"
#include "core/json_text.hpp"
#include "core/read_file.hpp"
#include "lab/stress/stress.hpp"
#include "render/option_words.hpp"
#include "scene/language/quote.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace packtrace::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Part {
    std::string name;
    Shard shard;
    Json json;
};

[[noreturn]] void fail(const std::string& name, const std::string& why)
{
    throw FileError(language::escape(name) + ": " + why);
}

/// Parses the JSON of a part; null for other text. Deeper nesting than stress writes is discarded,
/// because the JSON is written again by a recursive function.
Json parse_part(const std::string& text)
{
    constexpr int deepest = 8;
    bool is_too_deep = false;
    Json json = Json::parse(
        text,
        [&](int depth, Json::parse_event_t, const Json&) {
            is_too_deep = is_too_deep || depth > deepest;
            return depth <= deepest;
        },
        false);
    return is_too_deep ? Json() : json;
}

/// Whether the JSON has all keys that joining reads.
bool is_whole(const Json& json)
{
    const auto has = [&](const char* key, bool (Json::*is_kind)() const noexcept) {
        return json.contains(key) && (json.at(key).*is_kind)();
    };
    return json.is_object() && has("shard", &Json::is_string) && has("rows", &Json::is_array) &&
           has("recipe", &Json::is_object) && has("seed", &Json::is_number) &&
           has("rays_per_family", &Json::is_number);
}

Part read_part(const std::string& name)
{
    Part part{name, {}, parse_part(read_file(name))};
    const std::optional<Shard> shard =
        is_whole(part.json) ? parse_shard(part.json.at("shard").get<std::string>()) : std::nullopt;
    if (!shard)
        fail(name, "is no part that packtrace stress --json --shard wrote");
    part.shard = *shard;
    const Json sum = part.json.value("checksum", Json());
    part.json.erase("checksum");
    if (sum != checksum(bytes_of(json_text(part.json))))
        fail(name, "is cut or was changed; make this part again");
    return part;
}

/// The families that all parts together must have.
std::vector<std::string> families_of(const Json& recipe)
{
    std::vector<std::string> names = recipe.value("families", std::vector<std::string>());
    if (names.empty())
        for (const auto& family : lab::list_stress_families())
            names.push_back(family.name);
    return names;
}

/// Reads the parts and sorts them by index.
std::vector<Part> read_parts(const std::vector<std::string>& names)
{
    std::vector<Part> parts;
    for (const std::string& name : names)
        parts.push_back(read_part(name));
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Part& a, const Part& b) { return a.shard.index < b.shard.index; });
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Part& part = parts[i];
        for (const char* const key : {"seed", "rays_per_family", "recipe"})
            if (part.json.at(key) != parts.front().json.at(key) ||
                part.shard.count != parts.front().shard.count)
                fail(part.name,
                     "is a part of other work than the others; join parts of the same options");
        if (i > 0 && part.shard.index == parts[i - 1].shard.index)
            fail(part.name,
                 "is part " + part.shard.text() + ", as is another; give each part once");
    }
    for (int i = 0; i < parts.front().shard.count; ++i)
        if (static_cast<std::size_t>(i) >= parts.size() ||
            parts[static_cast<std::size_t>(i)].shard.index != i)
            throw FileError("part " + Shard{i, parts.front().shard.count}.text() +
                            " is missing; give all parts");
    return parts;
}

[[noreturn]] void fail_at_row(const std::string& name, const std::string& why)
{
    fail(name, "has a row that stress did not write: " + why);
}

/// The members of a row that the verdict needs. Messages begin with `name`.
lab::StressRow row_of(const std::string& name, const Json& json)
{
    lab::StressRow row;
    json.at("family").get_to(row.family);
    const auto word = json.at("precision").get<std::string>();
    const std::optional<Precision> precision = language::find_word<Precision>(word);
    if (!precision)
        fail_at_row(name, language::quote(word) + " is no precision");
    row.precision = *precision;
    json.at("mode").get_to(row.mode);
    json.at("held").get_to(row.held);
    json.at("rays").get_to(row.rays);
    json.at("hits").get_to(row.hits);
    json.at("wrong").get_to(row.wrong);
    json.at("self_hits").get_to(row.self_hits);
    json.at("second_lost").get_to(row.second_lost);
    json.at("bounds").get_to(row.bounds);
    json.at("bounds_missed").get_to(row.bounds_missed);
    json.at("t_at_doubles_limit").get_to(row.t_at_limit);
    json.at("normal_beyond_1e-6").get_to(row.normal_beyond);
    json.at("faults").get_to(row.faults);
    return row;
}

std::size_t place_of(const std::string& family)
{
    static const std::vector<lab::StressFamilyInfo> families = lab::list_stress_families();
    const auto at = std::find_if(families.begin(), families.end(),
                                 [&](const auto& known) { return known.name == family; });
    return static_cast<std::size_t>(at - families.begin());
}

}  // namespace

std::string join_stress(const std::vector<std::string>& names)
{
    const std::vector<Part> parts = read_parts(names);
    std::vector<Json> rows;
    for (const Part& part : parts)
        rows.insert(rows.end(), part.json.at("rows").begin(), part.json.at("rows").end());
    std::vector<lab::StressRow> judged;
    try {
        // Each family is completely in one part, with its rows in order.
        std::stable_sort(rows.begin(), rows.end(), [](const Json& a, const Json& b) {
            return place_of(a.at("family").get<std::string>()) <
                   place_of(b.at("family").get<std::string>());
        });
        for (const Json& row : rows)
            judged.push_back(row_of(parts.front().name, row));
    } catch (const Json::exception& error) {
        fail_at_row(parts.front().name, error.what());
    }
    for (const std::string& family : families_of(parts.front().json.at("recipe")))
        if (std::none_of(judged.begin(), judged.end(),
                         [&](const lab::StressRow& row) { return row.family == family; }))
            throw FileError("family " + family + " is in none of the parts; make them again");
    Json joined;
    joined["seed"] = parts.front().json.at("seed");
    joined["rays_per_family"] = parts.front().json.at("rays_per_family");
    joined["verdict"] = lab::stress_verdict(judged);
    joined["rows"] = rows;
    return json_text(joined);
}

}  // namespace packtrace::cli
