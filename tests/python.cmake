# Tests of the Python package, one ctest per file. Python itself has no sanitizers and cannot load a
# module built with them.
if(PACKTRACE_SANITIZE)
    return()
endif()
file(GLOB python_tests CONFIGURE_DEPENDS python/test_*.py)
foreach(file IN LISTS python_tests)
    get_filename_component(name ${file} NAME_WE)
    string(REGEX REPLACE "^test_" "" family ${name})
    add_test(NAME python.${family} COMMAND ${Python_EXECUTABLE} -B -W error -m unittest ${name}
             WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/python)
    set_tests_properties(python.${family} PROPERTIES LABELS fast ENVIRONMENT
        "PYTHONPATH=${PROJECT_BINARY_DIR}/python;PACKTRACE_PROGRAM=$<TARGET_FILE:packtrace_cli>;\
PACKTRACE_EXAMPLES=$<TARGET_FILE_DIR:packtrace_example_million_rays>")
endforeach()
