#pragma once

#include <functional>

#include <packtrace/scene.hpp>

#include <CLI/CLI.hpp>

namespace packtrace::cli {

using TakeScene = std::function<void(Scene)>;

/// Adds a command for each procedural scene to `generate`; the one that is used gives its scene to
/// `take`.
void add_generators(CLI::App& generate, const TakeScene& take);

}  // namespace packtrace::cli
