// The bit-sliced solver. Systems of about the same length form groups, whose surfaces the kernel
// takes as bit planes.
#include "onedim/solvers.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <span>

namespace packtrace::onedim {
namespace {

// All lengths of at least this many words share a bucket.
constexpr std::size_t longest_bucket = 1024;

std::size_t bucket(std::span<const Surface> system)
{
    return std::min((system.size() + 7) / 8, longest_bucket);
}

static_assert(std::endian::native == std::endian::little, "a word's low byte is its first surface");

constexpr std::size_t word_surfaces = abi::onedim_tile_surfaces;

// Eight surfaces from `first` on. Behind the last one come zeros: black surfaces that face the eye
// return None, like empty space.
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

// Eight systems side by side fill a cache line of each tile at once. Tiles lie 4 KiB apart, so that
// their lines compete for the same places in the cache.
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

/// Systems that are solved together, each in one bit of a register. They are read a run of surfaces
/// at a time, from the far end, so that the memory does not depend on their length.
class Group {
public:
    explicit Group(const abi::OnedimTable& kernel);

    /// How many systems a group may hold.
    [[nodiscard]] std::size_t capacity() const;

    /// Writes L0 of systems[k] to answers[k] for every k of `members`, at most `capacity()`.
    void solve(const Systems& systems, std::span<const std::uint32_t> members,
               std::span<Intensity> answers);

private:
    static constexpr std::size_t run_tiles = 8;   ///< 32 kB with the widest registers
    static constexpr std::size_t most_words = 8;  ///< of a plane, on any instruction set

    void gather(const Systems& systems, std::span<const std::uint32_t> members, std::size_t first,
                std::size_t tiles);
    void scatter(std::span<const std::uint32_t> members, std::span<Intensity> answers) const;

    const abi::OnedimTable& kernel_;
    std::size_t words_;  ///< of a plane
    alignas(64) std::array<std::uint64_t, run_tiles * 64 * most_words> planes_;
    alignas(64) std::array<std::uint64_t, abi::onedim_state_planes * most_words> state_;
};

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

}  // namespace

std::vector<std::uint32_t> order_by_length(const Systems& systems)
{
    // A counting sort: count the systems of each length, then find the first index of each length.
    std::array<std::uint32_t, longest_bucket + 1> next{};
    for (std::size_t k = 0; k < systems.size(); ++k)
        ++next[bucket(systems[k])];
    std::exclusive_scan(next.begin(), next.end(), next.begin(), std::uint32_t{0});

    std::vector<std::uint32_t> order(systems.size());
    for (std::size_t k = 0; k < systems.size(); ++k)
        order[next[bucket(systems[k])]++] = static_cast<std::uint32_t>(k);
    return order;
}

void solve_bitsliced(const Systems& systems, const abi::OnedimTable& kernel,
                     std::span<Intensity> answers)
{
    const std::vector<std::uint32_t> order = order_by_length(systems);
    Group group(kernel);
    for (std::span<const std::uint32_t> rest = order; !rest.empty();) {
        const std::size_t count = std::min(rest.size(), group.capacity());
        group.solve(systems, rest.first(count), answers);
        rest = rest.subspan(count);
    }
}

}  // namespace packtrace::onedim
