#pragma once

#include "kernel_abi/bvh_view.hpp"
#include "kernel_abi/light_buffer.hpp"
#include "kernel_abi/lists.hpp"
#include "kernel_abi/shading.hpp"

namespace packtrace::abi {

/// The size of a ray's medium stack: the largest number of glass bodies that a ray can be inside
/// of.
inline constexpr int glass_depth = 8;

/// The unit of t and of the distance to a light. The notes differ in it.
enum class RayUnits : std::int32_t {
    as_given,  ///< directions keep the length they are given with (note 001)
    unit       ///< directions are unit
};

/// What rays can hit, in one precision.
template <class Real>
struct GeometryView {
    SphereListView<Real> spheres;
    RecordList<AnchoredSphere<Real>> anchored_spheres;
    RecordList<PlaneRecord<Real>> planes;
    RecordList<QuadricRecord<Real>> quadrics;
    RecordList<PolygonRecord<Real>> polygons;
    BvhView<Real> tree;  ///< holds the objects that are not in the lists
    /// Every coordinate and size has a magnitude for which the error bounds in single precision
    /// hold.
    bool certifiable = false;
};

/// The materials of surfaces.
template <class Real>
struct MaterialsView {
    const MaterialIndex* of_surface = nullptr;
    bool surfaces_are_objects = false;  ///< the number of each surface is that of its object
    const MaterialRecord<Real>* records = nullptr;
    const CheckerRecord<Real>* checkers = nullptr;  ///< null if there are none
    /// Refractive index by object; [-1] is outside everything.
    const Real* ior = nullptr;
};

/// The lights of a scene.
template <class Real>
struct LightingView {
    RecordList<LightRecord<Real>> lights;  ///< ambient light is in the materials
    /// By light, its light buffer (exact mode only); null if there are none.
    const LightBuffer* buffers = nullptr;
    /// No light reaches any object and nothing reflects or refracts: hits show their ambient light
    /// and need no normals.
    bool flat = false;
    bool transparent_shadows = false;  ///< occluders transmit a share of the light
    /// A ray that hits nothing sees a light if the sine of the angle between them is at most this
    /// (note 000). 0: lights are not visible.
    Real seen_within = 0;
    /// A light causes a highlight where N·L is larger than this: 0, or -infinity if lights behind
    /// the surface cause highlights too.
    Real highlight_above = 0;
};

/// Rules of the notes for rays: start, units, depth, and the light of rays that end.
template <class Real>
struct RayRules {
    RayUnits units = RayUnits::as_given;
    int max_depth = 0;
    Real background[3] = {};
    Real limit_color[3] = {};  ///< light of rays beyond the depth limit
    /// A reflected or refracted ray is not traced if its weight is below this in every channel. 0:
    /// all are traced.
    Real min_weight = 0;
    /// By generation, the most light that a ray can return in each channel; null if all rays are
    /// traced.
    const MostLight* most_light = nullptr;
    /// Secondary and shadow rays start at this t.
    Real secondary_t_min = 0;
    /// Rays start off their surface by this share of the coordinates there; 0 for none. If not 0,
    /// hits with the surface that a ray starts on are found as the other root of its equation.
    Real start_error = 0;
};

/// A lowered scene in one precision, as the kernels see it.
template <class Real>
struct SceneView : GeometryView<Real> {
    /// The scene that shadow rays are traced in, of which only the geometry is read; null if that
    /// is this scene, as every object casts shadows.
    const SceneView* casters = nullptr;

    /// The same geometry in double, in the same order. Unsure rays in single precision are traced
    /// again in it. Null in fast mode and in double.
    const GeometryView<double>* wide = nullptr;
    ShapesView shapes;

    MaterialsView<Real> materials;
    LightingView<Real> lighting;
    RayRules<Real> rules;
};

/// The camera. The direction of the pixel in column i and row j is forward + x right + y up with x
/// = i + first_x and y = first_y - j.
template <class Real>
struct CameraView {
    Real origin[3] = {};
    Real right[3] = {};
    Real up[3] = {};
    Real forward[3] = {};
    Real first_x = 0;
    Real first_y = 0;
    Real t_min = 0;  ///< camera rays have hits beyond this only
    /// The initial medium stack: the glass bodies that the camera is in, by object number,
    /// innermost first; -1 ends the list.
    std::int32_t inside[glass_depth] = {-1, -1, -1, -1, -1, -1, -1, -1};
};

}  // namespace packtrace::abi
