#include "cli/command.hpp"
#include "cli/options/common_options.hpp"
#include "cli/output/distinct_files.hpp"
#include "core/json_text.hpp"
#include <packtrace/compare.hpp>
#include <packtrace/image_io.hpp>

#include <nlohmann/json.hpp>

#include <climits>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace packtrace::cli {
namespace {

struct CompareArguments {
    std::string a;
    std::string b;
    CompareOptions options;
    std::string heatmap;
    std::optional<double> max_error;
    bool json = false;
};

std::string size_of(const Image<float>& image)
{
    return std::to_string(image.width) + " x " + std::to_string(image.height);
}

double share_off(const Comparison& result)
{
    return static_cast<double>(result.pixels_off) / static_cast<double>(result.pixels);
}

void print_text(const Comparison& result, const CompareOptions& options)
{
    std::cout << std::setprecision(6) << "max abs error  " << result.max_abs << '\n'
              << "RMSE           " << result.rmse << '\n'
              << "PSNR           " << result.psnr << " dB\n"
              << "pixels off     " << result.pixels_off << " of " << result.pixels << " ("
              << 100.0 * share_off(result) << " %) by more than " << options.threshold << '\n';
    for (const PixelError& pixel : result.worst)
        std::cout << "worst          " << pixel.error << " at " << pixel.x << ',' << pixel.y
                  << '\n';
}

// Infinite numbers become null. `equal` distinguishes equal pictures, whose PSNR is infinite, from
// pictures with an infinite error.
void print_json(const CompareArguments& arguments, const Image<float>& image,
                const Comparison& result)
{
    nlohmann::ordered_json json;
    json["a"] = arguments.a;
    json["b"] = arguments.b;
    json["width"] = image.width;
    json["height"] = image.height;
    json["equal"] = result.max_abs == 0.0;
    json["max_abs"] = finite_or_null(result.max_abs);
    json["rmse"] = finite_or_null(result.rmse);
    json["psnr"] = finite_or_null(result.psnr);
    json["pixels"] = result.pixels;
    json["threshold"] = arguments.options.threshold;
    json["pixels_off"] = result.pixels_off;
    json["share_off"] = share_off(result);
    json["worst"] = nlohmann::json::array();
    for (const PixelError& pixel : result.worst)
        json["worst"].push_back(
            {{"x", pixel.x}, {"y", pixel.y}, {"error", finite_or_null(pixel.error)}});
    std::cout << json_text(json);
}

void run_compare(const CompareArguments& arguments)
{
    if (!arguments.heatmap.empty())
        check_image_writable(arguments.heatmap);
    check_not_read(arguments.heatmap, {arguments.a, arguments.b});
    const Image<float> a = read_image(arguments.a);
    const Image<float> b = read_image(arguments.b);
    if (a.width != b.width || a.height != b.height)
        throw std::invalid_argument("can't compare pictures of different size: " + arguments.a +
                                    " is " + size_of(a) + ", " + arguments.b + " is " + size_of(b));
    const Comparison result = compare(a, b, arguments.options);
    if (!arguments.heatmap.empty())
        write_image(arguments.heatmap, heatmap(a, b));
    if (arguments.json)
        print_json(arguments, a, result);
    else
        print_text(result, arguments.options);
    if (arguments.max_error && result.max_abs > *arguments.max_error) {
        std::cerr << std::setprecision(6) << "packtrace: the largest error is " << result.max_abs
                  << ", above --max-error " << *arguments.max_error << '\n';
        throw Failed{};
    }
}

}  // namespace

void add_compare(CLI::App& app)
{
    CLI::App* command =
        app.add_subcommand("compare", "Measure how far one picture is from another");
    const auto arguments = std::make_shared<CompareArguments>();
    command->add_option("A", arguments->a, "Picture: .png, .pfm or .hdr")
        ->required()
        ->type_name("");
    command->add_option("B", arguments->b, "Picture of the same size")->required()->type_name("");
    add_threshold_option(*command, arguments->options.threshold);
    command
        ->add_option("--worst", arguments->options.worst,
                     "How many of the worst pixels to list (default 5)")
        ->check(whole_number(0, INT_MAX))
        ->type_name("N");
    command->add_option("--heatmap", arguments->heatmap, "Write a picture of the error per pixel")
        ->check(file_name())
        ->type_name("IMAGE");
    add_fraction_option(
        *command, "--max-error", arguments->max_error,
        "Exit 1, and say why, when the largest error exceeds this, a number or a fraction N/M")
        ->check(non_negative_fraction())
        ->type_name("X");
    command->add_flag("--json", arguments->json, "Print JSON; infinite numbers become null");
    command->callback([arguments] { run_compare(*arguments); });
}

}  // namespace packtrace::cli
