// The page of pictures matches the scenes.
#include "catch.hpp"
#include "render_scene.hpp"
#include "run_program.hpp"
#include "scene_files.hpp"
#include "temp_folder.hpp"
#include <packtrace/image_io.hpp>

#include <filesystem>
#include <string>

namespace packtrace::test {

TEST_CASE("the gallery shows every scene and the command for it", "[gallery]")
{
    const std::filesystem::path docs = std::filesystem::path(PACKTRACE_SOURCE_DIR) / "docs";
    const std::string page = read_text(docs / "gallery.md");
    for (const std::filesystem::path& file : scene_files()) {
        const std::string name = file.stem().string();
        CHECK_THAT(page, ContainsSubstring("(pictures/" + name + ".png)"));
        CHECK_THAT(page, ContainsSubstring("render scenes/" + name + ".scene "));
        CHECK(std::filesystem::file_size(docs / "pictures" / (name + ".png")) < 120'000);
    }
}

TEST_CASE("the gallery's pictures show the current scenes", "[gallery][slow]")
{
    const std::filesystem::path pictures =
        std::filesystem::path(PACKTRACE_SOURCE_DIR) / "docs" / "pictures";
    const TempFolder folder;
    const auto check = [&](const std::filesystem::path& scene, const std::string& name,
                           const std::vector<std::string>& frame) {
        const Image<float> kept = read_image(pictures / (name + ".png"));
        const std::filesystem::path picture = folder / (name + ".png");
        std::vector<std::string> words{
            "render",
            scene.string(),
            "--size",
            std::to_string(kept.width) + "x" + std::to_string(kept.height),
            "--isa",
            fused_isas().back(),
            "-q",
            "-o",
            picture.string()};
        words.insert(words.end(), frame.begin(), frame.end());
        INFO(name << ": ./run gallery renders it anew");
        REQUIRE(run_packtrace(words).exit_code == 0);
        CHECK((read_image(picture).rgb == kept.rgb));
    };
    for (const std::filesystem::path& file : scene_files())
        check(file, file.stem().string(), {});
    for (const char* number : {"40", "75", "119"})
        check(std::filesystem::path(PACKTRACE_SOURCE_DIR) / "scenes" / "flight.scene",
              "flight_" + std::string(number), {"--frame", number});
}

}  // namespace packtrace::test
