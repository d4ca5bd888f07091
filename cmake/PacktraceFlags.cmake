# Flags of all code that contributes to a picture, including code outside the kernels.
#   -ffp-contract=off       a fused operation only where the source has one
#   -fno-tree-vectorize     GCC 12 turns a*b-c, a*b+c into fmaddsub in spite of contract=off
#   -fno-math-errno         square roots without a call into libm
#   -fno-trapping-math      nothing reads the floating-point exception flags
#   -fno-fast-math          a surrounding project may use -ffast-math or -Ofast, which change rounding
#                           errors and NaNs
# -fno-tree-vectorize is for GCC; clang contracts only on request.
# -Wno-restrict: GCC 12 warns of "literal" + std::string without cause (its bug 105651).
# -Wno-subobject-linkage: in unity builds it mistakes sources for headers.
# -Wno-psabi: GCC notes that on Arm it passes some structs differently from GCC 9.
set(no_psabi "")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
    set(no_psabi $<$<CXX_COMPILER_ID:GNU>:-Wno-psabi>)
endif()
add_library(packtrace_flags INTERFACE)
target_compile_options(packtrace_flags INTERFACE
    -fno-fast-math -ffp-contract=off -fno-math-errno -fno-trapping-math
    $<$<CXX_COMPILER_ID:GNU>:-fno-tree-vectorize>
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
    ${no_psabi}
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wno-subobject-linkage>)
if(PACKTRACE_WERROR)
    target_compile_options(packtrace_flags INTERFACE -Werror)
endif()
# Tests and commands only call the slow code. With sanitizers, optimising them doubles their build
# time.
set(packtrace_caller_options "")
if(PACKTRACE_SANITIZE)
    set(packtrace_caller_options -O0)
    target_compile_options(packtrace_flags INTERFACE
        -fsanitize=${PACKTRACE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options(packtrace_flags INTERFACE -fsanitize=${PACKTRACE_SANITIZE})
endif()

# Hardening of the library and the programs, except kernels, which read no input:
#   _FORTIFY_SOURCE          libc's copies check the size of their destination: level 3, if compiler
#                            and libc support it, for sizes known only at run time
#   -fstack-protector-strong functions with arrays detect an overwritten stack frame
#   -z relro -z now          symbols are bound at the start, and then their table is read-only
# With PIE, programs load at random addresses. Sanitizers have checks of their own.
add_library(packtrace_hardening INTERFACE)
set(packtrace_hardened OFF)
if(PACKTRACE_HARDEN AND NOT PACKTRACE_SANITIZE)
    set(packtrace_hardened ON)
    include(CheckCXXSourceCompiles)
    include(CheckPIESupported)
    check_pie_supported(LANGUAGES CXX)
    set(CMAKE_REQUIRED_FLAGS "-O2 -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3")
    check_cxx_source_compiles("#include <cstdlib>
#if !defined(__USE_FORTIFY_LEVEL) || __USE_FORTIFY_LEVEL < 3
#error it checks known sizes only
#endif
int main() {}" PACKTRACE_FORTIFIES_ALL_SIZES)
    unset(CMAKE_REQUIRED_FLAGS)
    set(packtrace_fortify_level 2)
    if(PACKTRACE_FORTIFIES_ALL_SIZES)
        set(packtrace_fortify_level 3)
    endif()
    # libc fortifies only optimised code. -U: some compilers define the macro by default.
    target_compile_options(packtrace_hardening INTERFACE -fstack-protector-strong
        "$<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=${packtrace_fortify_level}>")
    target_link_options(packtrace_hardening INTERFACE LINKER:-z,relro LINKER:-z,now)
endif()

function(packtrace_harden)
    if(packtrace_hardened)
        foreach(target IN LISTS ARGN)
            target_link_libraries(${target} PRIVATE packtrace_hardening)
            set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
        endforeach()
    endif()
endfunction()

# Optimisation of the kernels that render. GCC's -O3 does more than peel loops: it takes half as
# long again to build, and frames take between 1 % less and 4 % more time.
set(packtrace_frame_flags -O3)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set(packtrace_frame_flags -O2 -fpeel-loops)
endif()
# Flags that follow a kernel's flags, to build measuring and testing kernels quickly.
set(packtrace_quick_flags -O1)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND packtrace_quick_flags -fno-peel-loops -finline-limit=300)
endif()
