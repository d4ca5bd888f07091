# The kernels: one source, one OBJECT library per instruction set with its own -m flags. They are
# never built with link-time optimisation. They are optimised in debug builds and in builds without
# a type too, because xsimd 8.1 does not compile for AVX-512 at -O0. They are position-independent
# for the shared library, which costs nothing as their symbols are hidden.
#
# -finline-limit and the parameters after it make GCC inline xsimd's one-line functions everywhere,
# so that no weak copy of them leaves the object. -Wno-maybe-uninitialized: GCC 12's own AVX-512
# header reads undefined registers. -fno-lto: a surrounding project may ask for it.
# -fno-stack-protector: Ubuntu's compilers guard every function that has an array on its stack,
# which here is nearly every function, and call libc if a guard is overwritten.
#
# The probe kernels measure shares of a frame, not speed. With these flags they execute about 10 %
# more instructions, and compile in little more than half the time: a minute and a half of one core
# for all instruction sets.
set_source_files_properties(kernels/probe_kernels.cpp PROPERTIES
    COMPILE_OPTIONS "${packtrace_quick_flags}")

set(PACKTRACE_ISAS "all" CACHE STRING
    "Instruction sets to compile kernels for: all, or a list such as sse42;avx2")
set(PACKTRACE_KERNELS "" CACHE INTERNAL "Instruction sets compiled in")

# The instruction sets that matter for speed have kernels for feature sets
# (kernel_abi/features.hpp). The others, fallbacks for old processors and for comparison, have only
# the general kernels: each feature set takes seconds to build and a quarter of a megabyte.
set(with_feature_sets avx2 avx512 neon64)
option(PACKTRACE_FEATURE_SETS "Kernels for sets of features; without them, the general ones only" ON)

# These flags come before those of the instruction set, and override those of a surrounding project.
set(baseline "")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set(baseline -march=x86-64 -mno-avx)
endif()

# Adds the kernels of an instruction set, unless PACKTRACE_ISAS excludes it.
function(packtrace_kernel isa lanes)
    if(NOT PACKTRACE_ISAS STREQUAL "all" AND NOT isa IN_LIST PACKTRACE_ISAS)
        return()
    endif()
    file(GLOB kernel_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/kernels/*.cpp)
    # Only studies record single rays.
    if(NOT PACKTRACE_BUILD_STUDY)
        list(FILTER kernel_sources EXCLUDE REGEX "/probe_kernels\\.cpp$")
    endif()
    add_library(packtrace_kernels_${isa} OBJECT ${kernel_sources})
    # Fallbacks inline less: they build a seventh faster, and execute up to 1 % more instructions for
    # frames and up to 5 % more for rays from callers (results/feature_sets.json).
    set(feature_sets 0)
    set(inline_limit 1200)
    if(PACKTRACE_FEATURE_SETS AND isa IN_LIST with_feature_sets)
        set(feature_sets 1)
        set(inline_limit 100000)
    endif()
    # With -O1 the fallback for processors without AVX builds a third faster, and executes 1 to 7 %
    # more instructions (results/feature_sets.json).
    set(optimisation ${packtrace_frame_flags})
    if(isa STREQUAL "sse42")
        set(optimisation -O1)
    endif()
    target_compile_definitions(packtrace_kernels_${isa} PRIVATE
        PACKTRACE_ISA=${isa} PACKTRACE_LANES=${lanes} PACKTRACE_FEATURE_SETS=${feature_sets})
    target_include_directories(packtrace_kernels_${isa} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
    target_compile_options(packtrace_kernels_${isa} PRIVATE ${baseline} ${ARGN} -fvisibility=hidden
        -fno-exceptions -fno-lto -fno-stack-protector
        $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized$<SEMICOLON>-Wno-uninitialized>
        $<$<NOT:$<CONFIG:Release,RelWithDebInfo,MinSizeRel>>:-O2>
        "$<$<CONFIG:Release>:${optimisation}>"
        $<$<CXX_COMPILER_ID:GNU>:-finline-limit=${inline_limit}>
        $<$<CXX_COMPILER_ID:GNU>:--param=inline-unit-growth=1000>
        $<$<CXX_COMPILER_ID:GNU>:--param=large-function-growth=10000>)
    target_link_libraries(packtrace_kernels_${isa} PRIVATE packtrace_flags packtrace_xsimd)
    set_target_properties(packtrace_kernels_${isa} PROPERTIES INTERPROCEDURAL_OPTIMIZATION OFF
                          UNITY_BUILD OFF POSITION_INDEPENDENT_CODE ON)
    set(PACKTRACE_KERNELS ${PACKTRACE_KERNELS} ${isa} CACHE INTERNAL "")
endfunction()

# The same kernels with packets of one lane, which the compiler must not vectorise: they separate
# what SIMD gains from what the algorithm gains.
set(not_vectorised -fno-tree-vectorize -fno-tree-slp-vectorize)

# GCC moves values out of loops and branches, for which AVX2 mostly has no registers left. Without
# that, frames on AVX2 execute 1 to 2 % fewer instructions, and rays up to 6 % fewer
# (results/feature_sets.json). AVX-512 has twice as many registers, and was not measured.
set(few_registers
    $<$<CXX_COMPILER_ID:GNU>:-fno-code-hoisting$<SEMICOLON>-fno-tree-loop-im>)

if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    packtrace_kernel(one_lane 1 -mavx2 -mfma -mbmi -mbmi2 -mpopcnt ${not_vectorised})
    packtrace_kernel(sse42 4 -msse4.2 -mpopcnt)
    packtrace_kernel(sse_fma 4 -mavx2 -mfma -mbmi -mbmi2 -mpopcnt)
    packtrace_kernel(avx2 8 -mavx2 -mfma -mbmi -mbmi2 -mpopcnt ${few_registers})
    packtrace_kernel(avx512 16 -mavx512f -mavx512cd -mavx512dq -mavx512bw -mavx512vl
                     -mavx2 -mfma -mbmi -mbmi2 -mpopcnt -mprefer-vector-width=512)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
    packtrace_kernel(one_lane 1 ${not_vectorised})
    packtrace_kernel(neon64 4)
else()
    message(FATAL_ERROR "packtrace: no kernels for ${CMAKE_SYSTEM_PROCESSOR}; "
                        "it runs on x86-64 and 64-bit Arm")
endif()
foreach(isa IN LISTS PACKTRACE_ISAS)
    if(NOT isa STREQUAL "all" AND NOT isa IN_LIST PACKTRACE_KERNELS)
        message(FATAL_ERROR "packtrace: PACKTRACE_ISAS names '${isa}', which this processor family "
                            "has no kernels for")
    endif()
endforeach()
if(NOT PACKTRACE_KERNELS)
    message(FATAL_ERROR "packtrace: PACKTRACE_ISAS is empty; give all, or a list such as sse42;avx2")
endif()

# The list that src/dispatch includes: KERNELS(isa), and PROBES(isa) if built, for each instruction
# set.
set(kernel_list "")
foreach(isa IN LISTS PACKTRACE_KERNELS)
    string(APPEND kernel_list "KERNELS(${isa})\n")
    if(PACKTRACE_BUILD_STUDY)
        string(APPEND kernel_list "PROBES(${isa})\n")
    endif()
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/dispatch/kernel_list.inc CONTENT "${kernel_list}")
