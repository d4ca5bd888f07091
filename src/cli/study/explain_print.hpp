#pragma once

#include <packtrace/explain.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <nlohmann/json.hpp>

#include <iosfwd>
#include <string>
#include <vector>

namespace packtrace::cli {

/// A pixel's ray trees, and the text above them.
struct Explanation {
    std::string file;
    int x = 0;
    int y = 0;
    Precision precision = Precision::single;  ///< of the packets: single or double_
    std::string isa;
    double tolerance = 0.0;
    RayNode reference;
    RayNode packets;
    std::vector<TreeRow> rows;
};

/// The first row in which the trees differ; null if there is none.
[[nodiscard]] const TreeRow* first_difference(const Explanation& explanation);

/// Prints an indented tree with the numbers of the reference beside those of the packets.
void print_explanation(std::ostream& to, const Scene& scene, const Explanation& explanation);

[[nodiscard]] nlohmann::ordered_json explanation_json(const Scene& scene,
                                                      const Explanation& explanation);

}  // namespace packtrace::cli
