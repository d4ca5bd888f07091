// Any text as a CSV of rays gives the same number of rays in every column, or a one-line error.
#include "cli/intersect/ray_csv.hpp"
#include "cli/intersect/ray_file.hpp"
#include "core/read_file.hpp"
#include "input_file.hpp"

#include <string>

namespace {

template <class Real>
std::size_t count_rays(const std::string& file)
{
    using namespace packtrace::cli;
    RayBlocks blocks(file);
    packtrace::RayColumns<Real> rays;
    std::size_t count = 0;
    for (RayBlock block = blocks.next(); !block.text.empty(); block = blocks.next()) {
        read_rays(block.format, block.text, block.first_line, rays);
        for (const auto& column : rays.columns)
            packtrace::fuzz::require(column.size() == rays.columns[0].size(),
                                     "columns of rays are as long as each other");
        count += rays.size();
    }
    return count;
}

}  // namespace

PACKTRACE_FUZZER(rays)
{
    const packtrace::fuzz::InputFile file(bytes);
    try {
        const std::size_t count = count_rays<double>(file.name());
        packtrace::fuzz::require(count_rays<float>(file.name()) == count,
                                 "both precisions read the same rays");
    } catch (const packtrace::FileError& error) {
        const std::string what = error.what();
        packtrace::fuzz::require(what.find('\n') == std::string::npos, "a message is one line");
    }
}
