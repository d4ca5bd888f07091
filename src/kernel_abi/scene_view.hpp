#pragma once

#include "kernel_abi/bvh.hpp"
#include "kernel_abi/lists.hpp"
#include "kernel_abi/shading.hpp"
#include "kernel_abi/stiff.hpp"
#include "kernel_abi/surface_form.hpp"

namespace packtrace::abi {

/// How many glass bodies a ray remembers to be inside of.
inline constexpr int glass_depth = 8;

/// What a ray's t and the light's way count in: the notes differ.
enum class RayUnits : std::int32_t {
    as_given,  ///< directions keep the length they come with (note 001)
    unit       ///< directions are unit
};

/// A lowered scene in one precision, as the kernels see it.
template <class Real>
struct SceneView {
    /// Where shadow rays find their blockers, of which only the lists and the tree count; null
    /// where that is here, as every object casts shadows.
    const SceneView* casters = nullptr;

    SphereListView<Real> spheres;
    RecordList<HugeSphere<Real>> huge_spheres;
    RecordList<PlaneRecord<Real>> planes;
    RecordList<QuadricRecord<Real>> quadrics;
    BvhView<Real> tree;             ///< holds what the lists do not
    RecordList<StiffObject> stiff;  ///< not in the other lists; none in double precision

    const SurfacePlace* places = nullptr;           ///< by surface: where the following have it
    const SphereShape* sphere_shapes = nullptr;     ///< of many spheres
    const SurfaceRecord<Real>* surfaces = nullptr;  ///< the others, but quadrics
    const CurvedSurfaceRecord<Real>* curved_surfaces = nullptr;  ///< the others, every kind

    /// What hits of rays in single precision on those others are solved again with, in double: a
    /// place in `finish`, or -1. Null where no hit is solved again, not even on spheres.
    const std::int32_t* finish_index = nullptr;
    const StiffObject* finish = nullptr;
    /// Of the others, too; null where no hit is sharpened and no start is exact.
    const SurfaceForm* forms = nullptr;
    bool sharpened = false;    ///< some hits are, by their surface's form
    bool sharpened_t = false;  ///< with their t
    /// Those on spheres among many, unless they are solved again.
    Sharpened sharpened_spheres = Sharpened::nothing;
    bool met_again_outside = false;  ///< some surface may be, by rays that leave it outwards
    bool precise_powers = false;     ///< highlights in double, for rays in single precision

    const MaterialIndex* material_index = nullptr;  ///< by surface
    bool surfaces_are_objects = false;              ///< each surface has the number of its object
    const MaterialRecord<Real>* materials = nullptr;
    const CheckerRecord<Real>* checkers = nullptr;
    /// Refractive index by object; [-1] is outside everything.
    const Real* ior = nullptr;
    RecordList<LightRecord<Real>> lights;  ///< ambient light is in the materials

    Real background[3] = {};
    Real limit_color[3] = {};  ///< what rays beyond the depth limit bring
    int max_depth = 0;
    /// No light reaches anything and nothing is mirrored or refracted: hits show their ambient
    /// light, and need no normals.
    bool flat = false;
    bool transparent_shadows = false;  ///< blockers pass on their transmitted share
    bool visible_lights = false;       ///< a ray that escapes towards a light sees it (note 000)
    RayUnits units = RayUnits::as_given;
    /// A light makes a highlight where its N·L is larger: 0, or -infinity where lights behind the
    /// surface make one too.
    Real highlight_above = 0;
    /// How near to parallel a ray runs to a light that it sees, and what the notes start
    /// secondary and shadow rays at.
    Real epsilon = 0;
    /// Secondary and shadow rays start this far along their direction.
    Real secondary_t_min = 0;
    /// Roundoffs by which they start off the surface, of the coordinates there; 0 for none. If
    /// any, their own surface is solved by `forms`, as one they are on.
    Real start_error = 0;
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
