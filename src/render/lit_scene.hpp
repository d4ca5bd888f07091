#pragma once

#include "core/aligned_array.hpp"
#include "core/made_when_paid.hpp"
#include "dispatch/kernels.hpp"
#include "lower/lowered_scene.hpp"
#include "lower/packed_scene.hpp"
#include <packtrace/traversal.hpp>

#include <tbb/enumerable_thread_specific.h>

#include <memory>
#include <mutex>
#include <vector>

namespace packtrace {

/// Answers RayScene::lit(). What it needs besides the shapes is built by the first call. lit() may
/// be called from several threads at once.
template <class Real>
class LitScene {
public:
    /// `shapes` is `lowered` packed, with all of its objects. It must outlive this.
    LitScene(const LoweredScene& lowered, const PackedScene<Real>& shapes, Traversal traversal,
             const abi::PrecisionTable<Real>& kernels);

    /// As RayScene::lit(), except that `light` is the index among the lights that are not ambient.
    void lit(const abi::PointsView<Real>& points, std::size_t light, std::uint8_t* mask);

private:
    void prepare();
    [[nodiscard]] const abi::LightRecord<Real>& record_of(std::size_t light) const
    {
        return shapes_.view().lighting.lights.data[light];
    }
    [[nodiscard]] const abi::LightBuffer* buffer_of(std::size_t light, std::size_t rays);

    const PackedScene<Real>& shapes_;
    Traversal traversal_;
    const abi::PrecisionTable<Real>& kernels_;
    /// The objects that cast shadows, until they are packed; null if all do.
    std::unique_ptr<LoweredScene> lowered_casters_;
    std::vector<MadeWhenPaid<PackedLightBuffer>> buffers_;  ///< by light

    std::once_flag prepared_;
    std::unique_ptr<PackedScene<Real>> packed_casters_;
    const PackedScene<Real>* casters_ = nullptr;
    abi::SceneView<Real> view_;
    std::size_t scratch_bytes_ = 0;
    tbb::enumerable_thread_specific<AlignedArray<std::byte>> scratch_;
};

}  // namespace packtrace
