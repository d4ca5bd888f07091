// A writer of its own, because stb_image_write with libdeflate runs on one thread, and so costs
// more than a rendering on two (10.5 ms to 8 at 1024 x 1024, results/png.json). Here bands of
// rows are rounded, filtered and compressed in parallel, each an IDAT chunk of its own.
#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "image/deflate_piece.hpp"
#include "image/png.hpp"
#include "image/png_chunk.hpp"
#include "image/quantise.hpp"

namespace packtrace {
namespace {

// Enough bands for several threads, each long enough for the compressor to find its matches.
constexpr std::size_t band_bytes = std::size_t{1} << 18;

struct Band {
    Bytes chunk;
    std::uint32_t adler = 1;
    std::size_t length = 0;  // of the filtered rows
};

Bytes header_chunk(int width, int height)
{
    PngChunk chunk("IHDR");
    chunk.append_number(static_cast<std::size_t>(width));
    chunk.append_number(static_cast<std::size_t>(height));
    // 8 bits, RGB, deflate, the five filters, not interlaced
    chunk.append(std::array<std::uint8_t, 5>{8, 2, 0, 0, 0});
    return std::move(chunk).finish();
}

// Rows `first` to `last` - 1, each rounded to bytes, filtered and led by its filter's number.
template <class Real>
Bytes filtered_rows(const Image<Real>& image, int first, int last, const PngSettings& settings)
{
    const std::size_t length = 3 * static_cast<std::size_t>(image.width);
    Bytes above(length);
    Bytes row(length);
    if (first > 0)
        quantise(std::span(image.pixel(0, first - 1), length), settings.gamma, above.data());
    Bytes rows((length + 1) * static_cast<std::size_t>(last - first));
    std::uint8_t* to = rows.data();
    for (int y = first; y < last; ++y, to += length + 1) {
        quantise(std::span(image.pixel(0, y), length), settings.gamma, row.data());
        to[0] = static_cast<std::uint8_t>(settings.filter);
        filter_row(settings.filter, row, above.data(), to + 1);
        std::swap(row, above);
    }
    return rows;
}

Band encode_band(const Bytes& rows, bool first, DeflatePieces& deflate)
{
    PngChunk chunk("IDAT");
    // The zlib header: a window of 32 KiB, the quickest compression.
    if (first)
        chunk.append(std::array<std::uint8_t, 2>{0x78, 0x01});
    deflate.append(rows, chunk.data());
    return {std::move(chunk).finish(), libdeflate_adler32(1, rows.data(), rows.size()),
            rows.size()};
}

template <class Real>
std::vector<Band> encode_bands(const Image<Real>& image, const PngSettings& settings)
{
    const int rows = std::max(1, static_cast<int>(band_bytes / 3) / image.width);
    const int count = (image.height - 1) / rows + 1;
    std::vector<Band> bands(static_cast<std::size_t>(count));
    tbb::enumerable_thread_specific<DeflatePieces> deflate(settings.level);
    tbb::parallel_for(tbb::blocked_range<int>(0, count, 1), [&](const auto& range) {
        for (int i = range.begin(); i != range.end(); ++i)
            bands[static_cast<std::size_t>(i)] = encode_band(
                filtered_rows(image, i * rows, std::min(image.height, (i + 1) * rows), settings),
                i == 0, deflate.local());
    });
    return bands;
}

// What ends the compressed rows: the last block and the checksum of all.
Bytes last_data_chunk(const std::vector<Band>& bands)
{
    std::uint32_t adler = 1;
    for (const Band& band : bands)
        adler = join_adler32(adler, band.adler, band.length);
    PngChunk chunk("IDAT");
    chunk.append(last_deflate_piece());
    chunk.append_number(adler);
    return std::move(chunk).finish();
}

// The keyword of the text chunk, and the zero byte after it.
constexpr std::string_view recipe_keyword("packtrace recipe\0", 17);

Bytes recipe_chunk(std::string_view recipe)
{
    PngChunk chunk("tEXt");
    for (const std::string_view text : {recipe_keyword, recipe})
        chunk.append({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    return std::move(chunk).finish();
}

}  // namespace

template <class Real>
Bytes encode_png(const Image<Real>& image, const PngSettings& settings)
{
    if (!(settings.gamma > 0.0) || std::isinf(settings.gamma))
        throw std::invalid_argument("gamma must be positive and finite");
    Bytes file{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    const auto append = [&file](const Bytes& bytes) {
        file.insert(file.end(), bytes.begin(), bytes.end());
    };
    append(header_chunk(image.width, image.height));
    if (!settings.recipe.empty())
        append(recipe_chunk(settings.recipe));
    const std::vector<Band> bands = encode_bands(image, settings);
    for (const Band& band : bands)
        append(band.chunk);
    append(last_data_chunk(bands));
    append(PngChunk("IEND").finish());
    return file;
}

template Bytes encode_png(const Image<float>&, const PngSettings&);
template Bytes encode_png(const Image<double>&, const PngSettings&);
template Bytes encode_png(const Image<long double>&, const PngSettings&);

// It stands right after the header: 8 bytes of signature, 25 of the header's chunk.
std::string png_recipe(std::span<const std::uint8_t> file)
{
    constexpr std::size_t chunk_at = 8 + 25;
    constexpr std::size_t text_at = chunk_at + 8;
    if (file.size() < text_at)
        return {};
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i)
        length = length << 8 | file[chunk_at + i];
    if (length > file.size() - text_at)
        return {};
    const std::string_view type(reinterpret_cast<const char*>(file.data()) + chunk_at + 4, 4);
    const std::string_view text(reinterpret_cast<const char*>(file.data()) + text_at, length);
    if (type != "tEXt" || !text.starts_with(recipe_keyword))
        return {};
    return std::string(text.substr(recipe_keyword.size()));
}

}  // namespace packtrace
