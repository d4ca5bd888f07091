#pragma once

#include <packtrace/explain.hpp>
#include <packtrace/report.hpp>
#include <packtrace/scene.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>

// Why pixels differ from the truth, and how many for which reason.
namespace packtrace {

/// Why a pixel differs from the truth: the difference between the two ray trees that moves its
/// colour most.
enum class ErrorClass {
    silhouette,   ///< the camera ray passes an object's edge on its other side
    shadow_edge,  ///< the point seen lies on the other side of a shadow's edge
    deep,         ///< a mirrored or refracted ray took another way, or was not traced
    highlight,    ///< same rays, but another highlight
    position,     ///< same rays, but the hit point or its normal is off
    shading,      ///< same rays, but another colour that is no highlight
    near_start,   ///< a ray met something, or missed it, that lies by its start: epsilon
    lost_hit      ///< a ray missed what lies squarely in its way, or met what does not
};
inline constexpr int error_class_count = 8;

struct ClassifiedError {
    ErrorClass kind = ErrorClass::shading;
    double effect = 0.0;  ///< on the pixel, the largest of its channels
};

/// "silhouette", "shadow edge" …
[[nodiscard]] std::string name_of(ErrorClass kind);
/// One sentence on it.
[[nodiscard]] std::string meaning_of(ErrorClass kind);

/// Compares ray trees of pixels of one scene. Where they take different ways, it asks the scalar
/// reference in double what a ray should have met, and what rays close to it meet: only if these
/// agree is it not an edge.
class ErrorClassifier {
public:
    explicit ErrorClassifier(const Scene& scene);
    ~ErrorClassifier();
    ErrorClassifier(ErrorClassifier&&) noexcept;
    ErrorClassifier& operator=(ErrorClassifier&&) noexcept;

    /// None for trees that bring the same colour. `tested` is the tree that is in doubt.
    [[nodiscard]] std::optional<ClassifiedError> classify(const RayNode& truth,
                                                          const RayNode& tested) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

// error_shares.cpp

/// Why a pixel is off, by any means.
using ClassOfPixel = std::function<std::optional<ClassifiedError>(int x, int y)>;

/// Fills in the run's shares: of its pixels that are off or, when there are none, of its worst
/// ones. When they are more than options.classified, some spread evenly over them stand for all.
void find_shares(ReportRun& run, const Image<double>& truth, const Image<double>& picture,
                 const ReportOptions& options, const ClassOfPixel& class_of);

}  // namespace packtrace
