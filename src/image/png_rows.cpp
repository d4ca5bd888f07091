// Reads all PNG files with libpng, and writes those that are too large to be held as a whole.
#include "image/formats.hpp"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <utility>

namespace packtrace {
namespace {

// A byte of deflate encodes at most 1032 bytes.
constexpr std::size_t most_growth = 1040;

/// The state of libpng's functions. libpng reports errors by longjmp, which skips destructors, so
/// everything that owns memory is here.
struct PngState {
    png_structp png = nullptr;
    png_infop info = nullptr;
    char fault[200] = "";
    std::span<const std::uint8_t> unread;  ///< the part of the file that is not yet read
    Bytes samples;
    Image<float> image;
};

PngState& state_of(png_structp png)
{
    return *static_cast<PngState*>(png_get_error_ptr(png));
}

[[noreturn]] void jump_out(png_structp png, png_const_charp fault)
{
    std::strncpy(state_of(png).fault, fault, sizeof(PngState::fault) - 1);
    png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp)
{
}

void give_bytes(png_structp png, png_bytep to, std::size_t count)
{
    std::span<const std::uint8_t>& unread = state_of(png).unread;
    if (count > unread.size())
        png_error(png, "the file ends early");
    std::copy_n(unread.data(), count, to);
    unread = unread.subspan(count);
}

using Palette = std::span<const png_color>;

/// The picture's palette; empty if it has none.
Palette palette_of(png_structp png, png_infop info)
{
    png_colorp colors = nullptr;
    int count = 0;
    if (png_get_color_type(png, info) == PNG_COLOR_TYPE_PALETTE)
        png_get_PLTE(png, info, &colors, &count);
    return {colors, static_cast<std::size_t>(count)};
}

/// Makes libpng return rows of r, g, b with 8 or 16 bits, or of 8-bit indices of the palette.
/// libpng itself would turn an index beyond the palette into black.
void set_row_format(png_structp png, png_infop info, Palette palette)
{
    if (palette.empty()) {
        png_set_expand(png);
        png_set_strip_alpha(png);
        png_set_gray_to_rgb(png);
    } else {
        png_set_packing(png);
    }
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
}

void take_samples(const std::uint8_t* row, bool wide, std::span<float> to)
{
    for (std::size_t i = 0; i < to.size(); ++i)
        to[i] = wide ? static_cast<float>(row[2 * i] << 8 | row[2 * i + 1]) / 65535.0f
                     : static_cast<float>(row[i]) / 255.0f;
}

void take_indices(png_structp png, const std::uint8_t* row, Palette palette, std::span<float> to)
{
    for (std::size_t i = 0; i < to.size(); i += 3) {
        const std::size_t index = row[i / 3];
        if (index >= palette.size())
            png_error(png, "the colour of a pixel is not in the palette");
        const png_color& color = palette[index];
        to[i] = static_cast<float>(color.red) / 255.0f;
        to[i + 1] = static_cast<float>(color.green) / 255.0f;
        to[i + 2] = static_cast<float>(color.blue) / 255.0f;
    }
}

/// Rejects impossible sizes before memory is allocated.
void check_size(PngState& state)
{
    const std::size_t height = png_get_image_height(state.png, state.info);
    if (png_get_rowbytes(state.png, state.info) * height / most_growth > state.unread.size())
        png_error(state.png, "the file is too short for its size in pixels");
}

/// Reads the rows into `state.image`, which has the picture's size.
void read_all_rows(PngState& state, Palette palette)
{
    Image<float>& image = state.image;
    const std::size_t row_bytes = png_get_rowbytes(state.png, state.info);
    const bool wide = png_get_bit_depth(state.png, state.info) == 16;
    const bool interlaced = png_get_interlace_type(state.png, state.info) != PNG_INTERLACE_NONE;
    // An interlaced picture has seven passes, each over all its rows.
    state.samples.resize(interlaced ? row_bytes * static_cast<std::size_t>(image.height)
                                    : row_bytes);
    for (int pass = 0; pass < (interlaced ? PNG_INTERLACE_ADAM7_PASSES : 1); ++pass)
        for (int y = 0; y < image.height; ++y) {
            std::uint8_t* const row =
                state.samples.data() + (interlaced ? static_cast<std::size_t>(y) * row_bytes : 0);
            const std::span<float> to(image.pixel(0, y), 3 * static_cast<std::size_t>(image.width));
            png_read_row(state.png, row, nullptr);
            if (palette.empty())
                take_samples(row, wide, to);
            else
                take_indices(state.png, row, palette, to);
        }
}

void read_picture(PngState& state)
{
    png_read_info(state.png, state.info);
    check_size(state);
    const Palette palette = palette_of(state.png, state.info);
    set_row_format(state.png, state.info, palette);
    state.image = Image<float>(static_cast<int>(png_get_image_width(state.png, state.info)),
                               static_cast<int>(png_get_image_height(state.png, state.info)));
    read_all_rows(state, palette);
    png_read_end(state.png, nullptr);
}

/// Creates libpng's info struct. Throws std::bad_alloc.
void make_info(PngState& state)
{
    if (state.png != nullptr)
        state.info = png_create_info_struct(state.png);
    if (state.info == nullptr)
        throw std::bad_alloc();
}

/// Runs `use`. Its libpng errors become ImageErrors.
template <class Use>
void guard(PngState& state, const std::string& what, const Use& use)
{
    if (setjmp(png_jmpbuf(state.png)) != 0)
        throw ImageError(what + state.fault);
    use();
}

}  // namespace

Image<float> decode_png(std::span<const std::uint8_t> file)
{
    if (file.size() < 8 || png_sig_cmp(file.data(), 0, 8) != 0)
        throw ImageError("not a PNG file");
    PngState state;
    state.unread = file;
    state.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &state, jump_out, ignore_warning);
    const auto destroy = [](PngState* used) {
        png_destroy_read_struct(&used->png, &used->info, nullptr);
    };
    const std::unique_ptr<PngState, decltype(destroy)> owner(&state, destroy);
    make_info(state);
    png_set_read_fn(state.png, nullptr, give_bytes);
    guard(state, "damaged PNG: ", [&] { read_picture(state); });
    return std::move(state.image);
}

