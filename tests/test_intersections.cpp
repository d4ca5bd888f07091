// The kernels' closest hits against ray tests in long double.
#include "catch.hpp"
#include "hit_error.hpp"
#include "ray_families.hpp"
#include "simd_packet.hpp"

namespace packtrace::test {
namespace {

/// The accuracy modes that differ for packets of Real.
template <class Real>
std::vector<Accuracy> modes()
{
    if (sizeof(Real) == sizeof(float))
        return {Accuracy::fast, Accuracy::exact};
    return {Accuracy::fast};
}

/// Checks every family on every instruction set. The object is right wherever this can be decided.
/// In fast mode the error of t is within what the rounding of the inputs causes. In exact mode t is
/// within one unit in its last place.
template <class Real>
void check_families(const std::vector<RayFamily>& families)
{
    for (const RayFamily& family : families)
        for (const abi::KernelTable* table : supported_kernels())
            for (const Accuracy accuracy : modes<Real>()) {
                CAPTURE(family.name, table->isa, static_cast<int>(accuracy));
                const HitErrors errors = hit_errors<Real>(*table, family.scene, accuracy);
                CHECK(errors.wrong_object == 0);
                if (accuracy == Accuracy::fast)
                    CHECK(errors.worst_t <= static_cast<double>(stability));
                else
                    CHECK(errors.worst_ulp <= 1.0);
                CHECK(errors.hits >= errors.rays / 5);
                CHECK(errors.undecidable <= errors.rays / 10);
            }
}

/// The closest object of each of a scene's camera rays.
template <class Real>
std::vector<int> closest_objects(const abi::KernelTable& table, const Scene& scene,
                                 Accuracy accuracy)
{
    std::vector<int> objects;
    const TracingSetup<Real> setup(scene, accuracy);
    for (const TracedRay<Real>& traced : trace_closest(table, setup, scene))
        objects.push_back(traced.object);
    return objects;
}

/// `object` with a copy of itself at the end of the scene; enough other objects between them fill
/// more than one packet.
Scene with_a_double(Scene scene, std::size_t object)
{
    SceneRandom random(31);
    for (int i = 0; i < 20; ++i)
        add_sphere(scene, random.inside({-3, -3, 20}, {3, 3, 30}), 0.5, scratch(Rgb(1), -1, 0));
    scene.objects.push_back(scene.objects[object]);
    return scene;
}

int count(const std::vector<int>& objects, std::size_t object)
{
    return static_cast<int>(std::count(objects.begin(), objects.end(), static_cast<int>(object)));
}

}  // namespace

TEMPLATE_TEST_CASE("spheres are hit where long double says", "[intersections]", float, double)
{
    check_families<TestType>(sphere_families());
}

TEMPLATE_TEST_CASE("planes are hit where long double says", "[intersections]", float, double)
{
    check_families<TestType>(plane_families());
}

TEMPLATE_TEST_CASE("anchored spheres are hit where long double says", "[intersections]", float,
                   double)
{
    check_families<TestType>(anchored_families());
}

TEST_CASE("a ground of radius 5000 is hit within 200 units of t's last place in fast mode",
          "[intersections]")
{
    for (const abi::KernelTable* table : supported_kernels()) {
        CAPTURE(table->isa);
        const HitErrors fast = hit_errors<float>(*table, ground(5000, 0), Accuracy::fast);
        CHECK(fast.worst_ulp > 1.0);
        CHECK(fast.worst_ulp <= 200.0);
    }
}

TEMPLATE_TEST_CASE("of two coincident objects the one with the lower number is hit",
                   "[intersections]", float, double)
{
    // A sphere, the anchored sphere, and a plane.
    Scene scene = four_spheres(48, 48);
    add_plane(scene, {0, 0, 9}, {0.1, 0.2, -1}, scratch(Rgb(1), -1, 0));
    for (const std::size_t object : {std::size_t{0}, std::size_t{3}, std::size_t{4}}) {
        const Scene doubled = with_a_double(scene, object);
        for (const abi::KernelTable* table : supported_kernels())
            for (const Accuracy accuracy : modes<TestType>()) {
                CAPTURE(table->isa, object, static_cast<int>(accuracy));
                const auto objects = closest_objects<TestType>(*table, doubled, accuracy);
                CHECK(count(objects, object) > 0);
                CHECK(count(objects, doubled.objects.size() - 1) == 0);
                CHECK(objects ==
                      closest_objects<TestType>(*table, with_a_double(scene, 1), accuracy));
            }
    }
}

TEMPLATE_TEST_CASE("rays that hit nothing report a miss", "[intersections]", float, double)
{
    Scene scene = four_spheres(48, 48);
    scene.camera.position = {0, 80, 0};
    scene.objects.resize(3);
    for (const abi::KernelTable* table : supported_kernels())
        for (const Accuracy accuracy : modes<TestType>()) {
            CAPTURE(table->isa, static_cast<int>(accuracy));
            const TracingSetup<TestType> setup(scene, accuracy);
            int wrong = 0;
            for (const TracedRay<TestType>& traced : trace_closest(*table, setup, scene))
                wrong += traced.object != -1 || !std::isinf(traced.t);
            CHECK(wrong == 0);
        }
}

}  // namespace packtrace::test
