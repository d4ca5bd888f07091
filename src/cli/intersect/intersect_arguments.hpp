#pragma once

#include "cli/intersect/hit_rows.hpp"
#include "cli/options/common_options.hpp"
#include <packtrace/scene.hpp>

#include <optional>
#include <string>

namespace packtrace::cli {

struct IntersectArguments {
    std::string scene;
    std::string rays;
    std::string output;
    KernelArguments kernel;
    std::optional<std::string> shard;
    bool all = false;
    bool any = false;
    bool bounds = false;
    bool resume = false;

    [[nodiscard]] RayQuery query() const
    {
        return all ? RayQuery::all : any ? RayQuery::any : RayQuery::closest;
    }
    [[nodiscard]] RayBounds ray_bounds() const
    {
        return bounds ? RayBounds::proven : RayBounds::none;
    }
};

/// Adds all options except `--shard`, which MPI jobs do not have.
void add_intersect_options(CLI::App& command, IntersectArguments& arguments);

/// The render options. Throws CLI::ValidationError for options that contradict each other.
[[nodiscard]] RenderOptions checked_intersect_options(const IntersectArguments& arguments);

/// Everything that hits depend on, except the rays.
[[nodiscard]] std::string hits_recipe(const IntersectArguments& arguments, const Scene& scene,
                                      const RenderOptions& options);

}  // namespace packtrace::cli
