#include "bvh/bvh.hpp"
#include "core/aligned_array.hpp"
#include "dispatch/kernels.hpp"
#include "lower/move_objects.hpp"
#include "lower/packed_scene.hpp"
#include "render/lit_scene.hpp"
#include "render/ray_backend.hpp"
#include "render/ray_pieces.hpp"
#include "scene/casting_objects.hpp"
#include <packtrace/isa.hpp>

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace packtrace {
namespace {

// Kernels count rays in int, so longer streams are split.
constexpr std::size_t longest_stream = std::size_t{1} << 20;

// All hits of a piece are gathered before they are sorted; short pieces limit that memory.
constexpr std::size_t longest_gathering = 256;

/// A refitted bvh is rebuilt if it costs more than this, relative to its cost when it was built.
constexpr double most_refit_cost = 1.5;

template <class Real>
abi::RaysView<Real> piece_of(const RaysView<Real>& rays, std::size_t first, std::size_t longest)
{
    const auto part = part_of(rays, first, std::min(rays.count - first, longest));
    return {{part.org_x, part.org_y, part.org_z},
            {part.dir_x, part.dir_y, part.dir_z},
            part.t_min,
            part.t_max,
            static_cast<int>(part.count)};
}

template <class Real>
abi::PointsView<Real> piece_of(const PointsView<Real>& points, std::size_t first, int count)
{
    return {{points.point[0] + first, points.point[1] + first, points.point[2] + first},
            part_of(points.surface, first),
            count};
}

template <class Real>
abi::HitsView<Real> piece_of(const HitsView<Real>& hits, std::size_t first)
{
    const auto part = part_of(hits, first);
    return {part.t,
            part.object,
            {part.normal_x, part.normal_y, part.normal_z},
            {part.outer_start[0], part.outer_start[1], part.outer_start[2]},
            {part.inner_start[0], part.inner_start[1], part.inner_start[2]},
            {part.point[0], part.point[1], part.point[2]},
            part.surface};
}

template <class Real>
void add_starts(abi::RaysView<Real>& piece, const StartsView<Real>& starts, std::size_t first)
{
    static_assert(no_start == abi::no_start);
    for (int axis = 0; axis < 3; ++axis)
        piece.start_point[axis] = starts.point[axis] + first;
    piece.start_surface = starts.surface + first;
}

/// The meaning of a negative surface number. inner_side: the complement of the surface whose inner
/// side a ray leaves. no_surface: the point is on no surface.
enum class BelowZero { inner_side, no_surface };

/// Throws std::invalid_argument unless all numbers are valid for `count` surfaces.
void check_surfaces(std::span<const std::int32_t> numbers, std::int32_t count, BelowZero below)
{
    const auto is_right = [&](std::int32_t number) {
        if (number >= 0)
            return number < count;
        return number == no_start || below == BelowZero::no_surface || ~number < count;
    };
    const auto wrong = std::find_if_not(numbers.begin(), numbers.end(), is_right);
    if (wrong != numbers.end())
        throw std::invalid_argument("surface " + std::to_string(*wrong) + " of " +
                                    std::to_string(count) +
                                    "; give the numbers that hits of this scene have");
}

/// A hit to be sorted, by its t before rounding to Real.
template <class Real>
struct FoundHit {
    double t;
    std::int32_t object;
    SurfaceHit<Real> hit;

    /// If an object is hit twice at one t, as on the rim of a cap, the normals decide, so that the
    /// order does not depend on the traversal.
    bool operator<(const FoundHit& other) const
    {
        const Real(&a)[3] = hit.normal;
        const Real(&b)[3] = other.hit.normal;
        return std::tie(t, object, a[0], a[1], a[2]) <
               std::tie(other.t, other.object, b[0], b[1], b[2]);
    }
};

template <class Real>
using HitsByRay = std::vector<std::vector<FoundHit<Real>>>;

template <class Real>
void gather(void* by_ray, int ray, double t, std::int32_t object, const Real (&normal)[3])
{
    // A t that overflows in Real is a miss.
    if (t > double{std::numeric_limits<Real>::max()})
        return;
    auto& hits = (*static_cast<HitsByRay<Real>*>(by_ray))[static_cast<std::size_t>(ray)];
    hits.push_back({t, object, {static_cast<Real>(t), object, {normal[0], normal[1], normal[2]}}});
}

template <class Real>
class PacketBackend final : public RayBackend<Real> {
public:
    PacketBackend(const Scene& scene, const RenderOptions& options)
        : accuracy_(accuracy_in<Real>(options)),
          self_hits_(options.self_hits),
          traversal_(options.traversal),
          kernels_(precision<Real>(kernels_of(choose_isa(options.isa, options.width).name))),
          casts_shadow_(casting_objects(scene)),
          scratch_([this] { return AlignedArray<std::byte>::unset(scratch_bytes_); })
    {
        LoweredScene lowered = lower(scene, accuracy_, self_hits_);
        lights_ = lowered.lights;
        shadows_ = lowered.shadows;
        pack(std::move(lowered), nullptr);
    }

    void closest_hits(const RaysView<Real>& rays, const StartsView<Real>* starts,
                      const HitsView<Real>& hits) const override
    {
        for (std::size_t first = 0; first < rays.count; first += longest_stream) {
            auto piece = piece_of(rays, first, longest_stream);
            if (starts != nullptr) {
                add_starts(piece, *starts, first);
                check_surfaces({piece.start_surface, static_cast<std::size_t>(piece.count)},
                               surfaces_, BelowZero::inner_side);
            }
            kernels_.closest_hits(packed_->view(), piece, piece_of(hits, first),
                                  scratch_.local().data());
        }
    }

    void occluded(const RaysView<Real>& rays, std::uint8_t* mask) const override
    {
        for (std::size_t first = 0; first < rays.count; first += longest_stream)
            kernels_.occluded(packed_->view(), piece_of(rays, first, longest_stream), mask + first,
                              scratch_.local().data());
    }

    void lit(const PointsView<Real>& points, std::size_t light, std::uint8_t* mask) const override
    {
        for (std::size_t first = 0; first < points.count; first += longest_stream) {
            const auto count = static_cast<int>(std::min(points.count - first, longest_stream));
            const auto piece = piece_of(points, first, count);
            if (piece.surface != nullptr)
                check_surfaces({piece.surface, static_cast<std::size_t>(count)}, surfaces_,
                               BelowZero::no_surface);
            lit_->lit(piece, light, mask + first);
        }
    }

    void all_hits(const RaysView<Real>& rays,
                  const typename RayScene<Real>::TakeHits& take) const override
    {
        HitsByRay<Real> by_ray(std::min(rays.count, longest_gathering));
        std::vector<SurfaceHit<Real>> sorted;
        for (std::size_t first = 0; first < rays.count; first += longest_gathering) {
            const auto piece = piece_of(rays, first, longest_gathering);
            kernels_.all_hits(packed_->view(), piece, {&by_ray, gather<Real>});
            for (int ray = 0; ray < piece.count; ++ray) {
                auto& hits = by_ray[static_cast<std::size_t>(ray)];
                std::sort(hits.begin(), hits.end());
                sorted.clear();
                for (const FoundHit<Real>& found : hits)
                    sorted.push_back(found.hit);
                take(first + static_cast<std::size_t>(ray), sorted);
                hits.clear();
            }
        }
    }

    SceneUpdate update(const Scene& scene, std::span<const MovedShape> moved) override
    {
        if (const std::optional<double> cost = refit(scene, moved))
            return {.rebuilt = false, .cost = *cost};
        rebuild(scene);
        return {.rebuilt = true};
    }

private:
    /// The data that a refit needs.
    struct Kept {
        LoweredScene lowered;
        Bvh bvh;
        double built_cost = 0.0;
    };

    /// Packs a lowered scene. If `keep` is not null, it receives the data for refit().
    void pack(LoweredScene lowered, Kept* keep)
    {
        // Queries with the caller's own rays ignore casts_shadow.
        std::vector<bool> casts_shadow;
        casts_shadow.swap(lowered.casts_shadow);
        auto packed = std::make_unique<PackedScene<Real>>(lowered, traversal_,
                                                          keep == nullptr ? nullptr : &keep->bvh);
        casts_shadow.swap(lowered.casts_shadow);
        lit_ = std::make_unique<LitScene<Real>>(lowered, *packed, traversal_, kernels_);
        packed_ = std::move(packed);
        surfaces_ = static_cast<std::int32_t>(lowered.material_index.size());
        scratch_bytes_ = kernels_.stream_scratch_bytes(packed_->view());
        scratch_.clear();
        if (keep != nullptr)
            keep->lowered = std::move(lowered);
    }

    /// Returns the cost of the refitted bvh relative to its cost when it was built, or nothing if
    /// it must be rebuilt.
    std::optional<double> refit(const Scene& scene, std::span<const MovedShape> moved)
    {
        if (kept_ == nullptr)
            return std::nullopt;
        // The kept data are lost if anything below fails or throws, because they are then invalid.
        std::unique_ptr<Kept> kept = std::move(kept_);
        if (!move_objects(scene, moved, packed_->view().shapes.index, kept->lowered))
            return std::nullopt;
        refit_tree(kept->lowered, kept->bvh);
        const double cost = surface_area_cost(kept->bvh) / kept->built_cost;
        if (!(cost <= most_refit_cost))
            return std::nullopt;
        packed_->refit(kept->lowered, kept->bvh);
        lit_ = std::make_unique<LitScene<Real>>(kept->lowered, *packed_, traversal_, kernels_);
        kept_ = std::move(kept);
        return cost;
    }

    /// Restores lights and shadows of the scene that this was made of. A refit does not read them
    /// either, and indices of lights are checked against that scene.
    void keep_shadows(LoweredScene& lowered) const
    {
        lowered.lights = lights_;
        lowered.shadows = shadows_;
        lowered.casts_shadow.clear();
        if (!casts_shadow_.empty())
            for (const abi::MaterialIndex& index : lowered.material_index)
                lowered.casts_shadow.push_back(
                    casts_shadow_[static_cast<std::size_t>(index.object)]);
    }

    void rebuild(const Scene& scene)
    {
        LoweredScene lowered = lower(scene, accuracy_, self_hits_);
        keep_shadows(lowered);
        auto kept = std::make_unique<Kept>();
        pack(std::move(lowered), kept.get());
        if (kept->bvh.nodes.empty())
            return;
        kept->built_cost = surface_area_cost(kept->bvh);
        kept_ = std::move(kept);
    }

    Accuracy accuracy_;
    SelfHits self_hits_;
    Traversal traversal_;
    const abi::PrecisionTable<Real>& kernels_;
    std::vector<bool> casts_shadow_;  ///< from casting_objects()
    std::vector<Light> lights_;       ///< from LoweredScene::lights
    bool shadows_ = true;
    std::unique_ptr<PackedScene<Real>> packed_;
    std::unique_ptr<LitScene<Real>> lit_;
    std::unique_ptr<Kept> kept_;  ///< since the first update, if there is a bvh
    std::size_t scratch_bytes_ = 0;
    std::int32_t surfaces_ = 0;  ///< number of surfaces
    mutable tbb::enumerable_thread_specific<AlignedArray<std::byte>> scratch_;
};

}  // namespace

template <class Real>
std::unique_ptr<RayBackend<Real>> packet_backend(const Scene& scene, const RenderOptions& options)
{
    return std::make_unique<PacketBackend<Real>>(scene, options);
}

template std::unique_ptr<RayBackend<float>> packet_backend(const Scene&, const RenderOptions&);
template std::unique_ptr<RayBackend<double>> packet_backend(const Scene&, const RenderOptions&);

}  // namespace packtrace
