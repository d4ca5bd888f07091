// The page of pictures keeps up with the scenes.
#include <filesystem>

#include "catch.hpp"
#include "scene_files.hpp"
#include "temp_folder.hpp"

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

}  // namespace packtrace::test
