#pragma once

#include <packtrace/vec.hpp>

namespace packtrace {

/// The inverse with every entry rounded once. In double precision alone an entry of an
/// ill-conditioned matrix's inverse loses digits that no kernel can bring back.
[[nodiscard]] Mat3 exact_inverse(const Mat3& m);

}  // namespace packtrace
