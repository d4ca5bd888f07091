#pragma once

#include <packtrace/renderer.hpp>

#include <string>
#include <vector>

// Short calls of the packet kernels and the scalar reference.
namespace packtrace::test {

/// Those this machine can run, narrowest first.
[[nodiscard]] inline std::vector<std::string> supported_isas()
{
    std::vector<std::string> names;
    for (const IsaInfo& isa : list_isas())
        if (isa.supported)
            names.push_back(isa.name);
    return names;
}

/// Those of one bit pattern: sse42 has no fused multiply-add.
[[nodiscard]] inline std::vector<std::string> fused_isas()
{
    std::vector<std::string> names = supported_isas();
    std::erase(names, "sse42");
    return names;
}

template <class Real>
[[nodiscard]] Image<Real> render_packets(const Scene& scene, const std::string& isa,
                                         int threads = 0)
{
    return render<Real>(scene, {.isa = isa, .threads = threads});
}

template <class Real>
[[nodiscard]] Image<Real> render_scalar(const Scene& scene)
{
    return render<Real>(scene, {.kernel = Kernel::scalar});
}

}  // namespace packtrace::test
