#pragma once

#include <cstddef>
#include <string>

#include "lab/stress/stress_subject.hpp"

// What is wrong with the answers to single rays, in words.
namespace packtrace::lab {

/// Whether the closest hits are the same, bit for bit.
[[nodiscard]] bool same_answers(const StressRun& a, const StressRun& b);

/// The answers to one ray of a scene, held against what is expected.
void evaluate_ray(Evaluation& evaluation, const StressGroup& group, const StressRun& run,
                  std::size_t i);

/// What is wrong with the answers to one ray, in a word or two; empty where nothing is.
[[nodiscard]] const char* fault_of(const Errors& one);

/// Which ray it is, what it should hit, and what was said.
[[nodiscard]] std::string example_text(const StressGroup& group, std::size_t scene, std::size_t ray,
                                       const Answer& answer, const char* fault);

/// A ray as a line of the CSV that `packtrace intersect` reads.
[[nodiscard]] std::string csv_of(const StressRay& ray);

}  // namespace packtrace::lab
