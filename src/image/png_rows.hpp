#pragma once

#include <functional>
#include <memory>
#include <span>

#include "image/bytes.hpp"

namespace packtrace {

/// An 8-bit RGB PNG file made by libpng row by row. It holds one row at a time.
class PngRows {
public:
    /// Takes the file's bytes as they come, in order. What it throws comes out of the call that
    /// made them.
    using Take = std::function<void(std::span<const std::uint8_t>)>;

    PngRows(int width, int height, Take take);
    ~PngRows();
    PngRows(const PngRows&) = delete;
    PngRows& operator=(const PngRows&) = delete;

    /// The next row, 3 bytes a pixel.
    void write(const std::uint8_t* row);
    /// After the last row.
    void finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Gives row `y` of a picture as 3 bytes a pixel.
using GiveRow = std::function<void(int y, std::uint8_t* row)>;

/// The file in memory.
[[nodiscard]] Bytes encode_png_rows(int width, int height, const GiveRow& give_row);

}  // namespace packtrace
