#pragma once

#include <packtrace/explain.hpp>
#include <packtrace/report.hpp>
#include <packtrace/scene.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>

// The reasons why pixels differ from the truth, and their shares.
namespace packtrace {

/// Why a pixel differs from the truth: the difference between the two ray trees that changes its
/// colour most.
enum class ErrorClass {
    silhouette,   ///< the camera ray passes an object's edge on its other side
    shadow_edge,  ///< the hit point is on the other side of a shadow's edge
    deep,         ///< a mirrored or refracted ray hit something else, or was not traced
    highlight,    ///< same rays, but another highlight
    position,     ///< same rays, but another hit point or normal
    shading,      ///< same rays, but another colour that is no highlight
    near_start,   ///< a ray hit or missed something within some epsilons of its start
    lost_hit      ///< a ray missed what it surely hits, or hit what it surely misses
};
inline constexpr int error_class_count = 8;

struct ClassifiedError {
    ErrorClass kind = ErrorClass::shading;
    double effect = 0.0;  ///< change of the pixel, the largest of its channels
};

/// "silhouette", "shadow edge" …
[[nodiscard]] std::string name_of(ErrorClass kind);
/// What the class means, in a sentence.
[[nodiscard]] std::string meaning_of(ErrorClass kind);

/// Compares ray trees of pixels of one scene. Where rays hit different objects, it traces the ray
/// and rays next to it with the scalar reference in double: there is an edge unless all hit the
/// same object.
class ErrorClassifier {
public:
    explicit ErrorClassifier(const Scene& scene);
    ~ErrorClassifier();
    ErrorClassifier(ErrorClassifier&&) noexcept;
    ErrorClassifier& operator=(ErrorClassifier&&) noexcept;

    /// None for trees of the same colour. `tested` is the tree to be classified.
    [[nodiscard]] std::optional<ClassifiedError> classify(const RayNode& truth,
                                                          const RayNode& tested) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

// error_shares.cpp

/// Gives the reason why a pixel is off.
using ClassOfPixel = std::function<std::optional<ClassifiedError>(int x, int y)>;

/// Sets the run's shares: of its pixels that are off or, if there are none, of its worst pixels. If
/// there are more than options.classified, a selection that is spread evenly over them stands for
/// all.
void find_shares(ReportRun& run, const Image<double>& truth, const Image<double>& picture,
                 const ReportOptions& options, const ClassOfPixel& class_of);

}  // namespace packtrace
