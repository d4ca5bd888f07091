#include "reference/reference.hpp"

#include <stdexcept>

namespace packtrace::reference {
namespace {

const Scene& checked(const Scene& scene)
{
    if (scene.illumination != Illumination::scratch)
        throw std::invalid_argument("the scalar reference has no such illumination model");
    return scene;
}

}  // namespace

template <class Real>
Reference<Real>::Reference(const Scene& scene) : world_(checked(scene)), note_(scene, world_)
{
}

template <class Real>
Color<Real> Reference<Real>::trace_pixel(int i, int j) const
{
    return note_.trace_pixel(i, j);
}

template <class Real>
void Reference<Real>::trace_row(int j, Image<Real>& image) const
{
    for (int i = 0; i < image.width; ++i)
        put_pixel(image, i, j, note_.trace_pixel(i, j));
}

template class Reference<float>;
template class Reference<double>;
template class Reference<long double>;

}  // namespace packtrace::reference
