# Every dependency comes from the system's packages. One message lists all missing packages, with
# the command that installs them.
set(missing_packages "")

# Dependencies of the library. If packtrace is a part of another project, that project's targets
# link to them too: so they must be visible outside this folder.
# are linked to them too: they must be known outside this folder.
set(packtrace_linked glm::glm TBB::tbb PNG::PNG ZLIB::ZLIB Deflate::Deflate Threads::Threads)
set(packtrace_known "")
foreach(target IN LISTS packtrace_linked)
    if(TARGET ${target})
        list(APPEND packtrace_known ${target})
    endif()
endforeach()

macro(packtrace_need found package)
    if(NOT ${found})
        list(APPEND missing_packages ${package})
    endif()
endmacro()

find_package(Threads REQUIRED)
find_package(TBB CONFIG QUIET)
packtrace_need(TBB_FOUND libtbb-dev)
find_package(glm CONFIG QUIET)
packtrace_need(glm_FOUND libglm-dev)
find_package(Deflate MODULE QUIET)
packtrace_need(Deflate_FOUND libdeflate-dev)
find_package(PNG QUIET)
packtrace_need(PNG_FOUND libpng-dev)

find_path(PACKTRACE_XSIMD_DIR xsimd/xsimd.hpp DOC "Folder that holds xsimd/xsimd.hpp")
packtrace_need(PACKTRACE_XSIMD_DIR libxsimd-dev)
find_path(PACKTRACE_PEGTL_DIR tao/pegtl.hpp DOC "Folder that holds tao/pegtl.hpp")
packtrace_need(PACKTRACE_PEGTL_DIR tao-pegtl-dev)
find_path(PACKTRACE_JSON_DIR nlohmann/json.hpp DOC "Folder that holds nlohmann/json.hpp")
packtrace_need(PACKTRACE_JSON_DIR nlohmann-json3-dev)
find_path(PACKTRACE_STB_DIR stb_image_write.h PATH_SUFFIXES stb
          DOC "Folder that holds stb_image_write.h")
packtrace_need(PACKTRACE_STB_DIR libstb-dev)

if(PACKTRACE_BUILD_PROGRAM)
    find_path(PACKTRACE_CLI11_DIR CLI/CLI.hpp DOC "Folder that holds CLI/CLI.hpp")
    packtrace_need(PACKTRACE_CLI11_DIR libcli11-dev)
endif()
if(PACKTRACE_BUILD_STUDY)
    find_path(PACKTRACE_BOOST_DIR boost/multiprecision/cpp_bin_float.hpp
              DOC "Folder that holds boost/multiprecision")
    packtrace_need(PACKTRACE_BOOST_DIR libboost-dev)
endif()
if(PACKTRACE_BUILD_TESTS)
    find_package(Catch2 CONFIG QUIET)
    packtrace_need(Catch2_FOUND catch2)
endif()
if(PACKTRACE_BUILD_BENCH)
    find_package(benchmark CONFIG QUIET)
    packtrace_need(benchmark_FOUND libbenchmark-dev)
endif()

if(PACKTRACE_PYTHON)
    # For the Python that PATH finds; -DPython_EXECUTABLE selects another one.
    set(Python_FIND_STRATEGY LOCATION)
    find_package(Python 3.10 COMPONENTS Interpreter Development.Module QUIET)
    packtrace_need(Python_FOUND python3-dev)
    set(PYBIND11_FINDPYTHON ON)
    if(Python_FOUND)
        find_package(pybind11 2.10 CONFIG QUIET)
    endif()
    packtrace_need(pybind11_FOUND pybind11-dev)
    if(Python_FOUND AND PACKTRACE_BUILD_TESTS)
        execute_process(COMMAND ${Python_EXECUTABLE} -c "import numpy" RESULT_VARIABLE no_numpy
                        OUTPUT_QUIET ERROR_QUIET)
        if(NOT no_numpy EQUAL 0)
            list(APPEND missing_packages python3-numpy)
        endif()
    endif()
endif()

# Optional: without MPI, packtrace-mpi is not built. A cross build cannot use this machine's MPI,
# and sanitizers find leaks in MPI itself.
if(PACKTRACE_BUILD_PROGRAM AND PACKTRACE_BUILD_MPI AND NOT CMAKE_CROSSCOMPILING AND
   NOT PACKTRACE_SANITIZE)
    find_package(MPI QUIET COMPONENTS CXX)
    if(NOT MPI_CXX_FOUND)
        message(STATUS "packtrace: no MPI here, so packtrace-mpi is left out; to build it, type: "
                       "sudo apt-get install libopenmpi-dev openmpi-bin")
    endif()
endif()

if(missing_packages)
    list(JOIN missing_packages " " packages)
    message(FATAL_ERROR "packtrace: missing ${packages}; type: sudo apt-get install ${packages}")
endif()

foreach(target IN LISTS packtrace_linked)
    if(TARGET ${target} AND NOT target IN_LIST packtrace_known)
        set_target_properties(${target} PROPERTIES IMPORTED_GLOBAL TRUE)
    endif()
endforeach()

# Third-party headers count as system headers, so that their warnings are hidden.
function(packtrace_header_library name directory)
    add_library(${name} INTERFACE)
    target_include_directories(${name} SYSTEM INTERFACE ${directory})
endfunction()
packtrace_header_library(packtrace_xsimd ${PACKTRACE_XSIMD_DIR})
packtrace_header_library(packtrace_pegtl ${PACKTRACE_PEGTL_DIR})
packtrace_header_library(packtrace_json ${PACKTRACE_JSON_DIR})
packtrace_header_library(packtrace_stb ${PACKTRACE_STB_DIR})
if(PACKTRACE_BUILD_PROGRAM)
    packtrace_header_library(packtrace_cli11 ${PACKTRACE_CLI11_DIR})
endif()
if(PACKTRACE_BUILD_STUDY)
    packtrace_header_library(packtrace_boost ${PACKTRACE_BOOST_DIR})
endif()
