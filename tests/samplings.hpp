#pragma once

#include <vector>

#include <packtrace/render.hpp>

namespace packtrace::test {

/// A way to sample pixels.
struct Sampling {
    const char* name;
    RenderOptions options;
};

[[nodiscard]] inline std::vector<Sampling> samplings()
{
    RenderOptions once;
    RenderOptions mean;
    mean.samples = 3;
    RenderOptions adaptive;
    adaptive.samples = 4;
    adaptive.adaptive = 0.05;
    return {{"one sample", once}, {"several", mean}, {"adaptive", adaptive}};
}

}  // namespace packtrace::test
