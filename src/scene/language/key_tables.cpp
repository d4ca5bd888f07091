#include "core/text.hpp"
#include "scene/language/keys.hpp"

#include <map>
#include <utility>
#include <vector>

namespace packtrace::language {
namespace {

std::string code(std::string_view text)
{
    return text.empty() ? std::string() : '`' + replaced(text, ',', ", ") + '`';
}

std::string line(const std::vector<std::string>& cells)
{
    std::string result = "|";
    for (const std::string& cell : cells)
        result += (cell.empty() ? " " : ' ' + cell + ' ') + '|';
    return result + '\n';
}

std::string head(const std::vector<std::string>& titles)
{
    std::string rule = "|";
    for (std::size_t i = 0; i < titles.size(); ++i)
        rule += "---|";
    return line(titles) + rule + '\n';
}

/// The default of a key for each of these owners: "`4` for `sketch`, else `3`".
template <class Owner>
std::string default_of(const Row<Owner>& row, const std::map<std::string_view, Owner>& owners)
{
    if (!row.example.empty())
        return "needed";
    std::map<std::string, Keys> names;
    for (const auto& [name, owner] : owners)
        names[row.text(owner)].push_back(name);
    // If each owner has a different default, as for the key that distinguishes them.
    if (owners.size() > 1 && names.size() == owners.size())
        return code(row.text(Owner{}));
    auto usual = names.begin();
    for (auto it = names.begin(); it != names.end(); ++it)
        if (it->second.size() > usual->second.size())
            usual = it;
    std::string result;
    for (const auto& [text, having] : names)
        if (text != usual->first)
            for (const std::string_view name : having)
                result += code(text) + " for " + code(name) + ", ";
    return (result.empty() ? "" : result + "else ") + code(usual->first);
}

template <class Owner>
std::vector<std::string> cells(const Row<Owner>& row,
                               const std::map<std::string_view, Owner>& owners)
{
    return {code(row.key), row.takes, default_of(row, owners), std::string(row.meaning)};
}

const std::vector<std::string> titles{"key", "value", "default", "meaning"};

template <class Owner>
std::string table(const std::map<std::string_view, Owner>& owners = {{"", Owner{}}})
{
    std::string result = head(titles);
    for (const Row<Owner>& row : rows<Owner>)
        result += line(cells(row, owners));
    return result;
}

std::string scene_table()
{
    std::map<std::string_view, Scene> scenes;
    for (const auto& [illumination, word] : spellings(Illumination{}))
        scenes.emplace(word, default_scene(illumination));
    return table(scenes);
}

std::string object_table()
{
    std::string result = head({"object", "its own keys", "surface"});
    for (const SurfaceWord& kind : surface_words()) {
        const auto keys = std::visit([](const auto& blank) { return keys_of(blank); }, kind.blank);
        result += line({code(kind.word), joined(keys, ", ", code), std::string(kind.equation)});
    }
    return result;
}

std::string surface_table()
{
    std::string result = head(titles);
    const auto add = [&](const auto& blank) {
        using Kind = std::decay_t<decltype(blank)>;
        for (const Row<Kind>& row : rows<Kind>)
            result += line(cells<Kind>(row, {{"", blank}}));
    };
    add(Sphere{});
    add(Plane{});
    add(Quadric{});
    add(Polygon{});
    return result;
}

std::string material_table()
{
    std::string result = head({"illumination", "key", "value", "default", "meaning"});
    for (const auto& [illumination, word] : spellings(Illumination{})) {
        std::string model = code(word);
        const Material material = default_material(illumination);
        visit_parts(material, [&]<class Part>(const Part& part) {
            for (const Row<Part>& row : rows<Part>) {
                std::vector<std::string> all = cells<Part>(row, {{"", part}});
                all.insert(all.begin(), std::exchange(model, ""));
                result += line(all);
            }
        });
    }
    return result;
}

struct Table {
    std::string_view name;
    std::string (*text)();
};

constexpr Table tables[] = {
    {"scene", scene_table},
    {"camera", [] { return table<CameraKeys>(); }},
    {"objects", object_table},
    {"surfaces", surface_table},
    {"object", [] { return table<ObjectKeys>(); }},
    {"transforms",
     [] {
         return table<Mat4>({{"", Mat4(1.0)}});
     }},
    {"materials", material_table},
    {"lights", [] { return table<Light>(); }},
    {"animation", [] { return table<Animation>(); }},
    {"orbit", [] { return table<Orbit>(); }},
    {"key", [] { return table<CameraKey>(); }},
};

}  // namespace

std::span<const std::string_view> key_table_names()
{
    static const Keys names = [] {
        Keys all;
        for (const Table& table : tables)
            all.push_back(table.name);
        return all;
    }();
    return names;
}

std::string key_table(std::string_view name)
{
    for (const Table& table : tables)
        if (table.name == name)
            return table.text();
    return "";
}

}  // namespace packtrace::language
