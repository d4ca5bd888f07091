#pragma once

namespace packtrace {

/// How rays find the bounded objects of a scene. list: test all of them. tree: traverse the bvh.
/// automatic: whichever is faster for the number of objects. Hits are the same, bit for bit.
enum class Traversal { automatic, list, tree };

}  // namespace packtrace
