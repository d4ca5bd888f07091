#pragma once

#include <packtrace/image.hpp>
#include <packtrace/scene.hpp>

#include "reference/note_001.hpp"
#include "reference/world.hpp"

namespace packtrace::reference {

/// A scene made ready for the scalar reference in one precision. Tracing changes nothing, so
/// that pixels may be traced from several threads.
template <class Real>
class Reference {
public:
    /// Throws std::invalid_argument for an illumination model that has no reference.
    explicit Reference(const Scene& scene);
    Reference(const Reference&) = delete;
    Reference& operator=(const Reference&) = delete;

    /// The colour of the pixel in column `i` and row `j`, not clamped.
    [[nodiscard]] Color<Real> trace_pixel(int i, int j) const;

    /// Fills row `j` of `image`, which has the scene's size.
    void trace_row(int j, Image<Real>& image) const;

    [[nodiscard]] const World<Real>& world() const
    {
        return world_;
    }

private:
    World<Real> world_;
    Note001<Real> note_;
};

}  // namespace packtrace::reference
