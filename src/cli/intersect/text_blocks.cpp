#include "cli/intersect/text_blocks.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <utility>

#include "core/file_error.hpp"
#include "scene/quote.hpp"

namespace packtrace::cli {

TextBlocks::TextBlocks(const std::string& file, std::uint64_t begin, std::uint64_t end)
    : name_(file == "-" ? "standard input" : language::escape(file)),
      file_(file == "-" ? stdin : std::fopen(file.c_str(), "rb")),
      left_(end - begin)
{
    if (!file_ || (begin > 0 && fseeko(file_.get(), static_cast<off_t>(begin), SEEK_SET) != 0))
        throw FileError(name_, "can't read", errno);
}

std::string TextBlocks::next()
{
    std::string block = std::exchange(begun_, {});
    const std::size_t kept = block.size();
    block.resize(largest);
    const std::size_t wanted = std::min<std::uint64_t>(largest - kept, left_);
    const std::size_t got = std::fread(block.data() + kept, 1, wanted, file_.get());
    left_ -= got;
    block.resize(kept + got);
    if (std::ferror(file_.get()))
        throw FileError(name_, "can't read", errno);
    if (block.size() < largest)
        return block;

    const std::size_t end = block.rfind('\n');
    if (end == std::string::npos)
        throw FileError(name_ + ':' + std::to_string(lines_ + 1) + ":1: a line of " +
                        std::to_string(largest) +
                        " bytes or more can't be a ray; write one ray a line");
    begun_ = block.substr(end + 1);
    block.resize(end + 1);
    lines_ += static_cast<std::size_t>(std::count(block.begin(), block.end(), '\n'));
    return block;
}

}  // namespace packtrace::cli
