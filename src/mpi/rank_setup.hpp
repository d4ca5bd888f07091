#pragma once

#include <string>
#include <vector>

namespace packtrace::mpi {

/// The properties of a rank that the bits of its results depend on.
struct RankSetup {
    std::string version;
    bool fma = true;  ///< its packets use fused multiply-add

    [[nodiscard]] std::string text() const
    {
        return version + (fma ? " fma" : " no fma");
    }
};

enum class Mixing { refused, allowed };

/// Why ranks with these setups may not work on one result, in one line; empty if they may.
[[nodiscard]] inline std::string why_not_together(const std::vector<std::string>& setups,
                                                  Mixing mixing)
{
    const auto version = [](const std::string& setup) { return setup.substr(0, setup.find(' ')); };
    for (std::size_t rank = 1; rank < setups.size(); ++rank) {
        const std::string& first = setups.front();
        const std::string& other = setups[rank];
        const std::string ranks = "packtrace-mpi: rank " + std::to_string(rank);
        if (version(first) != version(other))
            return ranks + " is version " + version(other) + " and rank 0 is version " +
                   version(first) + "; install one version on all machines";
        if (first != other && mixing == Mixing::refused)
            return ranks +
                   " and rank 0 differ in fused multiply-add, and so would their bits; give "
                   "--isa sse42 to all, or --allow-mixed";
    }
    return {};
}

/// Why ranks with these instruction sets may not share a study, in one line; empty if they may.
[[nodiscard]] inline std::string why_rows_differ(const std::vector<std::string>& isas)
{
    for (std::size_t rank = 1; rank < isas.size(); ++rank)
        if (isas[rank] != isas.front())
            return "packtrace-mpi: rank " + std::to_string(rank) + " runs " + isas[rank] +
                   " and rank 0 runs " + isas.front() +
                   ", and so would their rows differ; use machines of one kind";
    return {};
}

/// A rank's arguments without those that may differ between ranks, because they depend on the
/// processor.
[[nodiscard]] inline std::string shared_arguments(const std::vector<std::string>& arguments)
{
    std::string shared;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& word = arguments[i];
        const std::string name = word.substr(0, word.find('='));
        if (name != "--isa" && name != "--width" && name != "--threads")
            shared += word + '\n';
        else if (name == word)
            ++i;  // its value
    }
    return shared;
}

/// Why ranks with these shared arguments may not work together, in one line; empty if they may.
[[nodiscard]] inline std::string why_arguments_differ(const std::vector<std::string>& arguments)
{
    for (std::size_t rank = 1; rank < arguments.size(); ++rank)
        if (arguments[rank] != arguments.front())
            return "rank " + std::to_string(rank) +
                   " and rank 0 have different arguments; give all ranks the same, except for "
                   "--isa, --width and --threads";
    return {};
}

}  // namespace packtrace::mpi
