#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>

namespace packtrace::cli {

/// Reads a file, or its bytes from `begin` to `end`, in blocks of whole lines, so that its length
/// costs no memory. `-` is standard input.
class TextBlocks {
public:
    /// Also the longest line allowed.
    static constexpr std::size_t largest = std::size_t{1} << 16;

    /// Throws FileError.
    explicit TextBlocks(const std::string& file, std::uint64_t begin = 0,
                        std::uint64_t end = std::numeric_limits<std::uint64_t>::max());

    /// The next block, at most `largest` bytes; empty at the end. Throws FileError.
    [[nodiscard]] std::string next();

    /// The file's name as messages show it.
    [[nodiscard]] const std::string& name() const
    {
        return name_;
    }

private:
    struct Closer {
        void operator()(std::FILE* file) const
        {
            if (file != stdin)
                std::fclose(file);
        }
    };

    std::string name_;
    std::unique_ptr<std::FILE, Closer> file_;
    std::uint64_t left_;  // bytes of the range that have not been read yet
    std::string begun_;   // the start of a line whose end has not been read yet
    std::size_t lines_ = 0;
};

}  // namespace packtrace::cli
