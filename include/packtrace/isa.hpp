#pragma once

#include <packtrace/export.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace packtrace {

/// An instruction set the packet kernels are compiled for.
struct IsaInfo {
    std::string name;        ///< as `--isa` takes it
    int lanes_single = 0;    ///< rays in a packet of floats
    int lanes_double = 0;    ///< rays in a packet of doubles
    bool supported = false;  ///< by this machine
};

/// All instruction sets compiled in, narrowest first.
[[nodiscard]] PACKTRACE_API std::vector<IsaInfo> list_isas();

/// The instruction set for a request: `auto` takes the PACKTRACE_ISA environment variable when
/// it is set, else the widest supported; a name forces it. `width` (1, 4, 8 or 16 float lanes)
/// narrows `auto` and must agree with a forced name; 0 is any. Throws std::invalid_argument
/// with one line that says what is wrong and what there is.
[[nodiscard]] PACKTRACE_API IsaInfo choose_isa(std::string_view request = "auto", int width = 0);

}  // namespace packtrace
