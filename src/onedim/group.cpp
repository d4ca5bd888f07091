#include "onedim/group.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

namespace packtrace::onedim {
namespace {

static_assert(std::endian::native == std::endian::little, "a word's low byte is its first surface");

constexpr std::size_t word_surfaces = abi::onedim_tile_surfaces;

// Eight surfaces from `first` on. Behind the last one stand zeros, black surfaces that face the
// eye: they return None, as does the empty space they stand for.
std::uint64_t word_at(std::span<const Surface> system, std::size_t first)
{
    std::uint64_t word = 0;
    const std::size_t rest = first < system.size() ? system.size() - first : 0;
    if (rest >= word_surfaces) {
        std::memcpy(&word, system.data() + first, word_surfaces);
    } else if (rest > 0 && system.size() >= word_surfaces) {
        std::memcpy(&word, system.data() + system.size() - word_surfaces, word_surfaces);
        word >>= 8 * (word_surfaces - rest);
    } else if (rest > 0) {
        std::memcpy(&word, system.data() + first, rest);
    }
    return word;
}

// Eight systems side by side fill a cache line of one tile before it is the next tile's turn:
// tiles lie 4 KiB apart, where the lines of all of them compete for the same places in the cache.
using Side = std::array<std::span<const Surface>, 8>;

void copy_words(std::span<const std::span<const Surface>> side, std::size_t first,
                std::size_t tiles, std::size_t tile_words, std::uint64_t* to)
{
    std::size_t shortest = side[0].size();
    for (const std::span<const Surface> system : side)
        shortest = std::min(shortest, system.size());
    for (std::size_t tile = 0; tile < tiles; ++tile, to += tile_words, first += word_surfaces) {
        const bool whole = first + word_surfaces <= shortest;
        for (std::size_t i = 0; i < side.size(); ++i)
            if (whole)
                std::memcpy(to + i, side[i].data() + first, word_surfaces);
            else
                to[i] = word_at(side[i], first);
    }
}

}  // namespace

Group::Group(const abi::OnedimTable& kernel)
    : kernel_(kernel), words_(static_cast<std::size_t>(kernel.words))
{
    assert(words_ <= most_words);
}

std::size_t Group::capacity() const
{
    return 64 * words_;
}

void Group::gather(const Systems& systems, std::span<const std::uint32_t> members,
                   std::size_t first, std::size_t tiles)
{
    if (members.size() < capacity())
        std::fill_n(planes_.begin(), tiles * capacity(), 0);
    Side side;
    for (std::size_t m = 0; m < members.size(); m += side.size()) {
        const std::size_t count = std::min(side.size(), members.size() - m);
        for (std::size_t i = 0; i < count; ++i)
            side[i] = systems[members[m + i]];
        copy_words(std::span(side).first(count), first, tiles, capacity(), planes_.data() + m);
    }
}

void Group::scatter(std::span<const std::uint32_t> members, std::span<Intensity> answers) const
{
    std::size_t m = 0;
    for (std::size_t bit = 0; m < members.size(); ++bit)
        for (std::size_t word = 0; word < words_ && m < members.size(); ++word, ++m) {
            const std::uint64_t some = state_[word] >> bit & 1;
            const std::uint64_t all = state_[words_ + word] >> bit & 1;
            answers[members[m]] = static_cast<Intensity>(some + all);
        }
}

void Group::solve(const Systems& systems, std::span<const std::uint32_t> members,
                  std::span<Intensity> answers)
{
    assert(members.size() <= capacity());
    std::size_t longest = 0;
    for (const std::uint32_t k : members)
        longest = std::max(longest, systems[k].size());

    state_.fill(0);
    std::size_t tiles_left = (longest + word_surfaces - 1) / word_surfaces;
    while (tiles_left > 0) {
        const std::size_t tiles = std::min(tiles_left, run_tiles);
        tiles_left -= tiles;
        gather(systems, members, tiles_left * word_surfaces, tiles);
        kernel_.transpose(planes_.data(), tiles);
        kernel_.solve({planes_.data(), tiles * word_surfaces, state_.data()});
    }
    scatter(members, answers);
}

}  // namespace packtrace::onedim