struct PngRows::State {
    PngState png;
    Take take;
    std::exception_ptr error;  ///< of `take`; exceptions must not pass through libpng

    ~State()
    {
        png_destroy_write_struct(&png.png, &png.info);
    }

    static void take_bytes(png_structp png, png_bytep from, std::size_t count)
    {
        State& state = *static_cast<State*>(png_get_io_ptr(png));
        try {
            state.take({from, count});
        } catch (...) {
            state.error = std::current_exception();
        }
        if (state.error)
            png_error(png, "");
    }

    template <class Use>
    void run(const Use& use)
    {
        try {
            guard(png, "can't be written as PNG: ", use);
        } catch (const ImageError&) {
            if (error)
                std::rethrow_exception(error);
            throw;
        }
    }
};

PngRows::PngRows(int width, int height, Take take) : state_(std::make_unique<State>())
{
    state_->take = std::move(take);
    PngState& state = state_->png;
    state.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &state, jump_out, ignore_warning);
    make_info(state);
    png_set_write_fn(state.png, state_.get(), State::take_bytes, nullptr);
    state_->run([&] {
        png_set_IHDR(state.png, state.info, static_cast<png_uint_32>(width),
                     static_cast<png_uint_32>(height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                     PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_filter(state.png, PNG_FILTER_TYPE_DEFAULT, PNG_FILTER_UP);
        png_set_compression_level(state.png, 1);
        png_write_info(state.png, state.info);
    });
}

PngRows::~PngRows() = default;

void PngRows::write(const std::uint8_t* row)
{
    state_->run([&] { png_write_row(state_->png.png, row); });
}

void PngRows::finish()
{
    state_->run([&] { png_write_end(state_->png.png, nullptr); });
}

Bytes encode_png_rows(int width, int height, const GiveRow& give_row)
{
    Bytes file;
    PngRows rows(width, height, [&](std::span<const std::uint8_t> bytes) {
        file.insert(file.end(), bytes.begin(), bytes.end());
    });
    Bytes row(3 * static_cast<std::size_t>(width));
    for (int y = 0; y < height; ++y) {
        give_row(y, row.data());
        rows.write(row.data());
    }
    rows.finish();
    return file;
}

}  // namespace packtrace
