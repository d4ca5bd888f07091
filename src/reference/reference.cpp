#include "reference/reference.hpp"

namespace packtrace::reference {

template <class Real>
typename Reference<Real>::Note Reference<Real>::choose_note(const Scene& scene,
                                                            const World<Real>& world)
{
    switch (scene.illumination) {
        case Illumination::sketch:
            return Note000<Real>(scene, world);
        case Illumination::scratch:
            return Note001<Real>(scene, world);
        case Illumination::whitted:
            return Note002<Real>(scene, world);
        case Illumination::shader:
            return Note004<Real>(scene, world);
        case Illumination::general:
            break;
    }
    return General<Real>(scene, world);
}

template <class Real>
Reference<Real>::Reference(const Scene& scene) : world_(scene), note_(choose_note(scene, world_))
{
}

template <class Real>
Color<Real> Reference<Real>::trace_ray(const Vec3<Real>& org, const Vec3<Real>& dir) const
{
    return std::visit([&](const auto& note) { return note.trace_ray(org, dir); }, note_);
}

template <class Real>
Color<Real> Reference<Real>::trace_pixel(int i, int j) const
{
    return trace_ray(world_.canvas.position, world_.canvas.canvas_to_viewport(i, j));
}

// The last lines of note 001, one row of them.
template <class Real>
void Reference<Real>::trace_row(int j, Image<Real>& image) const
{
    const auto trace_with = [&](const auto& note) {
        for (int i = 0; i < image.width; ++i) {
            const Vec3<Real> D = world_.canvas.canvas_to_viewport(i, j);
            const Color<Real> color = note.trace_ray(world_.canvas.position, D);
            put_pixel(image, i, j, color);
        }
    };
    std::visit(trace_with, note_);
}

template class Reference<float>;
template class Reference<double>;
template class Reference<long double>;

}  // namespace packtrace::reference
