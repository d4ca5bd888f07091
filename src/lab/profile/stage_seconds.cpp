#include "lab/profile/stage_seconds.hpp"

#include <algorithm>
#include <cstddef>

namespace packtrace {
namespace {

// Whose work it is, in the order of printing.
enum Rays : std::size_t { camera, reflected, refracted, shadow, hits, rays_count };

constexpr const char* rays_names[] = {"camera", "reflected", "refracted", "shadow", "hits"};

constexpr const char* part_names[] = {
    "beams and what they may meet",
    "ray generation",
    "traversal of boxes",
    "spheres",
    "anchored spheres",
    "planes",
    "quadrics",
    "polygons",
    "unsure rays again in double",
    "compaction of hits",
    "normals and materials",
    "diffuse light",
    "highlight powers",
    "child rays",
    "pixels",
};
static_assert(std::size(part_names) == abi::part_count);

// Whose a span is that is not traced for secondary rays.
Rays rays_of(abi::Span span, abi::Role role)
{
    if (role == abi::Role::shadow || span == abi::Span::shadows)
        return shadow;
    return span == abi::Span::setup || span == abi::Span::trace ? camera : hits;
}

// Ticks of a reading of the clock taken off for each: it waits, so that all of them are its own.
double without_readings(const abi::Lap& lap, std::uint64_t reading)
{
    return std::max(0.0, static_cast<double>(lap.ticks) - static_cast<double>(lap.reads * reading));
}

double total_of(const abi::PartLaps& laps, int span, std::uint64_t reading)
{
    double sum = 0.0;
    for (const auto& role : laps.part[span])
        for (const abi::Lap& lap : role)
            sum += without_readings(lap, reading);
    return sum;
}

}  // namespace

StageSeconds::StageSeconds(int generations) : generations_(static_cast<std::size_t>(generations))
{
}

void StageSeconds::add(const std::vector<SpanTicks>& spans, const std::vector<abi::PartLaps>& parts,
                       std::uint64_t reading)
{
    for (std::size_t depth = 0; depth < generations_.size(); ++depth)
        for (int span = 0; span < abi::span_count; ++span) {
            // A span too short for its clock is divided as it was read.
            const bool is_clocked = total_of(parts[depth], span, reading) > 0.0;
            const std::uint64_t taken_off = is_clocked ? reading : 0;
            const double total = total_of(parts[depth], span, taken_off);
            if (total <= 0.0)
                continue;
            const double scale = spans[depth].span[static_cast<std::size_t>(span)] / total;
            for (int role = 0; role < abi::role_count; ++role)
                for (int part = 0; part < abi::part_count; ++part)
                    add_part(
                        depth, rays_of(static_cast<abi::Span>(span), static_cast<abi::Role>(role)),
                        static_cast<std::size_t>(part), spans[depth].refracted,
                        scale * without_readings(parts[depth].part[span][role][part], taken_off));
        }
}

// Tracing after the first generation is for reflected and refracted rays.
void StageSeconds::add_part(std::size_t depth, std::size_t rays, std::size_t part,
                            double refracted_share, double seconds)
{
    if (rays != camera || depth == 0) {
        generations_[depth][rays][part] += seconds;
        return;
    }
    generations_[depth][refracted][part] += seconds * refracted_share;
    generations_[depth][reflected][part] += seconds * (1.0 - refracted_share);
}

std::vector<KernelStage> StageSeconds::stages() const
{
    std::vector<KernelStage> result;
    for (std::size_t depth = 0; depth < generations_.size(); ++depth)
        for (std::size_t rays = 0; rays < rays_count; ++rays)
            for (std::size_t part = 0; part < abi::part_count; ++part)
                if (const double seconds = generations_[depth][rays][part]; seconds > 0.0)
                    result.push_back(
                        {static_cast<int>(depth), rays_names[rays], part_names[part], seconds});
    return result;
}

}  // namespace packtrace
