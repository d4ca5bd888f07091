#include "reference/surfaces/all_hits.hpp"

#include "reference/surfaces/surface_normal.hpp"

#include <algorithm>
#include <utility>

namespace packtrace::reference {

template <class Real>
std::vector<SurfaceHit<Real>> all_hits(const Bodies<Real>& bodies, const Vec3<Real>& org,
                                       const Vec3<Real>& dir, Real t_min, Real t_max)
{
    std::vector<SurfaceHit<Real>> hits;
    visit_bodies(bodies, [&](const auto& body) {
        for (const auto& root : roots_of(body, org, dir)) {
            if (root.t < t_min || root.t > t_max)
                continue;
            const Hit<Real> hit{root.t, body.object, root.part, root.leaving};
            const Facing<Real> at = facing(bodies, hit, org + root.t * dir, dir);
            hits.push_back({root.t, body.object, at.outward, root.leaving});
        }
        return true;
    });
    std::stable_sort(hits.begin(), hits.end(), [](const auto& a, const auto& b) {
        return std::pair(a.t, a.object) < std::pair(b.t, b.object);
    });
    return hits;
}

template std::vector<SurfaceHit<float>> all_hits(const Bodies<float>&, const Vec3<float>&,
                                                 const Vec3<float>&, float, float);
template std::vector<SurfaceHit<double>> all_hits(const Bodies<double>&, const Vec3<double>&,
                                                  const Vec3<double>&, double, double);
template std::vector<SurfaceHit<long double>> all_hits(const Bodies<long double>&,
                                                       const Vec3<long double>&,
                                                       const Vec3<long double>&, long double,
                                                       long double);

}  // namespace packtrace::reference
