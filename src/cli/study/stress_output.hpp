#pragma once

#include <vector>

#include "cli/study/stress_arguments.hpp"

namespace packtrace::cli {

void print_stress_families();

/// Prints the rows of a stress test and its verdict, or JSON, and writes the cases that are asked
/// for. Throws FileError.
void print_stress(const StressArguments& arguments, const std::vector<lab::StressRow>& rows);

}  // namespace packtrace::cli
