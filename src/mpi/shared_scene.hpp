#pragma once

#include <string>

#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include "mpi/rank_setup.hpp"
#include "mpi/world.hpp"

namespace packtrace::mpi {

/// The scene, on every rank: rank 0 reads the file, or standard input for -, and sends its text. A
/// name such as "generate random --count 10000000" is made by each rank itself. Throws JobFailed.
[[nodiscard]] Scene shared_scene(const World& world, const std::string& name);

/// Throws JobFailed where ranks may not work on one result.
void check_ranks(const World& world, const RenderOptions& options, Mixing mixing);

}  // namespace packtrace::mpi
