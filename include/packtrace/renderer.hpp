#pragma once

#include <packtrace/export.hpp>
#include <packtrace/image.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>

namespace packtrace {

/// The number of rays of each kind in a frame.
struct FrameCounts {
    std::uint64_t camera = 0;
    std::uint64_t shadow = 0;
    std::uint64_t reflected = 0;
    std::uint64_t refracted = 0;
    std::uint64_t unsure = 0;  ///< rays of all kinds, traced again in double (Accuracy::exact)
    CutRays cut = {};          ///< rays that were not traced; not part of total()

    [[nodiscard]] std::uint64_t total() const
    {
        return camera + shadow + reflected + refracted;
    }
};

/// A scene prepared for the packet kernels, to be rendered any number of times. `Real` is float or
/// double. Rendering is thread-safe. It does not allocate after a thread's first tile, with one
/// exception: light buffers of a large scene are built with the frame in which they begin to save
/// time. Light buffers do not change pictures, bit for bit.
template <class Real>
class Renderer {
public:
    /// Throws as render() does. `options.kernel` is ignored.
    PACKTRACE_API explicit Renderer(const Scene& scene, const RenderOptions& options = {});
    PACKTRACE_API ~Renderer();
    PACKTRACE_API Renderer(Renderer&&) noexcept;
    PACKTRACE_API Renderer& operator=(Renderer&&) noexcept;

    /// Renders into `image`. An image that does not have the size of the scene, or of the region,
    /// is replaced. Throws StopError after a stop request (RenderOptions::stop); the pixels of
    /// `image` are then unspecified.
    PACKTRACE_API FrameCounts render(Image<Real>& image) const;

    /// Bytes held for the scene and its bvh, without the working memory of threads.
    [[nodiscard]] PACKTRACE_API std::size_t scene_bytes() const;

    /// The instruction set in use.
    [[nodiscard]] PACKTRACE_API const IsaInfo& isa() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace packtrace
