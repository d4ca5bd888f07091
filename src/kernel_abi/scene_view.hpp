#pragma once

#include "kernel_abi/lists.hpp"
#include "kernel_abi/shading.hpp"

namespace packtrace::abi {

/// A lowered scene in one precision, as the kernels see it.
template <class Real>
struct SceneView {
    SphereListView<Real> spheres;
    RecordList<HugeSphere<Real>> huge_spheres;
    RecordList<PlaneRecord<Real>> planes;

    const SurfaceRecord<Real>* surfaces = nullptr;  ///< by object
    const MaterialIndex* material_index = nullptr;  ///< by object
    const MaterialRecord<Real>* materials = nullptr;
    const CheckerRecord<Real>* checkers = nullptr;
    int checker_count = 0;
    RecordList<LightRecord<Real>> lights;  ///< ambient light is in the materials

    Real background[3] = {};
    int max_depth = 0;
    bool shadows = true;
    /// Secondary and shadow rays start this far along their (unnormalised) direction.
    Real epsilon = 0;
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
};

}  // namespace packtrace::abi
