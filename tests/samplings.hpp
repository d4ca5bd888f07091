#pragma once

#include <packtrace/render.hpp>

#include <vector>

namespace packtrace::test {

/// Options of pixel sampling.
struct Sampling {
    const char* name;
    RenderOptions options;
};

[[nodiscard]] inline std::vector<Sampling> samplings()
{
    RenderOptions once;
    const RenderOptions mean{.samples = 3};
    const RenderOptions adaptive{.samples = 4, .adaptive = 0.05};
    return {{"one sample", once}, {"several", mean}, {"adaptive", adaptive}};
}

}  // namespace packtrace::test
