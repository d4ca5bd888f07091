#pragma once

#include <packtrace/scene.hpp>

#include <CLI/CLI.hpp>

#include <functional>

namespace packtrace::cli {

// Exit codes of the program.
inline constexpr int exit_ok = 0;
inline constexpr int exit_failed = 1;  // bad input, or a comparison over its limit
inline constexpr int exit_usage = 2;   // wrong use of the command line
inline constexpr int exit_unsure = 3;  // the measurement is not exact enough for an answer

/// A subcommand's callback throws it to end the program without a further message, because the
/// result is already printed.
struct Failed {
    int exit_code = exit_failed;
};

// Each function adds its subcommand to `app`; there is one file per subcommand. A callback reports
// errors by throwing: std::exception for bad input (exit 1), CLI::Error for wrong use (exit 2).
void add_bench(CLI::App& app);
void add_compare(CLI::App& app);
void add_completion(CLI::App& app);
void add_demo(CLI::App& app);
void add_explain(CLI::App& app);
void add_generate(CLI::App& app);
void add_info(CLI::App& app);
void add_intersect(CLI::App& app);
void add_join(CLI::App& app);
void add_onedim(CLI::App& app);
void add_profile(CLI::App& app);
void add_render(CLI::App& app);
void add_report(CLI::App& app);
void add_soak(CLI::App& app);
void add_stress(CLI::App& app);

using TakeScene = std::function<void(Scene)>;

/// Adds a command for each procedural scene to `generate`. The command that is used calls `take`
/// with its scene.
void add_generators(CLI::App& generate, const TakeScene& take);

}  // namespace packtrace::cli
