#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

// How pieces of work are distributed and collected. It is independent of MPI, because the scaling
// model (bench/cluster) uses it, too.
namespace packtrace::mpi {

/// The largest number of finished pieces that a rank may be sending when it begins another.
inline constexpr int most_on_their_way = 2;

/// Memory of rank 0 for pieces that arrive before their turn.
inline constexpr std::size_t window_bytes = std::size_t{256} << 20;

/// The number of pieces, from the next one on, that may arrive at rank 0 in any order.
[[nodiscard]] inline int window_of(int ranks, std::size_t piece_bytes)
{
    const std::size_t room = window_bytes / std::max<std::size_t>(piece_bytes, 1);
    const auto wanted = static_cast<std::size_t>(ranks) * (most_on_their_way + 1);
    return static_cast<int>(std::clamp<std::size_t>(room, 4, wanted + 4));
}

/// Pieces that arrive in any order and leave in order of their numbers. Ranks take the next number
/// from a shared counter, so the pieces in progress have close numbers. A piece that is too early
/// waits at its sender.
class PieceWindow {
public:
    PieceWindow(int count, int window) : window_(window), here_(static_cast<std::size_t>(count), 0)
    {
    }

    [[nodiscard]] int count() const
    {
        return static_cast<int>(here_.size());
    }
    /// The first piece that has not left, and the end of the pieces that may arrive.
    [[nodiscard]] int first() const
    {
        return first_;
    }
    [[nodiscard]] int end() const
    {
        return std::min(count(), first_ + window_);
    }
    /// Whether a piece may arrive now.
    [[nodiscard]] bool admits(int piece) const
    {
        return piece >= first_ && piece < end() && !here_[static_cast<std::size_t>(piece)];
    }
    void arrive(int piece)
    {
        here_[static_cast<std::size_t>(piece)] = 1;
    }
    /// Whether the first piece has arrived and may leave.
    [[nodiscard]] bool ready() const
    {
        return first_ < count() && here_[static_cast<std::size_t>(first_)] != 0;
    }
    void leave()
    {
        ++first_;
    }
    [[nodiscard]] bool empty() const
    {
        return first_ == count();
    }

private:
    int window_;
    int first_ = 0;
    std::vector<std::uint8_t> here_;
};

}  // namespace packtrace::mpi
