#pragma once

#include "cli/intersect/intersect_arguments.hpp"
#include "cli/output/journal.hpp"
#include "cli/output/output.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace packtrace::cli {

/// Writes rows of hits to standard output, or to a file that appears when it is complete. With
/// `--resume` the rows of finished blocks are kept beside the file until then.
class HitOutput {
public:
    /// `recipe` has everything that hits depend on. Throws FileError.
    HitOutput(const IntersectArguments& arguments, const std::string& recipe,
              std::string_view header);

    /// The number of blocks that an earlier run finished.
    [[nodiscard]] std::uint64_t finished() const
    {
        return done_.blocks;
    }

    /// Skips the finished blocks: `next` returns their texts, one by one. Throws FileError if a
    /// text has changed since.
    void skip_finished(const std::function<std::string()>& next);

    /// Writes the rows of the next block of rays, whose text is `block`. Throws FileError.
    void take(std::string_view block, std::string_view rows);

    /// Call it after the last rows of a part. Writes the last line, with length and checksum.
    void end_part();

    /// Call it after the last rows.
    void finish();

private:
    /// The finished input and output, including the header.
    struct Progress {
        std::uint64_t blocks = 0;
        std::uint32_t rays = 0;  ///< checksum of the input
        std::uint64_t bytes = 0;
        std::uint32_t rows = 0;  ///< checksum of the output
    };

    /// Appends text to the finished output.
    void append(std::string_view text);

    [[nodiscard]] Progress find_finished(std::string_view header) const;
    void note_progress() const;
    [[noreturn]] void fail_of_rays() const;

    std::string name_;
    std::unique_ptr<Output> text_;
    std::unique_ptr<Journal> journal_;
    Progress done_;
};

}  // namespace packtrace::cli
