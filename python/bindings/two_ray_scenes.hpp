#pragma once

#include <memory>
#include <mutex>
#include <tuple>
#include <utility>

#include <packtrace/intersect.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/validate.hpp>

namespace packtrace::python {

/// A scene for rays of either precision, each made ready when it is asked for first.
class TwoRayScenes {
public:
    TwoRayScenes(Scene scene, const RenderOptions& options)
        : scene_(std::move(scene)), options_(options)
    {
        validate(scene_);
        // Throws where there is no such kernel.
        if (options_.kernel == Kernel::packet)
            options_.isa = choose_isa(options_.isa, options_.width).name;
    }

    [[nodiscard]] int threads() const
    {
        return options_.threads;
    }

    [[nodiscard]] std::size_t object_count() const
    {
        return scene_.objects.size();
    }

    /// To be called without the GIL: another thread may be making it.
    template <class Real>
    [[nodiscard]] const RayScene<Real>& of()
    {
        const std::lock_guard lock(mutex_);
        auto& made = std::get<std::unique_ptr<RayScene<Real>>>(made_);
        if (!made)
            made = std::make_unique<RayScene<Real>>(scene_, options_);
        return *made;
    }

private:
    Scene scene_;
    RenderOptions options_;
    std::mutex mutex_;
    std::tuple<std::unique_ptr<RayScene<float>>, std::unique_ptr<RayScene<double>>> made_;
};

}  // namespace packtrace::python
