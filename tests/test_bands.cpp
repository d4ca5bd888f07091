// Pictures that are rendered and written in bands of rows.
#include "catch.hpp"
#include "core/cut_rays.hpp"
#include "image/formats.hpp"
#include "image/row_file.hpp"
#include "intersect_program.hpp"
#include "render/row_renderer.hpp"
#include "samplings.hpp"
#include "scene_files.hpp"
#include "temp_folder.hpp"
#include <packtrace/image_io.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/renderer.hpp>

#include <string>
#include <vector>

namespace packtrace::test {
namespace {

/// Renders the rows of a picture in bands of `rows`, from the last band up.
template <class Real>
Image<Real> in_bands(const Scene& scene, const RenderOptions& options, int rows, CutRays& cut)
{
    const RenderRows<Real> render_rows = row_renderer<Real>(scene, options);
    Image<Real> image(scene.width, scene.height);
    for (int first = (scene.height - 1) / rows * rows; first >= 0; first -= rows) {
        Image<Real> band(scene.width, std::min(rows, scene.height - first));
        cut += render_rows(first, band).cut;
        std::copy(band.rgb.begin(), band.rgb.end(), image.pixel(0, first));
    }
    return image;
}

template <class Real>
void check_bands(const Scene& scene, const RenderOptions& options, int rows)
{
    CutRays cut;
    CutRays whole_cut;
    const Image<Real> whole = render<Real>(scene, options, &whole_cut);
    CHECK((in_bands<Real>(scene, options, rows, cut).rgb == whole.rgb));
    CHECK(cut.rays == whole_cut.rays);
    CHECK(cut.bound == whole_cut.bound);
}

Image<float> any_picture(int width, int height)
{
    Image<float> image(width, height);
    for (std::size_t i = 0; i < image.rgb.size(); ++i)
        image.rgb[i] = static_cast<float>(i * 2654435761u % 1021) / 700.0f - 0.1f;
    return image;
}

}  // namespace

TEST_CASE("a picture rendered in bands has the bits of the whole picture", "[bands]")
{
    for (const auto& file : scene_files()) {
        Scene scene = small_scene(file);
        scene.min_weight = 0.02;
        for (const Sampling& sampling : samplings()) {
            CAPTURE(file.filename().string(), sampling.name);
            check_bands<float>(scene, sampling.options, 16);
            check_bands<double>(scene, sampling.options, 32);
        }
    }
}

TEST_CASE("the scalar reference renders bands with the bits of the whole picture", "[bands]")
{
    Scene scene = read_scene(PACKTRACE_SOURCE_DIR "/scenes/four_spheres.scene");
    set_size(scene, 37, 51);
    scene.min_weight = 0.02;
    for (Sampling sampling : samplings()) {
        CAPTURE(sampling.name);
        sampling.options.kernel = Kernel::scalar;
        check_bands<float>(scene, sampling.options, 16);
        check_bands<double>(scene, sampling.options, 32);
        check_bands<long double>(scene, sampling.options, 48);
    }
}

TEST_CASE("a picture written row by row gives the same file as one written whole", "[bands]")
{
    const TempFolder folder;
    const Image<float> image = any_picture(61, 50);
    for (const std::string name : {"a.png", "a.pfm", "a.hdr"}) {
        const double gamma = name == "a.png" ? 2.2 : 1.0;
        write_image(folder / ("whole_" + name), image, {.gamma = gamma, .recipe = {}});
        const RowSamples format(folder / name, image.width, gamma);
        RowFile file(folder / name, image.width, image.height);
        const bool below = RowFile::begins_below(format.format());
        for (int done = 0; done < image.height;) {
            const int rows = std::min(7, image.height - done);
            const int first = below ? image.height - done - rows : done;
            const std::size_t values = 3u * 61u * static_cast<std::size_t>(rows);
            Bytes samples(format.row_bytes() * static_cast<std::size_t>(rows));
            format.encode(std::span<const float>(image.pixel(0, first), values), samples.data());
            file.write(samples);
            done += rows;
        }
        CHECK_FALSE(std::filesystem::exists(folder / name));
        file.commit();
        CAPTURE(name);
        CHECK((read_text(folder / name) == read_text(folder / ("whole_" + name))));
    }
}

TEST_CASE("a PNG written row by row arrives in pieces that make up the picture", "[bands]")
{
    const Image<float> image = any_picture(300, 40);
    Bytes pieces;
    int count = 0;
    PngRows rows(image.width, image.height, [&](std::span<const std::uint8_t> bytes) {
        pieces.insert(pieces.end(), bytes.begin(), bytes.end());
        ++count;
    });
    Bytes row(3u * 300u);
    const RowSamples format("a.png", image.width, 1.0);
    for (int y = 0; y < image.height; ++y) {
        format.encode(std::span<const float>(image.pixel(0, y), row.size()), row.data());
        rows.write(row.data());
    }
    rows.finish();
    CHECK(count > 3);
    CHECK((pieces == encode_png(image, {.recipe = {}, .largest_whole = 0})));
}

TEST_CASE("an exception of the receiver of a PNG's bytes reaches the caller", "[bands]")
{
    PngRows rows(4000, 4000, [](std::span<const std::uint8_t> bytes) {
        if (bytes.size() > 1000)
            throw std::runtime_error("the disk is full");
    });
    const Image<float> image = any_picture(4000, 1);
    const RowSamples format("a.png", image.width, 1.0);
    Bytes row(3u * 4000u);
    const auto write_all = [&] {
        for (int y = 0; y < 4000; ++y) {
            std::fill(row.begin(), row.end(), static_cast<std::uint8_t>(y * 37));
            for (std::size_t i = 0; i < row.size(); ++i)
                row[i] = static_cast<std::uint8_t>((i * i + static_cast<std::size_t>(y)) % 251);
            rows.write(row.data());
        }
    };
    CHECK_THROWS_WITH(write_all(), "the disk is full");
}

TEST_CASE("a large picture is not held in memory while it is rendered and written", "[bands]")
{
    const TempFolder folder;
    write_text(folder / "one.scene",
               "sphere { center = (0, 0, 3)  radius = 1  color = (9, 9, 9) }");
    const ShellResult result =
        run_in_shell("render " + shell_quoted((folder / "one.scene").string()) +
                     " --size 32768x4096 -q -o " + shell_quoted((folder / "a.png").string()));
    CHECK(result.exit_code == 0);
    // The picture alone would take 1.5 GB.
    CHECK(result.peak_memory < 600 * 1024);
    CHECK(std::filesystem::file_size(folder / "a.png") > 1000);
}

}  // namespace packtrace::test
