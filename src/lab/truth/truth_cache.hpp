#pragma once

#include "lab/truth/truth.hpp"
#include <packtrace/scene.hpp>

#include <filesystem>
#include <optional>
#include <string>

// How truths are kept: the key of all that one depends on, and its file.
namespace packtrace {

/// All that a truth depends on. Two truths of equal keys have the same bits.
struct TruthKey {
    std::string version;    ///< of packtrace
    std::string sources;    ///< digest of the sources that were built
    std::string compiler;   ///< and its flags
    std::string machine;    ///< processor and C library, whose functions may round differently
    std::string precision;  ///< of the reference, with its bits
    std::string self_hits;  ///< rule by which rays leave the surface that they start on
    int samples = 1;        ///< a pixel
    std::string scene;      ///< text of the scene, with its camera, size and depth

    /// One line for each part, the scene last.
    [[nodiscard]] std::string text() const;
};

/// The key of the truth that this program would make now. Throws std::invalid_argument for a scene
/// that has no text (write_scene.hpp).
[[nodiscard]] TruthKey truth_key(const Scene& scene, int samples);

/// A truth's key, its picture and its seconds, in full precision and this machine's byte order,
/// with a checksum over all of them. Throws FileError.
void write_truth(const std::filesystem::path& file, const std::string& key, const Truth& truth);

/// Nothing where there is no such file, it is not whole, a byte of it has changed, or it has
/// another key.
[[nodiscard]] std::optional<Truth> read_truth(const std::filesystem::path& file,
                                              const std::string& key);

}  // namespace packtrace
