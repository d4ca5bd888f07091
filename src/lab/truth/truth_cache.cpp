#include "lab/truth/truth_cache.hpp"

#include <cstdint>
#include <cstring>
#include <limits>
#include <sstream>
#include <string_view>

#if defined(__GLIBC__)
#include <gnu/libc-version.h>
#endif

#include "core/atomic_file.hpp"
#include "core/checksum.hpp"
#include "core/read_file.hpp"
#include "lab/harness/machine.hpp"
#include "render/option_words.hpp"
#include <packtrace/render.hpp>
#include <packtrace/version.hpp>
#include <packtrace/write_scene.hpp>

namespace packtrace {
namespace {

std::string c_library()
{
#if defined(__GLIBC__)
    return std::string("glibc ") + gnu_get_libc_version();
#else
    return "another C library";
#endif
}

template <class Real>
std::string with_bits(const char* name)
{
    return std::string(name) + " of " + std::to_string(std::numeric_limits<Real>::digits) + " bits";
}

constexpr const char* magic = "packtrace-truth-2";

std::string_view bytes_of(const Image<double>::Pixels& values)
{
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
}

}  // namespace

std::string TruthKey::text() const
{
    return "packtrace " + version + "\nsources " + sources + "\ncompiler " + compiler +
           "\nmachine " + machine + "\nprecision " + precision + "\nself-hits " + self_hits +
           "\nsamples " + std::to_string(samples) + '\n' + scene;
}

TruthKey truth_key(const Scene& scene, int samples)
{
    return {.version = PACKTRACE_VERSION_STRING,
            .sources = built_sources,
            .compiler = compiler_name() + ' ' + kernel_flags,
            .machine = processor_name() + ", " + c_library(),
            .precision =
                samples > 1 ? with_bits<double>("double") : with_bits<long double>("long double"),
            .self_hits = std::string(language::word_of(default_self_hits)),
            .samples = samples,
            .scene = scene_text(scene)};
}

void write_truth(const std::filesystem::path& file, const std::string& key, const Truth& truth)
{
    std::ostringstream head;
    head << truth.image.width << ' ' << truth.image.height << ' ' << truth.seconds << ' '
         << key.size() << '\n';
    const std::string checked = head.str() + key + std::string(bytes_of(truth.image.rgb));
    AtomicFile output(file);
    output.write(std::string(magic) + ' ' + std::to_string(text_hash(checked)) + '\n');
    output.write(checked);
    output.commit();
}

std::optional<Truth> read_truth(const std::filesystem::path& file, const std::string& key)
{
    std::string bytes;
    try {
        bytes = read_file(file);
    } catch (const FileError&) {
        return std::nullopt;
    }
    std::istringstream head(bytes);
    std::string word;
    std::uint64_t hash = 0;
    if (!(head >> word >> hash) || word != magic || head.get() != '\n' ||
        text_hash(std::string_view(bytes).substr(static_cast<std::size_t>(head.tellg()))) != hash)
        return std::nullopt;
    int width = 0;
    int height = 0;
    std::size_t key_size = 0;
    Truth truth;
    if (!(head >> width >> height >> truth.seconds >> key_size) || head.get() != '\n' ||
        width < 1 || height < 1)
        return std::nullopt;
    std::string_view data = std::string_view(bytes).substr(static_cast<std::size_t>(head.tellg()));
    if (key_size != key.size() || !data.starts_with(key))
        return std::nullopt;
    data.remove_prefix(key_size);
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    constexpr std::size_t pixel_bytes = 3 * sizeof(double);
    // By division: a file may name sizes whose product overflows.
    if (data.size() % pixel_bytes != 0 || data.size() / pixel_bytes != pixels)
        return std::nullopt;
    truth.image = Image<double>(width, height);
    std::memcpy(truth.image.rgb.data(), data.data(), data.size());
    truth.cached = true;
    return truth;
}

}  // namespace packtrace
