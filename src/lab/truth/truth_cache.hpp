#pragma once

#include "lab/truth/truth.hpp"
#include <packtrace/scene.hpp>

#include <filesystem>
#include <optional>
#include <string>

// The cache of truths: the key of all that a truth depends on, and its file.
namespace packtrace {

/// All that a truth depends on. Truths with equal keys have the same bits.
struct TruthKey {
    std::string version;    ///< of packtrace
    std::string sources;    ///< digest of the sources that were built
    std::string compiler;   ///< and its flags
    std::string machine;    ///< processor and C library, whose functions may round differently
    std::string precision;  ///< of the reference, with its bits
    std::string self_hits;  ///< the rule for self-hits
    int samples = 1;        ///< per pixel
    std::string scene;      ///< text of the scene, with its camera, size and depth

    /// One line for each member, the scene last.
    [[nodiscard]] std::string text() const;
};

/// The key of a truth that this program would make now. Throws std::invalid_argument for a scene
/// that has no text (write_scene.hpp).
[[nodiscard]] TruthKey truth_key(const Scene& scene, int samples);

/// Writes a truth's key, picture and seconds, in full precision and this machine's byte order, with
/// a checksum. Throws FileError.
void write_truth(const std::filesystem::path& file, const std::string& key, const Truth& truth);

/// None if there is no such file, if it is incomplete or changed, or if it has another key.
[[nodiscard]] std::optional<Truth> read_truth(const std::filesystem::path& file,
                                              const std::string& key);

}  // namespace packtrace
