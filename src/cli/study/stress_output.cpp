#include "cli/output/text_table.hpp"
#include "cli/study/stress_command.hpp"
#include "core/atomic_file.hpp"
#include "core/checksum.hpp"
#include "core/json_text.hpp"
#include "lab/stress/stress.hpp"
#include "lab/stress/stress_subject.hpp"
#include "render/option_words.hpp"
#include <packtrace/version.hpp>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <iostream>
#include <string>

namespace packtrace::cli {
namespace {

using lab::StressRow;

TextTable make_table()
{
    return {5, {"family",     "precision",     "kernel", "mode",     "instruction sets",
                "rays",       "hits",          "wrong",  "lost",     "false",
                "object",     "root",          "other",  "own band", "self",
                "2nd lost",   "bounds missed", "t 50%",  "99%",      "max",
                "normal 99%", "max",           "side",   "none",     "2nd t 99%",
                "ns",         "best"}};
}

void add_row(TextTable& table, const StressRow& row)
{
    const auto count = [](std::uint64_t number) { return std::to_string(number); };
    table.add({row.family,
               std::string(language::word_of(row.precision)),
               row.kernel,
               row.mode,
               row.isa,
               count(row.rays),
               count(row.hits),
               count(row.wrong),
               count(row.lost),
               count(row.false_hits),
               count(row.wrong_object),
               count(row.wrong_root),
               count(row.occluded + row.order + row.not_closed),
               count(row.beyond_own_band),
               count(row.self_hits),
               count(row.second_lost),
               row.held ? count(row.bounds_missed) : "",
               brief(row.ulp.median, 2),
               brief(row.ulp.p99, 2),
               brief(row.ulp.max, 2),
               brief(row.normal.p99, 2),
               brief(row.normal.max, 2),
               count(row.wrong_side),
               count(row.no_normal + row.not_finite),
               brief(row.second.p99, 2),
               fixed(row.ns, 1),
               row.pareto ? "*" : ""});
}

nlohmann::ordered_json spread_json(const lab::ErrorSpread& spread)
{
    return {{"median", spread.median}, {"p99", spread.p99}, {"max", spread.max}};
}

nlohmann::ordered_json row_json(const StressRow& row)
{
    nlohmann::ordered_json json{
        {"family", row.family}, {"precision", language::word_of(row.precision)},
        {"kernel", row.kernel}, {"mode", row.mode},
        {"isa", row.isa},       {"held", row.held}};
    for (const auto& [key, count] : lab::error_counts) {
        if (count == &StressRow::lost)
            json["wrong"] = row.wrong;
        if (count == &StressRow::normal_beyond) {
            json["ulp"] = spread_json(row.ulp);
            json["normal_error"] = spread_json(row.normal);
        }
        json[key] = row.*count;
    }
    json.update({{"rho", row.rho},
                 {"distance_roundoffs", row.distance},
                 {"second_rays", row.second_rays},
                 {"self_hits", row.self_hits},
                 {"second_lost", row.second_lost},
                 {"second_inexact", row.second_inexact},
                 {"second_error", spread_json(row.second)},
                 {"bounds", row.bounds},
                 {"bounds_missed", row.bounds_missed},
                 {"bounds_ulp", spread_json(row.bounds_ulp)},
                 {"ns_per_ray", row.ns},
                 {"pareto", row.pareto},
                 {"first_wrong", row.example},
                 {"faults", row.faults}});
    return json;
}

void print_rows(const std::vector<StressRow>& rows)
{
    TextTable table = make_table();
    for (const StressRow& row : rows)
        add_row(table, row);
    table.print(std::cout);
}

/// Prints one line for each row with faults, and its first wrong ray.
void print_faults(const std::vector<StressRow>& rows)
{
    for (const StressRow& row : rows) {
        if (row.faults.empty())
            continue;
        std::cout << row.family << ", " << language::word_of(row.precision) << ' ' << row.mode
                  << " (" << row.isa << "): " << joined(row.faults) << '\n';
        if (!row.example.empty())
            std::cout << "    " << row.example << '\n';
    }
}

/// The members of a part that must be equal in all parts.
nlohmann::ordered_json recipe_json(const StressArguments& arguments)
{
    const lab::StressOptions& options = arguments.options;
    return {{"version", PACKTRACE_VERSION_STRING},
            {"families", options.families},
            {"kernels", options.kernels},
            {"modes", options.modes},
            {"precisions", arguments.precisions},
            {"isa", arguments.isa.value_or("all")},
            {"traversal", arguments.traversal.value_or("auto")},
            {"self_hits", arguments.self_hits.value_or("exact")}};
}

void print_json(const StressArguments& arguments, const std::vector<StressRow>& rows)
{
    const lab::StressOptions& options = arguments.options;
    nlohmann::ordered_json json;
    if (arguments.shard) {
        json["shard"] = *arguments.shard;
        json["recipe"] = recipe_json(arguments);
    }
    json["seed"] = options.seed;
    json["rays_per_family"] = options.rays;
    json["verdict"] = lab::stress_verdict(rows);
    json["rows"] = nlohmann::ordered_json::array();
    for (const StressRow& row : rows)
        json["rows"].push_back(row_json(row));
    if (arguments.shard)
        json["checksum"] = checksum(bytes_of(json_text(json)));
    std::cout << json_text(json);
}

/// Writes the first wrong ray of each row and its scene, for `packtrace intersect`.
void write_cases(const std::filesystem::path& folder, const std::vector<StressRow>& rows)
{
    for (const StressRow& row : rows) {
        if (row.example.empty())
            continue;
        make_folders(folder);
        std::string name =
            row.family + "-" + std::string(language::word_of(row.precision)) + "-" + row.kernel;
        for (const std::string& part : {row.mode, row.isa.substr(0, row.isa.find(' '))})
            name += part.empty() ? "" : "-" + part;
        write_file(folder / (name + ".scene"), "# " + row.example + "\n" + row.example_scene);
        write_file(folder / (name + ".csv"), row.example_ray);
    }
}

}  // namespace

void print_stress_families(const StressArguments& arguments)
{
    auto json = nlohmann::ordered_json::array();
    TextTable table(2, {"family", "rays"});
    for (const auto& family : lab::list_stress_families()) {
        if (!lab::wanted(arguments.options.families, family.name))
            continue;
        json.push_back({{"family", family.name}, {"rays", family.what}});
        table.add({family.name, family.what});
    }
    if (arguments.json)
        std::cout << json_text(json);
    else
        table.print(std::cout);
}

void print_stress(const StressArguments& arguments, const std::vector<StressRow>& rows)
{
    if (arguments.cases)
        write_cases(*arguments.cases, rows);
    if (arguments.json)
        return print_json(arguments, rows);
    print_rows(rows);
    print_faults(rows);
    std::cout << lab::stress_verdict(rows) << '\n';
}

}  // namespace packtrace::cli
