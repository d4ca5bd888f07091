# Doxygen reads the public headers: cmake --build --preset release --target api_documents, into
# documents/api of the build folder. A test checks that Doxygen gives no warning.
find_program(PACKTRACE_DOXYGEN doxygen DOC "Doxygen, which makes the reference of the headers")
if(PACKTRACE_DOXYGEN)
    set(PACKTRACE_API_DOCUMENTS ${PROJECT_BINARY_DIR}/documents/api)
    configure_file(${PROJECT_SOURCE_DIR}/docs/Doxyfile.in ${PROJECT_BINARY_DIR}/documents/Doxyfile
                   @ONLY)
    file(MAKE_DIRECTORY ${PACKTRACE_API_DOCUMENTS})
    add_custom_target(api_documents COMMAND ${PACKTRACE_DOXYGEN} ${PROJECT_BINARY_DIR}/documents/Doxyfile
                      COMMENT "Writing the reference of the public headers" VERBATIM)
endif()
