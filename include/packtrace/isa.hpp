#pragma once

#include <packtrace/export.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace packtrace {

/// An instruction set that the packet kernels are compiled for.
struct IsaInfo {
    std::string name;        ///< the word for `--isa`
    int lanes_single = 0;    ///< rays in a float packet
    int lanes_double = 0;    ///< rays in a double packet
    bool supported = false;  ///< by this machine
};

/// All instruction sets that are compiled in, narrowest first.
[[nodiscard]] PACKTRACE_API std::vector<IsaInfo> list_isas();

/// Chooses an instruction set. `auto` takes the environment variable PACKTRACE_ISA if it is set,
/// otherwise the widest supported set; a name forces that set. `width` (1, 4, 8 or 16 float lanes)
/// restricts `auto` and must agree with a forced name; 0 is any width. Throws std::invalid_argument
/// with one line that says what is wrong and which sets there are.
[[nodiscard]] PACKTRACE_API IsaInfo choose_isa(std::string_view request = "auto", int width = 0);

}  // namespace packtrace
