# Tests that are scripts rather than Catch2 cases; each has a label, `fast` or `slow`. Builds
# with sanitizers are skipped: their objects are full of the sanitizer's own symbols and calls,
# and they don't run under emulation.
function(packtrace_script_test name label script)
    set(command sh ${CMAKE_CURRENT_SOURCE_DIR}/${script} ${ARGN})
    if(PACKTRACE_SANITIZE)
        set(command sh -c "echo 'skipped: built with -fsanitize=${PACKTRACE_SANITIZE}'; exit 77")
    endif()
    add_test(NAME ${name} COMMAND ${command} COMMAND_EXPAND_LISTS)
    set_tests_properties(${name} PROPERTIES LABELS ${label} SKIP_RETURN_CODE 77)
endfunction()

foreach(isa IN LISTS PACKTRACE_KERNELS)
    set(objects $<TARGET_OBJECTS:packtrace_kernels_${isa}>)
    packtrace_script_test(symbols.${isa} fast check_symbols.sh ${CMAKE_NM} ${isa} ${objects})
endforeach()

if("sse42" IN_LIST PACKTRACE_KERNELS)
    foreach(isa IN LISTS PACKTRACE_KERNELS)
        set(objects $<TARGET_OBJECTS:packtrace_kernels_${isa}>)
        packtrace_script_test(instructions.${isa} fast check_instructions.sh ${CMAKE_OBJDUMP}
                              ${isa} ${objects})
    endforeach()
    packtrace_script_test(instructions.host fast check_instructions.sh ${CMAKE_OBJDUMP} host
                          $<TARGET_OBJECTS:packtrace>)
    packtrace_script_test(instructions.library fast check_instructions.sh ${CMAKE_OBJDUMP} library
                          $<TARGET_FILE:packtrace>)
endif()

if("sse42" IN_LIST PACKTRACE_KERNELS AND "avx2" IN_LIST PACKTRACE_KERNELS)
    find_program(PACKTRACE_QEMU NAMES qemu-x86_64 qemu-x86_64-static
                 DOC "Emulator of a processor without AVX (qemu-user)")
    set(without_avx check_without_avx.sh "${PACKTRACE_QEMU}" $<TARGET_FILE:packtrace_tests>
        $<TARGET_FILE:packtrace_cli> ${PROJECT_SOURCE_DIR}/scenes/four_spheres.scene)
    packtrace_script_test(without_avx fast ${without_avx} "[without_avx],[isa]"
                          ${fail_on_none})
    # Tests of the command line start it outside the emulation. Those of extreme rays, ray trees,
    # samples and the clocks in kernels take minutes within it.
    set(emulated "~[slow]~[unchecked_avx]~[cli]~[compare]~[explain_cli]~[frames]~[intersect_cli]")
    string(APPEND emulated "~[intersect_errors]~[onedim_cli]~[sampling_cli]~[report_cli]~[bench_cli]")
    string(APPEND emulated "~[report_page]~[profile_cli]~[stress]~[kernel_profile]~[profile]")
    string(APPEND emulated "~[explain]~[sampling]")
    packtrace_script_test(without_avx.slow slow ${without_avx} "${emulated}" ${fail_on_none})
endif()
