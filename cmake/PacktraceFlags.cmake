# Flags of everything that feeds a picture, host side included.
#   -ffp-contract=off       a fused operation only where the source writes one
#   -fno-tree-vectorize     GCC 12 turns a*b-c, a*b+c into fmaddsub in spite of contract=off
#   -fno-math-errno         square roots without a call into libm
#   -fno-trapping-math      nothing reads the floating-point exception flags
# -fno-tree-vectorize is GCC's; clang contracts only what it is told to.
# -Wno-restrict: GCC 12 warns of "literal" + std::string without cause (its bug 105651).
# -Wno-subobject-linkage: in unity builds it takes sources for headers.
add_library(packtrace_flags INTERFACE)
target_compile_options(packtrace_flags INTERFACE
    -ffp-contract=off -fno-math-errno -fno-trapping-math
    $<$<CXX_COMPILER_ID:GNU>:-fno-tree-vectorize>
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wno-subobject-linkage>)
if(PACKTRACE_WERROR)
    target_compile_options(packtrace_flags INTERFACE -Werror)
endif()
# Tests and commands call what takes time; with sanitizers, optimising them takes twice as long to
# build.
set(packtrace_caller_options "")
if(PACKTRACE_SANITIZE)
    set(packtrace_caller_options -O0)
    target_compile_options(packtrace_flags INTERFACE
        -fsanitize=${PACKTRACE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options(packtrace_flags INTERFACE -fsanitize=${PACKTRACE_SANITIZE})
endif()
