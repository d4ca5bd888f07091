#include "cli/command.hpp"
#include "cli/commands/scene_features.hpp"
#include "cli/options/common_options.hpp"
#include "cli/options/scene_input.hpp"
#include "cli/options/validators.hpp"
#include "cli/output/text_table.hpp"
#include "cli/study/study.hpp"
#include "core/json_text.hpp"
#include "scene/language/numbers.hpp"
#include "scene/language/quote.hpp"
#include "scene/language/rows.hpp"
#include "scene/language/words.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/version.hpp>

#include <nlohmann/json.hpp>

#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace packtrace::cli {
namespace {

using language::word_of;

struct InfoArguments {
    std::string scene;
    IsaArguments isa;
    bool json = false;
    std::string keys;
};

constexpr const char* all_tables = "all";

void print_isas(const IsaInfo& chosen)
{
    TextTable table(1, {"instruction set", "float lanes", "double lanes", "supported", "chosen"});
    for (const IsaInfo& isa : list_isas())
        table.add({isa.name, std::to_string(isa.lanes_single), std::to_string(isa.lanes_double),
                   isa.supported ? "yes" : "no", isa.name == chosen.name ? "yes" : ""});
    table.print(std::cout);
}

/// The number of objects of each kind that occurs, in the order of kinds in the scene language.
using Census = std::vector<std::pair<std::string, int>>;

template <class Kinds, class Things, class WordOf>
Census count(const Kinds& kinds, const Things& things, const WordOf& word_of_thing)
{
    std::map<std::string_view, int> counts;
    for (const auto& thing : things)
        ++counts[word_of_thing(thing)];
    Census census;
    for (const auto& kind : kinds)
        if (const auto found = counts.find(kind.word); found != counts.end())
            census.emplace_back(*found);
    return census;
}

Census count_objects(const Scene& scene)
{
    return count(language::surface_words(), scene.objects,
                 [](const Object& object) { return word_of(object.surface).word; });
}

Census count_lights(const Scene& scene)
{
    return count(language::spellings(LightType{}), scene.lights,
                 [](const Light& light) { return word_of(light.type); });
}

std::string listed(const Census& census)
{
    std::string text;
    int total = 0;
    for (const auto& [kind, count] : census) {
        text += (text.empty() ? " (" : ", ") + std::to_string(count) + " " + kind;
        total += count;
    }
    return std::to_string(total) + text + (text.empty() ? "" : ")");
}

void print_memory(std::size_t bytes, std::size_t objects)
{
    std::cout << "memory   " << (bytes + 1023) / 1024 << " KiB in single precision";
    if (objects > 0)
        std::cout << ", " << bytes / objects << " bytes an object";
    std::cout << '\n';
}

void print_scene(const std::string& file, const Scene& scene, const SceneFeatures& features)
{
    std::cout << "\nscene    " << language::escape(file) << "\nsize     " << scene.width << " x "
              << scene.height << "\nobjects  " << listed(count_objects(scene)) << "\nlights   "
              << listed(count_lights(scene)) << "\nmodel    " << word_of(scene.illumination)
              << "\ndepth    " << scene.max_depth << "\nweights  "
              << (scene.min_weight > 0.0 ? "from " + language::to_text(scene.min_weight) + " on"
                                         : "all")
              << "\nshadows  " << word_of(scene.shadows) << '\n';
    print_memory(features.bytes, scene.objects.size());
}

// Prints the unsure rays of a small picture, by cause.
void print_unsure(const UnsureSample& sample)
{
    std::uint64_t sum = 0;
    std::string causes;
    for (const auto& [cause, count] : sample.causes) {
        sum += count;
        if (count > 0)
            causes += (causes.empty() ? ": " : ", ") + cause + ' ' + std::to_string(count);
    }
    std::cout << "unsure   " << sum << " of the " << sample.rays << " rays of a " << sample.width
              << " x " << sample.height << " picture" << causes << '\n';
}

std::string traced(const SceneFeatures& features)
{
    if (features.in_registers)
        return "in registers, from the eye to the last mirror";
    return features.sorts_mirrored ? "in streams, generation by generation, mirrored rays sorted"
                                   : "in streams, generation by generation";
}

void print_features(const SceneFeatures& features, const IsaInfo& isa,
                    const std::optional<UnsureSample>& unsure)
{
    std::cout << "kernel   " << features.kernel << ", " << isa.name << ", " << isa.lanes_single
              << " lanes\npaths    " << traced(features) << "\nuses     "
              << (features.uses.empty() ? "nothing" : joined(features.uses)) << '\n';
    if (unsure)
        print_unsure(*unsure);
    std::cout << '\n';
    TextTable table(2, {"left out", "as"});
    for (const LeftOut& left : features.left_out)
        table.add({left.what, left.why});
    table.print(std::cout);
}

nlohmann::ordered_json unsure_json(const UnsureSample& sample)
{
    nlohmann::ordered_json json{
        {"width", sample.width}, {"height", sample.height}, {"rays", sample.rays}};
    for (const auto& [cause, count] : sample.causes)
        json[cause] = count;
    return json;
}

nlohmann::ordered_json features_json(const SceneFeatures& features)
{
    nlohmann::ordered_json json{{"kernel", features.kernel},
                                {"in_registers", features.in_registers},
                                {"sorts_mirrored", features.sorts_mirrored},
                                {"uses", features.uses}};
    json["left_out"] = nlohmann::ordered_json::array();
    for (const LeftOut& left : features.left_out)
        json["left_out"].push_back({{"what", left.what}, {"why", left.why}});
    return json;
}

nlohmann::ordered_json census_json(const Census& census)
{
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const auto& [kind, count] : census)
        json[kind] = count;
    return json;
}

