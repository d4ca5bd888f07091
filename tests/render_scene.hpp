#pragma once

#include <packtrace/renderer.hpp>

#include <string>
#include <vector>

// Helpers that call the packet kernels and the scalar reference.
namespace packtrace::test {

/// The instruction sets that this machine can run, narrowest first.
[[nodiscard]] inline std::vector<std::string> supported_isas()
{
    std::vector<std::string> names;
    for (const IsaInfo& isa : list_isas())
        if (isa.supported)
            names.push_back(isa.name);
    return names;
}

/// The instruction sets with fused multiply-add, which all give the same bits. sse42 has none.
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
