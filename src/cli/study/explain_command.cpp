#include "cli/command.hpp"
#include "cli/options/common_options.hpp"
#include "cli/options/scene_input.hpp"
#include "cli/options/validators.hpp"
#include "cli/study/explain_print.hpp"
#include "core/json_text.hpp"
#include "render/precision.hpp"
#include <packtrace/explain.hpp>

#include <array>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace packtrace::cli {
namespace {

struct ExplainArguments {
    std::string scene;
    std::string pixel;  ///< column and row
    std::string precision = "single";
    AccuracyArguments accuracy;
    IsaArguments isa;
    PictureArguments picture;
    bool json = false;
};

/// Reads column and row from "320,240". Not set if no picture can have this pixel.
std::optional<std::array<int, 2>> parse_pixel(std::string_view text)
{
    const std::optional<std::array<int, 2>> pixel = parse_numbers<2>(text, ',');
    if (!pixel || (*pixel)[0] < 0 || (*pixel)[1] < 0)
        return std::nullopt;
    return pixel;
}

void check_inside(const ExplainArguments& arguments, const Scene& scene)
{
    const auto [x, y] = parse_pixel(arguments.pixel).value();
    if (x >= scene.width || y >= scene.height)
        throw CLI::ValidationError("--pixel: " + arguments.pixel + " lies outside the picture of " +
                                   std::to_string(scene.width) + " x " +
                                   std::to_string(scene.height) + " pixels, columns 0 to " +
                                   std::to_string(scene.width - 1) + " and rows 0 to " +
                                   std::to_string(scene.height - 1));
}

RenderOptions packet_options(const ExplainArguments& arguments)
{
    RenderOptions options{.isa = chosen_isa(arguments.isa).name};
    apply(arguments.accuracy, "packet", chosen_precision(arguments.precision), options);
    return options;
}

Explanation explain(const ExplainArguments& arguments, const std::string& name, const Scene& scene)
{
    RenderOptions options = packet_options(arguments);
    Explanation result;
    result.file = name;
    const auto [x, y] = parse_pixel(arguments.pixel).value();
    result.x = x;
    result.y = y;
    result.precision = chosen_precision(arguments.precision);
    result.isa = options.isa;
    result.tolerance =
        result.precision == Precision::single ? single_tree_tolerance : double_tree_tolerance;
    result.packets = with_packet_real(result.precision, [&]<class Real>() {
        return explain_pixel<Real>(scene, result.x, result.y, options);
    });
    options.kernel = Kernel::scalar;
    result.reference = explain_pixel<double>(scene, result.x, result.y, options);
    result.rows = side_by_side(result.reference, result.packets, result.tolerance);
    return result;
}

void run_explain(const ExplainArguments& arguments)
{
    (void)packet_options(arguments);
    SceneInput input = read_scene_input(arguments.scene);
    Scene& scene = input.scene;
    apply(arguments.picture, scene);
    check_inside(arguments, scene);
    const Explanation explanation = explain(arguments, input.name, scene);
    if (arguments.json)
        std::cout << json_text(explanation_json(scene, explanation));
    else
        print_explanation(std::cout, scene, explanation);
}

}  // namespace

void add_explain(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "explain", "Show the ray tree of one pixel, by the reference and by packets");
    const auto arguments = std::make_shared<ExplainArguments>();
    add_scene_option(*command, arguments->scene);
    command->add_option("--pixel", arguments->pixel, "Column and row, from 0 at the top left")
        ->required()
        ->check(parsed_by(parse_pixel, "a pixel such as 320,240: column and row, counted from 0"))
        ->type_name("X,Y");
    add_precision_option(*command, arguments->precision,
                         "Of the packets: single (default) or double");
    add_accuracy_and_self_hits(*command, arguments->accuracy);
    add_isa_and_width(*command, arguments->isa);
    add_picture_options(*command, arguments->picture);
    command->add_flag("--json", arguments->json, "Print both trees as JSON");
    command->callback([arguments] { run_explain(*arguments); });
}

}  // namespace packtrace::cli
