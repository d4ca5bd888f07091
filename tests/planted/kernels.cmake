# Kernels of the narrowest instruction set with a planted defect, for the test that reports detect
# it. The sources are the usual ones; the headers of this folder precede the real ones.
list(GET PACKTRACE_KERNELS 0 planted_isa)
get_target_property(planted_options packtrace_kernels_${planted_isa} COMPILE_OPTIONS)
add_library(packtrace_planted OBJECT ${CMAKE_CURRENT_LIST_DIR}/planted_table.cpp)
target_compile_definitions(packtrace_planted PRIVATE PACKTRACE_ISA=planted PACKTRACE_LANES=4)
# Fast to build rather than fast to run; the bits of the results are the same.
target_compile_options(packtrace_planted PRIVATE ${planted_options} ${packtrace_quick_flags})
target_include_directories(packtrace_planted PRIVATE ${CMAKE_CURRENT_LIST_DIR}
                           ${PROJECT_SOURCE_DIR}/src)
target_link_libraries(packtrace_planted PRIVATE packtrace_flags packtrace_xsimd)
set_target_properties(packtrace_planted PROPERTIES UNITY_BUILD OFF)
target_sources(packtrace_tests PRIVATE $<TARGET_OBJECTS:packtrace_planted>)
