// Radiance pictures. stb_image_write encodes them, one row at a time. The decoder is our own,
// because stb_image before version 2.28 never returns from a truncated file.
#include "image/formats.hpp"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace packtrace {
namespace {

void append(void* file, void* data, int size)
{
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    auto& to = *static_cast<Bytes*>(file);
    to.insert(to.end(), bytes, bytes + size);
}

// The format has exponents up to 2^127. Comparisons with NaN are false, which makes it 0.
float clamp_to_rgbe(float value)
{
    constexpr float largest = 0x1.fffffep126f;
    const float positive = value > 0.0f ? value : 0.0f;
    return positive < largest ? positive : largest;
}

// Reads a file from front to back. It is an error if the file ends early.
class Cursor {
public:
    explicit Cursor(std::span<const std::uint8_t> file) : rest_(file)
    {
    }

    std::span<const std::uint8_t> take(std::size_t count)
    {
        if (count > rest_.size())
            throw ImageError("damaged HDR picture: the file ends early");
        const auto taken = rest_.first(count);
        rest_ = rest_.subspan(count);
        return taken;
    }

    std::string line()
    {
        const auto end = std::find(rest_.begin(), rest_.end(), '\n');
        const auto text = take(static_cast<std::size_t>(end - rest_.begin()));
        take(1);
        return {text.begin(), text.end()};
    }

    [[nodiscard]] std::span<const std::uint8_t> rest() const
    {
        return rest_;
    }

private:
    std::span<const std::uint8_t> rest_;
};

struct Size {
    int width = 0;
    int height = 0;
};

struct HdrHeader {
    Size size;
    float exposure = 1.0f;  // factor of the values in the file
};

constexpr std::string_view format_key = "FORMAT=";
constexpr std::string_view exposure_key = "EXPOSURE=";

void check_format(const std::string& format)
{
    if (format != "32-bit_rle_rgbe")
        throw ImageError("HDR pixels of the kind " + format + " are not supported");
}

double parse_exposure(const std::string& text)
{
    std::istringstream number(text);
    number.imbue(std::locale::classic());
    double exposure = 0.0;
    if (!(number >> exposure) || !(number >> std::ws).eof() || !(exposure > 0.0))
        throw ImageError("HDR exposure '" + text + "' is not a number above 0");
    return exposure;
}

/// The product of all exposures. Rejects a product that single precision cannot divide by.
float checked_exposure(double product)
{
    constexpr double least = std::numeric_limits<float>::min();
    constexpr double most = std::numeric_limits<float>::max();
    if (!(product >= least && product <= most))
        throw ImageError("the product of all HDR exposures is too large or too small");
    return static_cast<float>(product);
}

Size parse_resolution(const std::string& resolution)
{
    Size size;
    char end = 0;
    if (std::sscanf(resolution.c_str(), "-Y %9d +X %9d%c", &size.height, &size.width, &end) != 2 ||
        size.width < 1 || size.height < 1)
        throw ImageError("HDR size '" + resolution + "' is not of the form -Y height +X width");
    return size;
}

HdrHeader read_header(Cursor& file)
{
    const std::string magic = file.line();
    if (magic != "#?RADIANCE" && magic != "#?RGBE")
        throw ImageError("not a Radiance HDR file");
    // Each program that scales the picture adds a line with its exposure.
    double exposure = 1.0;
    for (std::string line = file.line(); !line.empty(); line = file.line())
        if (line.starts_with(format_key))
            check_format(line.substr(format_key.size()));
        else if (line.starts_with(exposure_key))
            exposure *= parse_exposure(line.substr(exposure_key.size()));
    const Size size = parse_resolution(file.line());
    return {size, checked_exposure(exposure)};
}

void check_run(bool fits)
{
    if (!fits)
        throw ImageError("damaged HDR picture: a run does not fit its row");
}

// Below, `put(x, component, byte)` receives the bytes of a row: r, g, b and the exponent of each
// pixel.

// Four sequences of bytes, one per component. A count above 128 repeats one byte.
template <class Put>
void read_packed_row(Cursor& file, std::size_t width, const Put& put)
{
    for (std::size_t component = 0; component < 4; ++component)
        for (std::size_t x = 0; x < width;) {
            const std::size_t code = file.take(1)[0];
            const std::size_t count = code > 128 ? code - 128 : code;
            check_run(count > 0 && count <= width - x);
            const auto bytes = file.take(code > 128 ? 1 : count);
            for (std::size_t i = 0; i < count; ++i, ++x)
                put(x, component, bytes[code > 128 ? 0 : i]);
        }
}

// Whole pixels. The pixel (1, 1, 1, n) is a run: it repeats the pixel before it n times. Runs
// without another pixel between them are the digits of one count, to base 256, the lowest first.
template <class Put>
void read_plain_row(Cursor& file, std::size_t width, const Put& put)
{
    std::span<const std::uint8_t> last;
    std::size_t unit = 1;
    for (std::size_t x = 0; x < width;) {
        const auto pixel = file.take(4);
        const bool is_run = pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1;
        check_run(!is_run || (!last.empty() && pixel[3] <= (width - x) / unit));
        const std::size_t count = is_run ? pixel[3] * unit : 1;
        // A unit above every width leaves room for no further run.
        unit = !is_run ? 1 : unit <= width ? 256 * unit : unit;
        last = is_run ? last : pixel;
        for (std::size_t i = 0; i < count; ++i, ++x)
            for (std::size_t component = 0; component < 4; ++component)
                put(x, component, last[component]);
    }
}

template <class Put>
void read_row(Cursor& file, std::size_t width, const Put& put)
{
    const std::array<std::uint8_t, 4> packed{2, 2, static_cast<std::uint8_t>(width >> 8),
                                             static_cast<std::uint8_t>(width & 255)};
    const auto rest = file.rest();
    const bool may_be_packed = width >= 8 && width < 32768 && rest.size() >= 4;
    if (may_be_packed && std::equal(packed.begin(), packed.end(), rest.begin())) {
        file.take(4);
        read_packed_row(file, width, put);
    } else {
        read_plain_row(file, width, put);
    }
}

// Checks that the file has all rows and nothing else, before memory is allocated for them. A few
// bytes may encode a long row, so the size of the file does not tell.
void check_rows(Cursor file, const Size& size)
{
    const auto ignore = [](std::size_t, std::size_t, std::uint8_t) {};
    for (int y = 0; y < size.height; ++y)
        read_row(file, static_cast<std::size_t>(size.width), ignore);
    if (!file.rest().empty())
        throw ImageError("damaged HDR picture: the file goes on after its last row");
}

void expand(const std::uint8_t* rgbe, float exposure, float* rgb)
{
    const float unit = rgbe[3] == 0 ? 0.0f : std::ldexp(1.0f, rgbe[3] - (128 + 8));
    for (int c = 0; c < 3; ++c)
        rgb[c] = static_cast<float>(rgbe[c]) * unit / exposure;
}

}  // namespace

