#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace packtrace {

/// The bits of a byte stream, the lowest of each byte first; zeros follow its end.
class BitCursor {
public:
    explicit BitCursor(std::span<const std::uint8_t> stream)
        : bytes_(stream.begin(), stream.end()), end_(8 * stream.size())
    {
        bytes_.resize(bytes_.size() + sizeof(std::uint64_t));
    }

    /// The next bits, of which the lowest 57 are sure to be there.
    [[nodiscard]] std::uint64_t peek() const
    {
        // Compilers make one load of this.
        const std::uint8_t* at = bytes_.data() + position_ / 8;
        std::uint64_t word = 0;
        for (unsigned i = 0; i < sizeof word; ++i)
            word |= std::uint64_t{at[i]} << 8 * i;
        return word >> position_ % 8;
    }
    std::uint32_t take(unsigned count)
    {
        const std::uint64_t bits = peek() & ((std::uint64_t{1} << count) - 1);
        skip(count);
        return static_cast<std::uint32_t>(bits);
    }
    /// Throws std::logic_error when it leaves the stream.
    void skip(std::size_t bits)
    {
        position_ += bits;
        if (position_ > end_)
            throw std::logic_error("a deflate stream ends early");
    }
    void align()
    {
        skip((8 - position_ % 8) % 8);
    }
    /// In bits from the start.
    [[nodiscard]] std::size_t position() const
    {
        return position_;
    }

private:
    std::vector<std::uint8_t> bytes_;
    std::size_t end_;
    std::size_t position_ = 0;
};

}  // namespace packtrace
