#include "reference/reference.hpp"

#include "reference/recorder.hpp"

namespace packtrace::reference {

template <class Real, class Recorder>
typename Reference<Real, Recorder>::Note Reference<Real, Recorder>::choose_note(
    const Scene& scene, const World<Real>& world, Recorder record)
{
    switch (scene.illumination) {
        case Illumination::sketch:
            return Note000<Real, Recorder>(scene, world, record);
        case Illumination::scratch:
            return Note001<Real, Recorder>(scene, world, record);
        case Illumination::whitted:
            return Note002<Real, Recorder>(scene, world, record);
        case Illumination::shader:
            return Note004<Real, Recorder>(scene, world, record);
        case Illumination::general:
            break;
    }
    return General<Real, Recorder>(scene, world, record);
}

template <class Real, class Recorder>
Reference<Real, Recorder>::Reference(const Scene& scene, Recorder record, SelfHits self_hits)
    : world_(scene, self_hits), note_(choose_note(scene, world_, record))
{
}

template <class Real, class Recorder>
Color<Real> Reference<Real, Recorder>::trace_ray(const Vec3<Real>& org, const Vec3<Real>& dir,
                                                 CutCounter* cuts) const
{
    if (cuts != nullptr)
        cuts->begin_camera_ray();
    const RayWeight<Real> weight{{1, 1, 1}, cuts};
    return std::visit([&](const auto& note) { return note.trace_ray(org, dir, weight); }, note_);
}

template <class Real, class Recorder>
Color<Real> Reference<Real, Recorder>::trace_pixel(int i, int j, CutCounter* cuts) const
{
    return trace_ray(world_.canvas.position, world_.canvas.canvas_to_viewport(i, j), cuts);
}

template <class Real, class Recorder>
Color<Real> Reference<Real, Recorder>::trace_samples(int i, int j, const std::vector<Vec2>& places,
                                                     CutCounter* cuts) const
{
    Color<Real> sum(0, 0, 0);
    for (const Vec2& place : places)
        sum +=
            trace_ray(world_.canvas.position, world_.canvas.canvas_to_viewport(i, j, place), cuts);
    return sum * (Real(1) / static_cast<Real>(places.size()));
}

template class Reference<float>;
template class Reference<double>;
template class Reference<long double>;
template class Reference<float, TreeRecorder>;
template class Reference<double, TreeRecorder>;

}  // namespace packtrace::reference
