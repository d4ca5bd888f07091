#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <packtrace/isa.hpp>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/common_options.hpp"
#include "cli/text_table.hpp"
#include "cli/thread_limit.hpp"
#include "cli/validators.hpp"
#include "study/stress.hpp"

namespace packtrace::cli {
namespace {

using study::StressRow;

constexpr int most_rays = 10000000;

struct StressArguments {
    study::StressOptions options;
    std::optional<std::string> isa;
    int threads = 0;
    bool list = false;
    bool json = false;
};

std::vector<std::string> family_names()
{
    std::vector<std::string> names;
    for (const auto& family : study::list_stress_families())
        names.push_back(family.name);
    return names;
}

TextTable make_table()
{
    return {5,
            {"family", "precision", "kernel", "mode", "instruction sets", "hits", "wrong",
             "in band", "nan", "ulp 50%", "99%", "max", "rho", "off surface", "normal",
             "note self/lost", "exact", "ns", "best"}};
}

std::string pair_of(std::uint64_t taken, std::uint64_t lost)
{
    return std::to_string(taken) + "/" + std::to_string(lost);
}

void add_row(TextTable& table, const StressRow& row)
{
    table.add({row.family, row.precision, row.kernel, row.mode, row.isa, std::to_string(row.hits),
               std::to_string(row.wrong), std::to_string(row.wrong_in_band),
               std::to_string(row.not_finite), brief(row.ulp_median), brief(row.ulp_p99),
               brief(row.ulp_max), brief(row.rho), brief(row.distance), brief(row.normal),
               pair_of(row.note_taken, row.note_lost), pair_of(row.exact_taken, row.exact_lost),
               fixed(row.ns, 1), row.pareto ? "*" : ""});
}

nlohmann::ordered_json row_json(const StressRow& row)
{
    return {{"family", row.family},
            {"precision", row.precision},
            {"kernel", row.kernel},
            {"mode", row.mode},
            {"isa", row.isa},
            {"rays", row.rays},
            {"hits", row.hits},
            {"undecidable", row.undecidable},
            {"wrong", row.wrong},
            {"wrong_in_band", row.wrong_in_band},
            {"not_finite", row.not_finite},
            {"ulp_median", row.ulp_median},
            {"ulp_p99", row.ulp_p99},
            {"ulp_max", row.ulp_max},
            {"rho", row.rho},
            {"distance_roundoffs", row.distance},
            {"normal_error", row.normal},
            {"relative_error_well_conditioned", row.relative},
            {"secondary_rays", row.secondary},
            {"note_self_hits", row.note_taken},
            {"note_lost_hits", row.note_lost},
            {"exact_self_hits", row.exact_taken},
            {"exact_lost_hits", row.exact_lost},
            {"ns_per_ray", row.ns},
            {"pareto", row.pareto},
            {"broken_bounds", row.broken}};
}

void print_families()
{
    TextTable table(2, {"family", "rays"});
    for (const auto& family : study::list_stress_families())
        table.add({family.name, family.what});
    table.print(std::cout);
}

void print_rows(const std::vector<StressRow>& rows)
{
    TextTable table = make_table();
    for (const StressRow& row : rows)
        add_row(table, row);
    table.print(std::cout);
}

/// One line a broken bound; how many there are.
std::size_t print_broken(const std::vector<StressRow>& rows)
{
    std::size_t count = 0;
    for (const StressRow& row : rows)
        for (const std::string& bound : row.broken) {
            std::cerr << "packtrace: " << row.family << ", " << row.precision << ' ' << row.mode
                      << " (" << row.isa << "): broken: " << bound << '\n';
            ++count;
        }
    return count;
}

void run(const StressArguments& arguments)
{
    if (arguments.list)
        return print_families();
    study::StressOptions options = arguments.options;
    if (arguments.isa)
        options.isa = chosen_isa({arguments.isa, {}}).name;
    const ThreadLimit limit(arguments.threads);
    std::vector<StressRow> rows;
    study::run_stress(options, [&](const std::vector<StressRow>& some) {
        rows.insert(rows.end(), some.begin(), some.end());
    });
    if (arguments.json) {
        nlohmann::ordered_json json;
        json["seed"] = options.seed;
        json["rays_per_family"] = options.rays;
        json["rows"] = nlohmann::ordered_json::array();
        for (const StressRow& row : rows)
            json["rows"].push_back(row_json(row));
        std::cout << json.dump(2) << '\n';
    } else {
        print_rows(rows);
    }
    if (print_broken(rows) > 0)
        throw Failed{};
}

}  // namespace

void add_stress(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "stress", "Hold the kernels against extreme rays whose hits are known to 113 bits");
    const auto arguments = std::make_shared<StressArguments>();
    study::StressOptions& options = arguments->options;
    command->add_option("--family", options.families, "Only this family of rays (repeatable)")
        ->check(one_of(family_names()))
        ->type_name("NAME");
    command->add_flag("--list", arguments->list, "List the families");
    command->add_option("--rays", options.rays, "Rays of each family (default 2000)")
        ->check(whole_number(1, most_rays))
        ->type_name("N");
    command->add_option("--seed", options.seed, "Other rays of the same kind (default 1)")
        ->type_name("N");
    command->add_option("--kernel", options.kernels, "Only this kernel (repeatable)")
        ->check(one_of({"packet", "scalar", "naive"}))
        ->type_name("packet|scalar|naive");
    command->add_option("--mode", options.modes, "Only this accuracy of packets (repeatable)")
        ->check(one_of({"fast", "auto", "robust"}))
        ->type_name("fast|auto|robust");
    command->add_option("--precision", options.precisions, "Only this precision (repeatable)")
        ->check(one_of({"single", "double"}))
        ->type_name("single|double");
    command->add_option("--isa", arguments->isa, "Only this instruction set (default all)")
        ->type_name("NAME");
    add_threads_option(*command, arguments->threads);
    command->add_flag("--json", arguments->json, "Print JSON");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace packtrace::cli
