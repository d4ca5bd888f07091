#pragma once

#include "lab/stress/stress.hpp"

namespace packtrace::lab {

/// What is wrong in a row that is held to deciding as double does, each in a few words.
[[nodiscard]] std::vector<std::string> faults_of(const StressRow& row);

/// The same of a family that asks something else than what a ray hits first.
[[nodiscard]] std::vector<std::string> faults_of_measure(const StressRow& row);

/// One line on all rows that are held to it.
[[nodiscard]] std::string stress_verdict(const std::vector<StressRow>& rows);

/// Whether no row has a fault.
[[nodiscard]] bool without_faults(const std::vector<StressRow>& rows);

}  // namespace packtrace::lab
