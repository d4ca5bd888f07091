#include "cli/study/bench_file.hpp"

#include "core/json_text.hpp"
#include "core/read_file.hpp"
#include "lab/harness/machine.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <stdexcept>

namespace packtrace::cli {
namespace {

using Json = nlohmann::ordered_json;

const BenchLine* find_in(const std::vector<BenchLine>& lines, const std::string& name)
{
    const auto found = std::find_if(lines.begin(), lines.end(),
                                    [&](const BenchLine& line) { return line.name == name; });
    return found != lines.end() ? &*found : nullptr;
}

void append_values(std::vector<double>& to, const std::vector<double>& more)
{
    to.insert(to.end(), more.begin(), more.end());
}

void add_lines(std::vector<BenchLine>& to, const std::vector<BenchLine>& more)
{
    for (const BenchLine& line : more)
        if (const BenchLine* known = find_in(to, line.name)) {
            BenchLine& sum = to[static_cast<std::size_t>(known - to.data())];
            append_values(sum.ratios, line.ratios);
            append_values(sum.seconds, line.seconds);
        } else {
            to.push_back(line);
        }
}

Json bench_line_json(const BenchLine& line)
{
    return {{"name", line.name},
            {"ratio", line.ratio()},
            {"spread", relative_spread(line.ratios)},
            {"milliseconds", 1e3 * median_of(line.seconds)},
            {"ratios", line.ratios}};
}

bool is_positive(const Json& value)
{
    return value.is_number() && value > 0.0;
}

bool is_bench_line(const Json& line)
{
    return line.is_object() && line.contains("name") && line["name"].is_string() &&
           line.contains("milliseconds") && is_positive(line["milliseconds"]) &&
           line.contains("ratios") && line["ratios"].is_array() && !line["ratios"].empty() &&
           std::all_of(line["ratios"].begin(), line["ratios"].end(), is_positive);
}

bool is_bench(const Json& json)
{
    return json.is_object() && json.value("packtrace_bench", Json()) == 1 &&
           json.contains("lines") && json["lines"].is_array() &&
           std::all_of(json["lines"].begin(), json["lines"].end(), is_bench_line);
}

BenchLine bench_line_of(const Json& json)
{
    // A file has only the median of the times.
    return {json["name"], json["ratios"], {1e-3 * json["milliseconds"].get<double>()}};
}

}  // namespace

const BenchLine* BenchFigures::find(const std::string& name) const
{
    return find_in(lines, name);
}

void BenchFigures::add(const BenchFigures& more)
{
    add_lines(lines, more.lines);
    add_lines(references, more.references);
}

std::string bench_text(const BenchFigures& figures)
{
    Json json{{"packtrace_bench", 1},
              {"conditions",
               {{"processor", processor_name()},
                {"compiler", compiler_name()},
                {"flags", kernel_flags},
                {"commit", built_commit},
                {"load_before", load_at_start()},
                {"load_after", load_now()}}},
              {"picture", figures.picture},
              {"scenes", figures.scenes},
              {"references", Json::array()},
              {"lines", Json::array()}};
    for (const BenchLine& reference : figures.references)
        json["references"].push_back({{"name", reference.name},
                                      {"milliseconds", 1e3 * median_of(reference.seconds)},
                                      {"spread", relative_spread(reference.seconds)}});
    for (const BenchLine& line : figures.lines)
        json["lines"].push_back(bench_line_json(line));
    return json_text(json);
}

BenchFigures read_bench_text(const std::string& text, const std::string& name)
{
    const Json json = Json::parse(text, nullptr, false);
    if (!is_bench(json))
        throw std::runtime_error(name + ": not a file that packtrace bench -o writes");
    BenchFigures figures;
    // Files of earlier versions have no picture, scenes or references.
    if (const Json picture = json.value("picture", Json()); picture.is_string())
        figures.picture = picture;
    const Json scenes = json.value("scenes", Json::object());
    for (const auto& [scene, checksum] : scenes.items())
        if (checksum.is_string())
            figures.scenes.emplace(scene, checksum);
    for (const Json& line : json["lines"])
        figures.lines.push_back(bench_line_of(line));
    for (const Json& reference : json.value("references", Json::array()))
        if (reference.is_object() && reference.contains("name") && reference["name"].is_string() &&
            reference.contains("milliseconds") && is_positive(reference["milliseconds"]))
            figures.references.push_back(
                {reference["name"], {1.0}, {1e-3 * reference["milliseconds"].get<double>()}});
    return figures;
}

BenchFigures read_bench_file(const std::filesystem::path& file)
{
    return read_bench_text(read_file(file), file.string());
}

}  // namespace packtrace::cli
