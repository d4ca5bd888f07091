#include "lab/truth/truth_file.hpp"

#include <cstdint>
#include <cstring>
#include <sstream>
#include <string_view>

#include "core/atomic_file.hpp"
#include "core/read_file.hpp"
#include "core/text_hash.hpp"

namespace packtrace {
namespace {

constexpr const char* magic = "packtrace-truth-1";

std::string_view bytes_of(const Image<double>::Pixels& values)
{
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
}

}  // namespace

void write_truth(const std::filesystem::path& file, const Truth& truth)
{
    const std::string_view bytes = bytes_of(truth.image.rgb);
    std::ostringstream head;
    head << magic << ' ' << truth.image.width << ' ' << truth.image.height << ' ' << truth.seconds
         << ' ' << text_hash(bytes) << '\n';
    AtomicFile output(file);
    output.write(std::string_view(head.str()));
    output.write(bytes);
    output.commit();
}

std::optional<Truth> read_truth(const std::filesystem::path& file)
{
    std::string bytes;
    try {
        bytes = read_file(file);
    } catch (const FileError&) {
        return std::nullopt;
    }
    const std::size_t end = bytes.find('\n');
    std::istringstream head(bytes.substr(0, end));
    std::string word;
    int width = 0;
    int height = 0;
    std::uint64_t hash = 0;
    Truth truth;
    if (!(head >> word >> width >> height >> truth.seconds >> hash) || word != magic || width < 1 ||
        height < 1)
        return std::nullopt;
    const std::string_view data = std::string_view(bytes).substr(end + 1);
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    constexpr std::size_t pixel_bytes = 3 * sizeof(double);
    // Not by multiplying: a file may name sizes whose product is beyond 64 bits.
    if (data.size() % pixel_bytes != 0 || data.size() / pixel_bytes != pixels ||
        text_hash(data) != hash)
        return std::nullopt;
    truth.image = Image<double>(width, height);
    std::memcpy(truth.image.rgb.data(), data.data(), data.size());
    truth.cached = true;
    return truth;
}

}  // namespace packtrace
