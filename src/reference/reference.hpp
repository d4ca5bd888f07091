#pragma once

#include "reference/models/general.hpp"
#include "reference/models/note_000.hpp"
#include "reference/models/note_001.hpp"
#include "reference/models/note_002.hpp"
#include "reference/models/note_004.hpp"
#include "reference/ray_weight.hpp"
#include "reference/world.hpp"
#include <packtrace/image.hpp>
#include <packtrace/scene.hpp>

#include <variant>
#include <vector>

namespace packtrace::reference {

/// A scene made ready for the scalar reference in one precision. Several threads may trace at once.
/// `Recorder` receives the events of tracing; see NoRecorder. `cuts`, if given, counts the rays
/// that are not traced because of Scene::min_weight.
template <class Real, class Recorder = NoRecorder>
class Reference {
public:
    /// Throws std::invalid_argument for a material of another model than the scene's.
    explicit Reference(const Scene& scene, Recorder record = {},
                       SelfHits self_hits = default_self_hits);
    Reference(const Reference&) = delete;
    Reference& operator=(const Reference&) = delete;

    /// The colour of the pixel in column `i` and row `j`, not clamped.
    [[nodiscard]] Color<Real> trace_pixel(int i, int j, CutCounter* cuts = nullptr) const;

    /// The colour along a camera ray. `dir` has the length that the camera gives it: in the
    /// model of note 001 such rays start at t = 1.
    [[nodiscard]] Color<Real> trace_ray(const Vec3<Real>& org, const Vec3<Real>& dir,
                                        CutCounter* cuts = nullptr) const;

    /// The mean colour of the pixel over samples at `places`, in the units of Camera::pixel_sample.
    [[nodiscard]] Color<Real> trace_samples(int i, int j, const std::vector<Vec2>& places,
                                            CutCounter* cuts = nullptr) const;

    [[nodiscard]] const World<Real>& world() const
    {
        return world_;
    }

private:
    using Note =
        std::variant<Note000<Real, Recorder>, Note001<Real, Recorder>, Note002<Real, Recorder>,
                     Note004<Real, Recorder>, General<Real, Recorder>>;

    [[nodiscard]] static Note choose_note(const Scene& scene, const World<Real>& world,
                                          Recorder record);

    World<Real> world_;
    Note note_;
};

}  // namespace packtrace::reference
