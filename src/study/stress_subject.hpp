#pragma once

#include <string>
#include <vector>

#include "study/judge.hpp"
#include "study/stress.hpp"
#include "study/stress_family.hpp"

namespace packtrace::study {

/// Rays of one scene with all that is known of them.
struct StressGroup {
    Scene scene;
    std::vector<StressRay> rays;
    std::vector<WideSurface> surfaces;
    std::vector<std::vector<Meeting>> meetings;  ///< by ray
};

/// A kernel in one mode, on one instruction set.
struct StressSubject {
    std::string kernel;
    std::string mode;
    std::string isa;
    RenderOptions options;
};

/// Whether `name` is among `names`; where none are given all are.
[[nodiscard]] bool wanted(const std::vector<std::string>& names, const std::string& name);

/// The subjects that the options ask for. Throws std::invalid_argument for unknown names.
[[nodiscard]] std::vector<StressSubject> stress_subjects(const StressOptions& options);

/// Answers, and what they took.
struct StressRun {
    std::vector<Answer> answers;
    double seconds = 0.0;
};

template <class Real>
[[nodiscard]] StressRun run_subject(const StressSubject& subject, const StressGroup& group);

}  // namespace packtrace::study
