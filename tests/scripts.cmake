# Tests that are scripts rather than Catch2 cases. Each has a label, `fast` or `slow`.
function(packtrace_script_test name label script)
    add_test(NAME ${name} COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/${script} ${ARGN}
             COMMAND_EXPAND_LISTS)
    set_tests_properties(${name} PROPERTIES LABELS ${label})
endfunction()

packtrace_script_test(rooms fast check_rooms.sh ${PROJECT_SOURCE_DIR}/src
                      ${PROJECT_SOURCE_DIR}/docs/architecture.md)

foreach(isa IN LISTS PACKTRACE_KERNELS)
    set(objects $<TARGET_OBJECTS:packtrace_kernels_${isa}>)
    packtrace_script_test(symbols.${isa} fast check_symbols.sh ${CMAKE_NM} ${isa} ${objects})
endforeach()

if("sse42" IN_LIST PACKTRACE_KERNELS)
    foreach(isa IN LISTS PACKTRACE_KERNELS)
        set(objects $<TARGET_OBJECTS:packtrace_kernels_${isa}>)
        packtrace_script_test(instructions.${isa} fast check_instructions.sh ${CMAKE_OBJDUMP}
                              ${CMAKE_OBJCOPY} ${isa} ${objects})
    endforeach()
    # The library's objects outside the kernels, in the library's order.
    set(host_objects "")
    foreach(target packtrace_objects packtrace_study_objects packtrace_stamp)
        if(TARGET ${target})
            list(APPEND host_objects $<FILTER:$<TARGET_OBJECTS:${target}>,EXCLUDE,\\.[gp]ch$>)
        endif()
    endforeach()
    set(library_objects ${host_objects})
    foreach(isa IN LISTS PACKTRACE_KERNELS)
        list(APPEND library_objects $<TARGET_OBJECTS:packtrace_kernels_${isa}>)
    endforeach()
    packtrace_script_test(instructions.host fast check_instructions.sh ${CMAKE_OBJDUMP}
                          ${CMAKE_OBJCOPY} host ${host_objects})
    packtrace_script_test(instructions.library fast check_library.sh ${CMAKE_AR}
                          $<TARGET_FILE:packtrace> ${library_objects})
endif()

if("sse42" IN_LIST PACKTRACE_KERNELS AND "avx2" IN_LIST PACKTRACE_KERNELS)
    find_program(PACKTRACE_QEMU NAMES qemu-x86_64 qemu-x86_64-static
                 DOC "Emulator of a processor without AVX (qemu-user)")
    set(without_avx check_without_avx.sh "${PACKTRACE_QEMU}" $<TARGET_FILE:packtrace_tests>
        $<TARGET_FILE:packtrace_cli>)
    packtrace_script_test(without_avx fast ${without_avx}
                          ${PROJECT_SOURCE_DIR}/scenes/four_spheres.scene "[without_avx],[isa]"
                          ${fail_on_none})
    # Emulation takes tens of times longer: it runs only the families that call each part of the
    # library once. The other families run the same code on more rays, and cases tagged [bulk]
    # repeat what the other cases of their family test on more data.
    set(emulated "")
    foreach(family IN ITEMS read_scene read_camera read_material read_surface read_transform camera
                            image bvh lowering features onedim onedim_kernel onedim_notation)
        list(APPEND emulated "[${family}]~[slow]~[bulk]~[unchecked_avx]")
    endforeach()
    list(JOIN emulated "," emulated)
    packtrace_script_test(without_avx.slow slow ${without_avx} ${PROJECT_SOURCE_DIR}/scenes
                          "${emulated}" ${fail_on_none})
endif()

foreach(example IN ITEMS picture first_hit million_rays animation)
    packtrace_script_test(example.${example} fast check_examples.sh ${example}
                          ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:packtrace_example_${example}>
                          "$<$<STREQUAL:${example},animation>:3>")