std::string hdr_header(int width, int height)
{
    return "#?RADIANCE\n# Written by stb_image_write.h\nFORMAT=32-bit_rle_rgbe\n"
           "EXPOSURE=          1.0000000000000\n\n-Y " +
           std::to_string(height) + " +X " + std::to_string(width) + "\n";
}

void append_hdr_row(Bytes& file, std::span<const float> row)
{
    std::vector<float> values(row.size());
    std::transform(row.begin(), row.end(), values.begin(), clamp_to_rgbe);
    const auto width = static_cast<int>(row.size() / 3);
    std::vector<unsigned char> scratch(4 * row.size() / 3);
    stbi__write_context context{};
    stbi__start_write_callbacks(&context, append, &file);
    stbiw__write_hdr_scanline(&context, width, 3, scratch.data(), values.data());
    stbiw__write_flush(&context);
}

Bytes encode_hdr(const Image<float>& image)
{
    const std::string header = hdr_header(image.width, image.height);
    Bytes file(header.begin(), header.end());
    const std::size_t row = 3 * static_cast<std::size_t>(image.width);
    for (int y = 0; y < image.height; ++y)
        append_hdr_row(file, {image.pixel(0, y), row});
    return file;
}

Image<float> decode_hdr(std::span<const std::uint8_t> bytes)
{
    Cursor file(bytes);
    const auto [size, exposure] = read_header(file);
    check_rows(file, size);
    Image<float> image(size.width, size.height);
    Bytes row(4 * static_cast<std::size_t>(size.width));
    const auto put = [&](std::size_t x, std::size_t component, std::uint8_t byte) {
        row[4 * x + component] = byte;
    };
    for (int y = 0; y < size.height; ++y) {
        read_row(file, static_cast<std::size_t>(size.width), put);
        for (int x = 0; x < size.width; ++x)
            expand(&row[4 * static_cast<std::size_t>(x)], exposure, image.pixel(x, y));
    }
    return image;
}

}  // namespace packtrace
