#pragma once

#include "catch.hpp"
#include "scenes.hpp"
#include <packtrace/read_scene.hpp>

#include <algorithm>
#include <filesystem>
#include <vector>

// The scenes of the folder scenes/, reduced in size.
namespace packtrace::test {

/// Lists the folder, so that a new scene needs no line here.
[[nodiscard]] inline std::vector<std::filesystem::path> scene_files()
{
    namespace fs = std::filesystem;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(fs::path(PACKTRACE_SOURCE_DIR) / "scenes"))
        if (entry.path().extension() == ".scene")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    REQUIRE(files.size() >= 11);
    return files;
}

/// The scene with few pixels, odd sides, and about its own aspect ratio.
[[nodiscard]] inline Scene small_scene(const std::filesystem::path& file)
{
    Scene scene = read_scene(file);
    const int height = 51;
    set_size(scene, (height * scene.width / scene.height) | 1, height);
    return scene;
}

/// As small_scene(), but with a sixth of the pixels if rays branch a dozen times: then each pixel
/// has thousands of rays, and small_scene() takes ten times as long as all other scenes together.
[[nodiscard]] inline Scene small_or_deep_scene(const std::filesystem::path& file)
{
    Scene scene = small_scene(file);
    if (scene.max_depth > 10) {
        const int height = 21;
        set_size(scene, (height * scene.width / scene.height) | 1, height);
    }
    return scene;
}

}  // namespace packtrace::test