nlohmann::ordered_json scene_json(const std::string& file, const Scene& scene,
                                  const SceneFeatures& features)
{
    return {{"file", file},
            {"width", scene.width},
            {"height", scene.height},
            {"objects", census_json(count_objects(scene))},
            {"lights", census_json(count_lights(scene))},
            {"model", word_of(scene.illumination)},
            {"depth", scene.max_depth},
            {"min_weight", scene.min_weight},
            {"shadows", word_of(scene.shadows)},
            {"memory_bytes", features.bytes}};
}

void print_json(const IsaInfo& chosen, const std::optional<SceneInput>& input)
{
    nlohmann::ordered_json json;
    json["version"] = PACKTRACE_VERSION_STRING;
    json["isas"] = nlohmann::ordered_json::array();
    for (const IsaInfo& isa : list_isas())
        json["isas"].push_back({{"name", isa.name},
                                {"lanes_single", isa.lanes_single},
                                {"lanes_double", isa.lanes_double},
                                {"supported", isa.supported}});
    json["chosen"] = chosen.name;
    if (input) {
        const SceneFeatures features = scene_features(input->scene, chosen);
        json["scene"] = scene_json(input->name, input->scene, features);
        json["scene"]["features"] = features_json(features);
        if (const auto sample = sample_unsure(input->scene, chosen.name))
            json["scene"]["unsure"] = unsure_json(*sample);
    }
    std::cout << json_text(json);
}

void print_keys(const std::string& name)
{
    bool first = true;
    for (const std::string_view table : language::key_table_names()) {
        if (name == all_tables)
            std::cout << (std::exchange(first, false) ? "" : "\n") << table << "\n\n";
        if (name == table || name == all_tables)
            std::cout << language::key_table(table);
    }
}

void run_info(const InfoArguments& arguments)
{
    if (!arguments.keys.empty())
        return print_keys(arguments.keys);
    const IsaInfo chosen = chosen_isa(arguments.isa);
    std::optional<SceneInput> input;
    if (!arguments.scene.empty())
        input = read_scene_input(arguments.scene);
    if (arguments.json)
        return print_json(chosen, input);
    std::cout << "packtrace " PACKTRACE_VERSION_STRING "\n\n";
    print_isas(chosen);
    if (input) {
        const SceneFeatures features = scene_features(input->scene, chosen);
        print_scene(input->name, input->scene, features);
        print_features(features, chosen, sample_unsure(input->scene, chosen.name));
    }
}

}  // namespace

void add_info(CLI::App& app)
{
    CLI::App* command =
        app.add_subcommand("info", "Show what this machine can run, and what a scene holds");
    const auto arguments = std::make_shared<InfoArguments>();
    CLI::Option* const scene =
        command
            ->add_option("SCENE", arguments->scene, "Scene file to look into; - is standard input")
            ->check(file_name())
            ->type_name("");
    add_isa_and_width(*command, arguments->isa);
    CLI::Option* const json = command->add_flag("--json", arguments->json, "Print JSON");
    const auto tables = language::key_table_names();
    std::vector<std::string> names(tables.begin(), tables.end());
    names.emplace_back(all_tables);
    command
        ->add_option("--keys", arguments->keys,
                     "Print the scene language's keys instead, in Markdown: a table of "
                     "docs/scene.md or all")
        ->excludes(scene)
        ->excludes(json)
        ->check(one_of(names));
    command->callback([arguments] { run_info(*arguments); });
}

}  // namespace packtrace::cli