endforeach()
packtrace_script_test(example.scalar_against_simd fast check_examples.sh scalar_against_simd
                      env PACKTRACE=${packtrace_program}
                      ${PROJECT_SOURCE_DIR}/examples/scalar_against_simd.sh
                      ${PROJECT_SOURCE_DIR}/scenes/four_spheres.scene)
packtrace_script_test(run_script fast check_run.sh ${PROJECT_SOURCE_DIR}/run)

# Users of the library: programs that find it installed, or include it in their project. A project
# that includes it installs nothing of it.
if(PACKTRACE_INSTALL AND PROJECT_IS_TOP_LEVEL)
    foreach(way IN ITEMS prefix find_package pkg_config add_subdirectory fetch_content)
        packtrace_script_test(install.${way} fast check_install.sh ${way} ${CMAKE_COMMAND}
                              ${CMAKE_CXX_COMPILER} ${PROJECT_BINARY_DIR} ${PROJECT_SOURCE_DIR}
                              ${PACKTRACE_ISAS})
    endforeach()
    set_tests_properties(install.prefix PROPERTIES FIXTURES_SETUP installed)
    packtrace_script_test(install.examples fast check_install.sh examples ${CMAKE_COMMAND}
                          ${CMAKE_CXX_COMPILER} ${PROJECT_BINARY_DIR} ${PROJECT_SOURCE_DIR})
    set_tests_properties(install.find_package install.pkg_config install.examples
                         PROPERTIES FIXTURES_REQUIRED installed)
    packtrace_script_test(packages fast check_packages.sh ${CMAKE_CPACK_COMMAND}
                          ${PROJECT_BINARY_DIR} ${PROJECT_VERSION}
                          "$<$<BOOL:${PACKTRACE_PYTHON}>:${Python_EXECUTABLE}>")
endif()
if(TARGET packtrace_shared)
    packtrace_script_test(exports fast check_exports.sh ${CMAKE_NM} ${CMAKE_OBJDUMP}
                          $<TARGET_FILE:packtrace_shared> ${PROJECT_SOURCE_DIR}/include/packtrace)
endif()
if(packtrace_hardened)
    set(hardened_files $<TARGET_FILE:packtrace_cli>)
    foreach(target IN ITEMS packtrace_shared packtrace_mpi packtrace_python)
        if(TARGET ${target})
            list(APPEND hardened_files $<TARGET_FILE:${target}>)
        endif()
    endforeach()
    packtrace_script_test(hardening fast check_hardening.sh ${CMAKE_READELF}
                          ${PROJECT_BINARY_DIR}/compile_commands.json
                          "$<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:${packtrace_fortify_level}>"
                          ${hardened_files})
endif()
packtrace_script_test(completion fast check_completion.sh ${packtrace_program})

# Documents against their sources, and the public headers' comments.
find_package(Python3 COMPONENTS Interpreter)
if(Python3_Interpreter_FOUND)
    add_test(NAME figures COMMAND ${Python3_EXECUTABLE} -B
             ${CMAKE_CURRENT_SOURCE_DIR}/check_figures.py ${PROJECT_SOURCE_DIR})
    add_test(NAME provenance COMMAND ${Python3_EXECUTABLE} -B
             ${CMAKE_CURRENT_SOURCE_DIR}/check_provenance.py ${CMAKE_COMMAND} ${PROJECT_SOURCE_DIR})
    set_tests_properties(figures provenance PROPERTIES LABELS fast)
    if(PACKTRACE_BUILD_STUDY)
        add_test(NAME commands COMMAND ${Python3_EXECUTABLE} -B
                 ${PROJECT_SOURCE_DIR}/docs/write_commands.py --check ${packtrace_program})
        set_tests_properties(commands PROPERTIES LABELS fast)
    endif()
endif()
if(PACKTRACE_DOXYGEN)
    packtrace_script_test(api_comments fast check_api_comments.sh ${PACKTRACE_DOXYGEN}
                          ${PROJECT_BINARY_DIR}/documents/Doxyfile)
endif()
