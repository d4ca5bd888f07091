#pragma once

#include <packtrace/onedim.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "kernel_abi/onedim_table.hpp"

namespace packtrace::onedim {

/// Systems solved together, one bit of a register each, with memory that does not depend on
/// their length: a run of surfaces at a time, from the far end.
class Group {
public:
    explicit Group(const abi::OnedimTable& kernel);

    /// How many systems a group may hold.
    [[nodiscard]] std::size_t capacity() const;

    /// Writes L0 of systems[k] to answers[k] for every k of `members`, at most `capacity()`.
    void solve(const Systems& systems, std::span<const std::uint32_t> members,
               std::span<Intensity> answers);

private:
    static constexpr std::size_t run_tiles = 8;
    static constexpr std::size_t most_words = 8;  ///< of a plane, on any instruction set

    void gather(const Systems& systems, std::span<const std::uint32_t> members, std::size_t first,
                std::size_t tiles);
    void scatter(std::span<const std::uint32_t> members, std::span<Intensity> answers) const;

    const abi::OnedimTable& kernel_;
    std::size_t words_;  ///< of a plane
    alignas(64) std::array<std::uint64_t, run_tiles * 64 * most_words> planes_;
    alignas(64) std::array<std::uint64_t, abi::onedim_state_planes * most_words> state_;
};

}  // namespace packtrace::onedim
