# Documents that the built program writes: completions for shells, and man pages, which help2man
# makes of its --help.
set(documents ${PROJECT_BINARY_DIR}/documents)
if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
    message(STATUS "packtrace: no completions and man pages, as the program does not run here")
    return()
endif()

# The file names under which each shell looks for packtrace's completions.
set(completion_files bash/packtrace zsh/_packtrace fish/packtrace.fish)
set(completion_commands "")
foreach(file IN LISTS completion_files)
    get_filename_component(shell ${file} DIRECTORY)
    list(APPEND completion_commands
         COMMAND ${CMAKE_COMMAND} -E make_directory ${documents}/${shell}
         COMMAND packtrace_cli completion ${shell} > ${documents}/${file})
endforeach()
list(TRANSFORM completion_files PREPEND ${documents}/ OUTPUT_VARIABLE completion_outputs)
add_custom_command(OUTPUT ${completion_outputs} ${completion_commands}
                   DEPENDS packtrace_cli COMMENT "Writing completions for bash, zsh and fish" VERBATIM)
add_custom_target(packtrace_completions ALL DEPENDS ${completion_outputs})
install(FILES ${documents}/bash/packtrace COMPONENT runtime
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${documents}/zsh/_packtrace COMPONENT runtime
        DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
install(FILES ${documents}/fish/packtrace.fish COMPONENT runtime
        DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

find_program(PACKTRACE_HELP2MAN help2man DOC "help2man, which makes man pages")
if(NOT PACKTRACE_HELP2MAN)
    message(STATUS "packtrace: no man pages, which need help2man")
    return()
endif()
# packtrace_man_pages(NAME TARGET COMPONENT DESCRIPTION [PAGE…]): the pages of a program, which is
# installed as NAME, and of its commands. They refer to the other PAGEs.
function(packtrace_man_pages name target component description)
    set(folder ${documents}/${component}/man1)
    add_custom_command(OUTPUT ${folder}/${name}.1
        COMMAND ${CMAKE_COMMAND} -E env OMPI_MCA_ess_singleton_isolated=1
                sh ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/write_man_pages.sh ${PACKTRACE_HELP2MAN}
                $<TARGET_FILE:${target}> ${name} ${PROJECT_VERSION} ${folder} ${description} ${ARGN}
        DEPENDS ${target} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/write_man_pages.sh
        COMMENT "Writing man pages of ${name}" VERBATIM)
    add_custom_target(${target}_man_pages ALL DEPENDS ${folder}/${name}.1)
    install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT ${component})
endfunction()
packtrace_man_pages(packtrace packtrace_cli runtime
                    "trace rays through scenes of analytic surfaces, in packets")
# For its help, the program needs no other MPI process.
if(TARGET packtrace_mpi)
    packtrace_man_pages(packtrace-mpi packtrace_mpi mpi "packtrace on many machines, by MPI"
                        packtrace)
endif()
