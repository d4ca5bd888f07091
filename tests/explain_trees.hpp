#pragma once

#include <packtrace/explain.hpp>

#include <functional>
#include <string>
#include <vector>

// Helpers for the tests of ray trees.
namespace packtrace::test {

[[nodiscard]] inline RayNode reference_tree(const Scene& scene, int x, int y)
{
    return explain_pixel<double>(scene, x, y, {.kernel = Kernel::scalar});
}

template <class Real>
[[nodiscard]] RayNode packet_tree(const Scene& scene, int x, int y, const std::string& isa = "auto")
{
    return explain_pixel<Real>(scene, x, y, {.isa = isa});
}

inline void visit_tree(const RayNode& tree, const std::function<void(const RayNode&)>& visit)
{
    visit(tree);
    for (const RayNode& child : tree.children)
        visit_tree(child, visit);
}

/// "ray: field" of the first row in which the trees differ.
[[nodiscard]] inline std::string first_difference(const RayNode& first, const RayNode& second,
                                                  double tolerance = double_tree_tolerance)
{
    for (const TreeRow& row : side_by_side(first, second, tolerance))
        if (row.differs)
            return row.ray + ": " + row.field;
    return "none";
}

}  // namespace packtrace::test
