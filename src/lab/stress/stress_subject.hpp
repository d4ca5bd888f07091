#pragma once

#include <string>
#include <vector>

#include "lab/stress/evaluate.hpp"
#include "lab/stress/stress.hpp"
#include "lab/stress/stress_group.hpp"

namespace packtrace::lab {

/// An accuracy of packets; `exact` ones are held to deciding as double does.
struct StressMode {
    const char* name;
    Accuracy accuracy;
    bool exact;
};

inline constexpr StressMode stress_modes[] = {{"fast", Accuracy::fast, false},
                                              {"exact", Accuracy::exact, true}};

/// A kernel in one mode, on one instruction set.
struct StressSubject {
    std::string kernel;
    std::string mode;
    std::string isa;
    bool exact = false;
    RenderOptions options;
};

/// Whether `name` is among `names`; where none are given all are.
[[nodiscard]] bool wanted(const std::vector<std::string>& names, const std::string& name);

/// The subjects that the options ask for.
[[nodiscard]] std::vector<StressSubject> stress_subjects(const StressOptions& options);

/// Answers by ray, and what the closest hits took. The textbook has no more than those.
struct StressRun {
    std::vector<Answer> answers;
    std::vector<std::uint8_t> occluded;
    std::vector<std::int32_t> first;     ///< object of the first of all hits
    std::vector<std::size_t> crossings;  ///< how many hits there are
    double seconds = 0.0;
};

template <class Real>
[[nodiscard]] StressRun run_subject(const StressSubject& subject, const StressGroup& group);

}  // namespace packtrace::lab
