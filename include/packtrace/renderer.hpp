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

/// How many rays of each kind a frame took.
struct FrameCounts {
    std::uint64_t camera = 0;
    std::uint64_t shadow = 0;
    std::uint64_t reflected = 0;
    std::uint64_t refracted = 0;
    std::uint64_t unsure = 0;  ///< of all these, traced again in double (Accuracy::exact)
    CutRays cut = {};          ///< besides

    [[nodiscard]] std::uint64_t total() const
    {
        return camera + shadow + reflected + refracted;
    }
};

/// A scene made ready for the packet kernels, to be rendered any number of times. `Real` is
/// float or double. Rendering is thread-safe and allocates nothing after a thread's first tile, but
/// for lights' own views of a large scene, with the frame by which they pay: pictures stay the
/// same, bit for bit.
template <class Real>
class Renderer {
public:
    /// Throws as render() does. `options.kernel` is not looked at.
    PACKTRACE_API explicit Renderer(const Scene& scene, const RenderOptions& options = {});
    PACKTRACE_API ~Renderer();
    PACKTRACE_API Renderer(Renderer&&) noexcept;
    PACKTRACE_API Renderer& operator=(Renderer&&) noexcept;

    /// Renders into `image`, whose size is the scene's, or the region's; an image of another size
    /// is replaced. Throws StopError as RenderOptions::stop has it; `image` is then of no use.
    PACKTRACE_API FrameCounts render(Image<Real>& image) const;

    /// Memory held for the scene, its hierarchy included and threads' working memory not.
    [[nodiscard]] PACKTRACE_API std::size_t scene_bytes() const;

    /// The instruction set in use.
    [[nodiscard]] PACKTRACE_API const IsaInfo& isa() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace packtrace
