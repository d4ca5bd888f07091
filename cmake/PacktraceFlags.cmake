# Flags of everything that feeds a picture, host side included.
#   -ffp-contract=off       a fused operation only where the source writes one
#   -fno-tree-vectorize     GCC 12 turns a*b-c, a*b+c into fmaddsub in spite of contract=off
#   -fno-math-errno         square roots without a call into libm
#   -fno-trapping-math      nothing reads the floating-point exception flags
#   -fno-fast-math          a project around this one may be compiled with -ffast-math or -Ofast, by which
#                           neither errors nor NaNs are as they are written
# -fno-tree-vectorize is GCC's; clang contracts only what it is told to.
# -Wno-restrict: GCC 12 warns of "literal" + std::string without cause (its bug 105651).
# -Wno-subobject-linkage: in unity builds it takes sources for headers.
# -Wno-psabi: GCC notes that for Arm it passes some structs otherwise than GCC 9 did.
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
# Tests and commands call what takes time; with sanitizers, optimising them takes twice as long to
# build.
set(packtrace_caller_options "")
if(PACKTRACE_SANITIZE)
    set(packtrace_caller_options -O0)
    target_compile_options(packtrace_flags INTERFACE
        -fsanitize=${PACKTRACE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options(packtrace_flags INTERFACE -fsanitize=${PACKTRACE_SANITIZE})
endif()

# What the library and the programs are hardened by, kernels apart, which read no input:
#   _FORTIFY_SOURCE          libc's copies check the size of what they write to: 3, where compiler and
#                            libc know it, for sizes that are known at run time only
#   -fstack-protector-strong functions with arrays notice when their frame is overwritten
#   -z relro -z now          symbols are bound at the start, and their table is read-only then
# With PIE, programs lie at random addresses. Sanitizers bring checks of their own.
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
    # libc fortifies only what is optimised. -U: some compilers define it by themselves.
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

# What optimises the kernels that render. By GCC's -O3, which peels loops and much else, they take
# half as long again to build, and frames between 1 % less and 4 % more.
set(packtrace_frame_flags -O3)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set(packtrace_frame_flags -O2 -fpeel-loops)
endif()
# What has those that measure or test something else built quickly, behind the flags of a kernel.
set(packtrace_quick_flags -O1)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND packtrace_quick_flags -fno-peel-loops -finline-limit=300)
endif()
