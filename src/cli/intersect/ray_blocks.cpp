#include "cli/intersect/ray_blocks.hpp"

#include <string_view>

namespace packtrace::cli {
namespace {

// What spreadsheets put before a text to say that it is UTF-8.
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

}  // namespace

RayBlocks::RayBlocks(const std::string& file, const RayRange& range)
    : blocks_(file, range.begin, range.end),
      format_(range.format),
      line_(range.first_line),
      ray_(range.first_ray)
{
    format_.file = blocks_.name();
}

RayBlock RayBlocks::next()
{
    RayBlock block;
    block.text = blocks_.next();
    if (line_ == 1 && block.text.starts_with(byte_order_mark))
        block.text.replace(0, byte_order_mark.size(), byte_order_mark.size(), ' ');
    block.first_line = line_;
    block.first_ray = ray_;
    CsvLines lines(block.text, line_);
    while (const std::optional<CsvLine> line = lines.next()) {
        if (format_.columns == 0)
            learn(format_, *line);
        if (line->number != format_.header_line)
            ++ray_;
    }
    line_ = lines.number();
    block.rays = ray_ - block.first_ray;
    block.format = format_;
    return block;
}

}  // namespace packtrace::cli
