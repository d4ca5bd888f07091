#include "reference/paint.hpp"

namespace packtrace::reference {

template <class Real>
Paint<Real> make_paint(const Object& object)
{
    Paint<Real> paint;
    paint.color = Color<Real>(object.material.color);
    const auto* plane = std::get_if<Plane>(&object.surface);
    if (!object.material.checker || !plane)
        return paint;
    paint.checkered = true;
    paint.other = Color<Real>(object.material.checker->other);
    paint.size = static_cast<Real>(object.material.checker->size);
    paint.point = Vec3<Real>(plane->point);
    paint.u = Vec3<Real>(plane->u);
    paint.v = Vec3<Real>(plane->v);
    return paint;
}

template Paint<float> make_paint(const Object&);
template Paint<double> make_paint(const Object&);
template Paint<long double> make_paint(const Object&);

}  // namespace packtrace::reference
