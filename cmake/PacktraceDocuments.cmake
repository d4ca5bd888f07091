# What the program itself tells: completions for shells, and man pages, which help2man makes of its
# --help. Both are written by the built program.
set(documents ${PROJECT_BINARY_DIR}/documents)
if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
    message(STATUS "packtrace: no completions and man pages, as the program does not run here")
    return()
endif()

# The names under which each shell looks for completions of packtrace.
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
add_custom_command(OUTPUT ${documents}/man1/packtrace.1
    COMMAND sh ${CMAKE_CURRENT_LIST_DIR}/write_man_pages.sh ${PACKTRACE_HELP2MAN}
            $<TARGET_FILE:packtrace_cli> ${PROJECT_VERSION} ${documents}/man1
    DEPENDS packtrace_cli ${CMAKE_CURRENT_LIST_DIR}/write_man_pages.sh
    COMMENT "Writing man pages" VERBATIM)
add_custom_target(packtrace_man_pages ALL DEPENDS ${documents}/man1/packtrace.1)
install(DIRECTORY ${documents}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT runtime)
