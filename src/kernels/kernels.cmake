# The kernels: one source, one OBJECT library per instruction set with its own -m flags. They
# never see link-time optimisation, and are optimised in debug builds and in builds of no type too
# (xsimd 8.1 does not compile for AVX-512 at -O0). They are position-independent, for the shared
# library; as their symbols are hidden, this costs nothing.
#
# -finline-limit and its kin make GCC inline xsimd's one-line functions everywhere, so that no
# weak copy of them leaves the object. -Wno-maybe-uninitialized: GCC 12's own AVX-512 header
# starts from undefined registers. -fno-lto: a project around this one may ask for it. -fno-stack-protector: Ubuntu's compilers guard each function that
# has arrays on its stack, which is every one here, and call libc where a guard is broken.
# Probes are asked for shares of a frame, not for speed: they execute some 10 % more instructions so,
# and take little more than half as long to build, which with all instruction sets is a minute and a
# half of one core.
set_source_files_properties(kernels/probe_kernels.cpp PROPERTIES
    COMPILE_OPTIONS "${packtrace_quick_flags}")

set(PACKTRACE_ISAS "all" CACHE STRING
    "Instruction sets to compile kernels for: all, or a list such as sse42;avx2")
set(PACKTRACE_KERNELS "" CACHE INTERNAL "Instruction sets compiled in")

# Those that frames are rendered by where time counts have kernels for sets of features
# (kernel_abi/features.hpp); the others, fallbacks for old processors and for comparison, have the
# general ones only: each set costs seconds to build and a quarter of a megabyte.
set(with_feature_sets avx2 avx512 neon64)
option(PACKTRACE_FEATURE_SETS "Kernels for sets of features; without them, the general ones only" ON)

# Before the flags of an instruction set, so that those of a project around this one add none.
set(baseline "")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set(baseline -march=x86-64 -mno-avx)
endif()

# Unless PACKTRACE_ISAS leaves it out.
function(packtrace_kernel isa lanes)
    if(NOT PACKTRACE_ISAS STREQUAL "all" AND NOT isa IN_LIST PACKTRACE_ISAS)
        return()
    endif()
    file(GLOB kernel_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/kernels/*.cpp)
    # Only studies ask single rays what became of them.
    if(NOT PACKTRACE_BUILD_STUDY)
        list(FILTER kernel_sources EXCLUDE REGEX "/probe_kernels\\.cpp$")
    endif()
    add_library(packtrace_kernels_${isa} OBJECT ${kernel_sources})
    # Fallbacks inline less: they build a seventh faster, and execute up to 1 % more for frames and
    # up to 5 % more for rays (results/feature_sets.json).
    set(feature_sets 0)
    set(inline_limit 1200)
    if(PACKTRACE_FEATURE_SETS AND isa IN_LIST with_feature_sets)
        set(feature_sets 1)
        set(inline_limit 100000)
    endif()
    # The fallback of processors without AVX builds a third faster so, and executes 1 to 7 % more
    # (results/feature_sets.json).
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

# The same kernels in packets of one lane, which no compiler makes wider: what lanes give is told
# apart from what the algorithm gives.
set(not_vectorised -fno-tree-vectorize -fno-tree-slp-vectorize)

# What GCC moves out of loops and branches it mostly has no registers for: without that, AVX2's
# frames execute 1 to 2 % fewer instructions, and rays up to 6 % (results/feature_sets.json). AVX-512
# has twice as many registers, and was not measured.
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

# What src/dispatch knows them by: one line KERNELS(isa) each, and one PROBES(isa).
set(kernel_list "")
foreach(isa IN LISTS PACKTRACE_KERNELS)
    string(APPEND kernel_list "KERNELS(${isa})\n")
    if(PACKTRACE_BUILD_STUDY)
        string(APPEND kernel_list "PROBES(${isa})\n")
    endif()
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/dispatch/kernel_list.inc CONTENT "${kernel_list}")
