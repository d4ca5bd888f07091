#pragma once

#include "render/check_options.hpp"
#include "render/moved_objects.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/validate.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace packtrace::python {

/// A scene for rays of both precisions. Each is prepared at its first use. Queries of several
/// threads may run at once; moving objects waits for them. All members must be called without the
/// GIL, because another thread that they wait for may need it.
class TwoRayScenes {
public:
    TwoRayScenes(Scene scene, const RenderOptions& options)
        : scene_(std::move(scene)), options_(options)
    {
        validate(scene_);
        check_kernel(options_);
        // Throws if there is no such kernel.
        if (options_.kernel == Kernel::packet)
            options_.isa = choose_isa(options_.isa, options_.width).name;
    }

    [[nodiscard]] int threads() const
    {
        return options_.threads;
    }

    /// The number of objects. Moving objects does not change it.
    [[nodiscard]] std::size_t object_count() const
    {
        return scene_.objects.size();
    }

    /// No object moves while the lock is held. A thread must not hold it twice.
    [[nodiscard]] std::shared_lock<std::shared_mutex> hold()
    {
        const std::lock_guard turn(turn_);
        return std::shared_lock(moving_);
    }

    /// The caller must hold the lock of hold().
    template <class Real>
    [[nodiscard]] const RayScene<Real>& of()
    {
        const std::lock_guard lock(making_);
        auto& made = std::get<std::unique_ptr<RayScene<Real>>>(made_);
        if (!made)
            made = std::make_unique<RayScene<Real>>(scene_, options_);
        return *made;
    }

    /// Moves objects to their places in `scene`.
    SceneUpdate update(Scene scene)
    {
        const auto lock = hold_alone();
        check_same_objects(scene.objects.size(), scene_.objects.size());
        keep_shadows(scene);
        const SceneUpdate done = update_made([&](auto& made) { return made.update(scene); }, scene);
        scene_ = std::move(scene);
        return done;
    }

    /// Sets the transforms of objects, given by index. If it throws, nothing changes.
    SceneUpdate transform(std::span<const std::int32_t> objects, std::vector<Mat4> transforms)
    {
        const auto lock = hold_alone();
        for (std::size_t i = 0; i < objects.size(); ++i)
            std::swap(transform_of(objects[i]), transforms[i]);
        try {
            return update_made([&](auto& made) { return made.update(scene_, objects); }, scene_);
        } catch (...) {
            for (std::size_t i = objects.size(); i-- > 0;)
                std::swap(transform_of(objects[i]), transforms[i]);
            throw;
        }
    }

private:
    /// Waits for all holders of the lock. Threads that come later wait for this one.
    [[nodiscard]] std::unique_lock<std::shared_mutex> hold_alone()
    {
        const std::lock_guard turn(turn_);
        return std::unique_lock(moving_);
    }

    /// Updates the precisions that are prepared. If there are none, it only checks the scene.
    template <class Update>
    SceneUpdate update_made(const Update& update, const Scene& scene)
    {
        SceneUpdate all;
        bool any = false;
        const auto one = [&](auto& made) {
            if (!made)
                return;
            const SceneUpdate done = update(*made);
            all = {all.rebuilt || done.rebuilt, any ? std::max(all.cost, done.cost) : done.cost};
            any = true;
        };
        one(std::get<0>(made_));
        one(std::get<1>(made_));
        if (!any)
            validate(scene);
        return all;
    }

    /// Keeps the shadows as RayScene::update() does. Otherwise a precision that is prepared later
    /// would have other shadows.
    void keep_shadows(Scene& scene) const
    {
        scene.lights = scene_.lights;
        scene.shadows = scene_.shadows;
        for (std::size_t i = 0; i < scene.objects.size(); ++i)
            scene.objects[i].casts_shadow = scene_.objects[i].casts_shadow;
    }

    [[nodiscard]] Mat4& transform_of(std::int32_t object)
    {
        return scene_.objects[static_cast<std::size_t>(object)].transform;
    }

    Scene scene_;
    RenderOptions options_;
    std::mutex making_;
    std::mutex turn_;  ///< a shared mutex alone would prefer threads that share it
    std::shared_mutex moving_;
    std::tuple<std::unique_ptr<RayScene<float>>, std::unique_ptr<RayScene<double>>> made_;
};

}  // namespace packtrace::python
