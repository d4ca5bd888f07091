#pragma once

#include "render/option_words.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/render.hpp>

#include <string>
#include <vector>

// The ways in which a scene is traced.
namespace packtrace::lab {

/// Threads of half of the ways to render.
inline constexpr int soak_threads = 3;

/// A way to trace rays: precision and options.
struct SoakWay {
    Precision precision = Precision::single;
    RenderOptions options;
};

/// The options of `packtrace intersect` for a way.
[[nodiscard]] inline std::string intersect_words(const SoakWay& way)
{
    const RenderOptions& options = way.options;
    std::string words = " --precision " + std::string(language::word_of(way.precision));
    if (options.kernel == Kernel::scalar)
        return words + " --kernel scalar";
    words += " --isa " + options.isa;
    words.append(" --traversal ").append(language::word_of(options.traversal));
    if (way.precision == Precision::single)
        words.append(" --accuracy ").append(language::word_of(options.accuracy));
    return words + (options.self_hits == SelfHits::note ? " --self-hits note" : "");
}

/// The options of `packtrace render` for a way.
[[nodiscard]] inline std::string render_words(const SoakWay& way)
{
    std::string words = intersect_words(way);
    if (way.options.force_general)
        words += " --force-general";
    return words + " --threads " + std::to_string(way.options.threads);
}

/// The scalar kernel.
[[nodiscard]] inline SoakWay scalar_way(Precision precision, SelfHits self_hits)
{
    SoakWay way;
    way.precision = precision;
    way.options.kernel = Kernel::scalar;
    way.options.self_hits = self_hits;
    way.options.threads = 1;
    return way;
}

/// Ways that must give the same bits.
struct SoakGroup {
    std::vector<SoakWay> ways;  ///< the first has the fewest options
};

[[nodiscard]] inline bool has_fused_operations(const IsaInfo& isa)
{
    return isa.name != "sse42";
}

[[nodiscard]] inline std::vector<SoakWay> ways_of(const IsaInfo& isa, const SoakWay& plain)
{
    std::vector<SoakWay> ways;
    for (const Traversal traversal : {Traversal::list, Traversal::tree})
        for (const bool general : {false, true}) {
            SoakWay way = plain;
            way.options.isa = isa.name;
            way.options.traversal = traversal;
            way.options.force_general = general;
            way.options.threads = general ? soak_threads : 1;
            ways.push_back(way);
        }
    return ways;
}

/// All ways with packets of one precision and accuracy: every instruction set of this machine,
/// lists and BVH, special and general kernel, one thread and several. Instruction sets with fused
/// multiply-add form one group, each other one a group of its own.
[[nodiscard]] inline std::vector<SoakGroup> packet_groups(Precision precision, Accuracy accuracy,
                                                          SelfHits self_hits)
{
    SoakWay plain;
    plain.precision = precision;
    plain.options.accuracy = accuracy;
    plain.options.self_hits = self_hits;
    SoakGroup fused;
    std::vector<SoakGroup> groups;
    for (const IsaInfo& isa : list_isas()) {
        if (!isa.supported)
            continue;
        const std::vector<SoakWay> ways = ways_of(isa, plain);
        if (has_fused_operations(isa))
            fused.ways.insert(fused.ways.end(), ways.begin(), ways.end());
        else
            groups.push_back({ways});
    }
    if (!fused.ways.empty())
        groups.insert(groups.begin(), fused);
    return groups;
}

}  // namespace packtrace::lab
