#pragma once

namespace packtrace {

/// How rays find the bounded objects of a scene: one after another, through a hierarchy of
/// boxes, or whichever is quicker for their number. What they hit is the same, bit for bit.
enum class Traversal { automatic, list, tree };

}  // namespace packtrace
