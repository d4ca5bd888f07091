#pragma once

#include <string>
#include <vector>

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

/// Throws JobFailed where ranks are of unequal versions, or run other instruction sets: rows of
/// studies would differ. No names are all that run on this machine.
void check_same_isas(const World& world, std::vector<std::string> isas);

}  // namespace packtrace::mpi
