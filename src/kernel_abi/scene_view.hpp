#pragma once

#include "kernel_abi/bvh_view.hpp"
#include "kernel_abi/light_buffer.hpp"
#include "kernel_abi/lists.hpp"
#include "kernel_abi/shading.hpp"

namespace packtrace::abi {

/// How many glass bodies a ray remembers to be inside of.
inline constexpr int glass_depth = 8;

/// What a ray's t and the light's way count in: the notes differ.
enum class RayUnits : std::int32_t {
    as_given,  ///< directions keep the length they come with (note 001)
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
    BvhView<Real> tree;  ///< holds what the lists do not
    /// Every coordinate and size is of a magnitude that error bounds in single precision hold for.
    bool certifiable = false;
};

/// What hits are made of.
template <class Real>
struct MaterialsView {
    const MaterialIndex* of_surface = nullptr;
    bool surfaces_are_objects = false;  ///< each surface has the number of its object
    const MaterialRecord<Real>* records = nullptr;
    const CheckerRecord<Real>* checkers = nullptr;  ///< null without any
    /// Refractive index by object; [-1] is outside everything.
    const Real* ior = nullptr;
};

/// What light does at hits.
template <class Real>
struct LightingView {
    RecordList<LightRecord<Real>> lights;  ///< ambient light is in the materials
    /// By light, its own view of the hierarchy of exact mode; null where there is none.
    const LightBuffer* buffers = nullptr;
    /// No light reaches anything and nothing is mirrored or refracted: hits show their ambient
    /// light, and need no normals.
    bool flat = false;
    bool transparent_shadows = false;  ///< occluders pass on their transmitted share
    /// How near to parallel a ray that escapes runs to a light that it sees (note 000); 0: lights
    /// are not seen.
    Real seen_within = 0;
    /// A light makes a highlight where its N·L is larger: 0, or -infinity where lights behind the
    /// surface make one too.
    Real highlight_above = 0;
};

/// Where rays start, what they count in and what those that end bring.
template <class Real>
struct RayRules {
    RayUnits units = RayUnits::as_given;
    int max_depth = 0;
    Real background[3] = {};
    Real limit_color[3] = {};  ///< what rays beyond the depth limit bring
    /// A mirrored or refracted ray is not traced where its weight is below this in every channel;
    /// 0: all are.
    Real min_weight = 0;
    /// By generation, the most light that a ray can bring in each channel; null where all rays are
    /// traced.
    const MostLight* most_light = nullptr;
    /// Secondary and shadow rays start this far along their direction.
    Real secondary_t_min = 0;
    /// Share of the coordinates there by which they start off the surface; 0 for none. If any,
    /// their own surface is solved as one they are on.
    Real start_error = 0;
};

/// A lowered scene in one precision, as the kernels see it.
template <class Real>
struct SceneView : GeometryView<Real> {
    /// Where shadow rays find their occluders, of which only the geometry counts; null where that
    /// is here, as every object casts shadows.
    const SceneView* casters = nullptr;

    /// The same geometry in double, list by list in the same order, which rays in single precision
    /// that are unsure of their hit are traced in again; null in fast mode and for doubles.
    const GeometryView<double>* wide = nullptr;
    ShapesView shapes;

    MaterialsView<Real> materials;
    LightingView<Real> lighting;
    RayRules<Real> rules;
};

/// The camera over the canvas: the direction of the pixel in column i, row j is
/// forward + x right + y up with x = i + first_x, y = first_y - j.
template <class Real>
struct CameraView {
    Real origin[3] = {};
    Real right[3] = {};
    Real up[3] = {};
    Real forward[3] = {};
    Real first_x = 0;
    Real first_y = 0;
    Real t_min = 0;  ///< camera rays hit nothing nearer
    /// The glass the eye is in, by object number, innermost first; -1 ends it.
    std::int32_t inside[glass_depth] = {-1, -1, -1, -1, -1, -1, -1, -1};
};

}  // namespace packtrace::abi
