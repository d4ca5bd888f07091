#pragma once

#include <packtrace/render.hpp>

namespace packtrace {

/// As the command line has it.
[[nodiscard]] inline const char* name_of(Accuracy accuracy)
{
    return accuracy == Accuracy::fast ? "fast" : "exact";
}

}  // namespace packtrace
