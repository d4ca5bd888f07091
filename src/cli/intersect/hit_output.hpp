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

/// Where rows of hits go: standard output, or a file that appears when complete. With `--resume`
/// the rows of finished blocks are kept beside it until then.
class HitOutput {
public:
    /// `recipe` says what hits depend on. Throws FileError.
    HitOutput(const IntersectArguments& arguments, const std::string& recipe,
              std::string_view header);

    /// Blocks that an earlier run finished.
    [[nodiscard]] std::uint64_t finished() const
    {
        return done_.blocks;
    }

    /// Passes over them: `next` gives the text of one after the other. Throws FileError where that
    /// has changed since.
    void skip_finished(const std::function<std::string()>& next);

    /// Rows of the next block of rays, which has this text. Throws FileError.
    void take(std::string_view block, std::string_view rows);

    /// After the last rows of a part: the line that says that it is whole.
    void end_part();

    /// After the last rows.
    void finish();

private:
    /// How much of input and output is finished, the header included.
    struct Progress {
        std::uint64_t blocks = 0;
        std::uint32_t rays = 0;  ///< checksum
        std::uint64_t bytes = 0;
        std::uint32_t rows = 0;  ///< checksum
    };

    /// Behind all that is finished, which it is part of then.
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
