#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

// How pieces of work are handed out and come together again, without a word about MPI: what ranks
// do, and what the model of scaling (bench/cluster) does.
namespace packtrace::mpi {

/// Finished pieces that a rank may have on their way before it begins another.
inline constexpr int most_on_their_way = 2;

/// Memory of rank 0 for pieces that came before their turn.
inline constexpr std::size_t window_bytes = std::size_t{256} << 20;

/// How many pieces from the next one on may come to rank 0, whatever their order.
[[nodiscard]] inline int window_of(int ranks, std::size_t piece_bytes)
{
    const std::size_t room = window_bytes / std::max<std::size_t>(piece_bytes, 1);
    const auto wanted = static_cast<std::size_t>(ranks) * (most_on_their_way + 1);
    return static_cast<int>(std::clamp<std::size_t>(room, 4, wanted + 4));
}

/// Pieces that come in any order and leave in their own. Ranks take the next number of a shared
/// counter, so that the pieces at work are never far apart; one that comes too early waits with its
/// sender.
class PieceWindow {
public:
    PieceWindow(int count, int window) : window_(window), here_(static_cast<std::size_t>(count), 0)
    {
    }

    [[nodiscard]] int count() const
    {
        return static_cast<int>(here_.size());
    }
    /// The first that has not left, and the end of those that may come.
    [[nodiscard]] int first() const
    {
        return first_;
    }
    [[nodiscard]] int end() const
    {
        return std::min(count(), first_ + window_);
    }
    /// Whether a piece may come now.
    [[nodiscard]] bool admits(int piece) const
    {
        return piece >= first_ && piece < end() && !here_[static_cast<std::size_t>(piece)];
    }
    void arrive(int piece)
    {
        here_[static_cast<std::size_t>(piece)] = 1;
    }
    /// Whether the first is here and may leave.
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
