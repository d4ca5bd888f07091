# Every dependency comes from the system's packages. What is missing is gathered and said in
# one line, with the command that installs it.
set(missing_packages "")

macro(packtrace_need found package)
    if(NOT ${found})
        list(APPEND missing_packages ${package})
    endif()
endmacro()

find_package(Threads REQUIRED)
find_package(TBB CONFIG QUIET)
packtrace_need(TBB_FOUND libtbb-dev)

find_path(PACKTRACE_XSIMD_DIR xsimd/xsimd.hpp DOC "Folder that holds xsimd/xsimd.hpp")
packtrace_need(PACKTRACE_XSIMD_DIR libxsimd-dev)
find_path(PACKTRACE_GLM_DIR glm/glm.hpp DOC "Folder that holds glm/glm.hpp")
packtrace_need(PACKTRACE_GLM_DIR libglm-dev)
find_path(PACKTRACE_PEGTL_DIR tao/pegtl.hpp DOC "Folder that holds tao/pegtl.hpp")
packtrace_need(PACKTRACE_PEGTL_DIR tao-pegtl-dev)
find_path(PACKTRACE_CLI11_DIR CLI/CLI.hpp DOC "Folder that holds CLI/CLI.hpp")
packtrace_need(PACKTRACE_CLI11_DIR libcli11-dev)
find_path(PACKTRACE_JSON_DIR nlohmann/json.hpp DOC "Folder that holds nlohmann/json.hpp")
packtrace_need(PACKTRACE_JSON_DIR nlohmann-json3-dev)
find_path(PACKTRACE_STB_DIR stb_image_write.h PATH_SUFFIXES stb
          DOC "Folder that holds stb_image_write.h")
packtrace_need(PACKTRACE_STB_DIR libstb-dev)
find_path(PACKTRACE_DEFLATE_DIR libdeflate.h DOC "Folder that holds libdeflate.h")
find_library(PACKTRACE_DEFLATE_LIBRARY deflate DOC "libdeflate")
packtrace_need(PACKTRACE_DEFLATE_LIBRARY libdeflate-dev)

find_path(PACKTRACE_BOOST_DIR boost/multiprecision/cpp_bin_float.hpp
          DOC "Folder that holds boost/multiprecision")
packtrace_need(PACKTRACE_BOOST_DIR libboost-dev)

if(PACKTRACE_BUILD_TESTS)
    find_package(Catch2 CONFIG QUIET)
    packtrace_need(Catch2_FOUND catch2)
endif()
if(PACKTRACE_BUILD_BENCH)
    find_package(benchmark CONFIG QUIET)
    packtrace_need(benchmark_FOUND libbenchmark-dev)
endif()

if(missing_packages)
    list(JOIN missing_packages " " packages)
    message(FATAL_ERROR "packtrace: missing ${packages}; type: sudo apt-get install ${packages}")
endif()

# Third-party headers as system headers, so that their warnings are not ours.
function(packtrace_header_library name directory)
    add_library(${name} INTERFACE)
    target_include_directories(${name} SYSTEM INTERFACE ${directory})
endfunction()
packtrace_header_library(packtrace_xsimd ${PACKTRACE_XSIMD_DIR})
packtrace_header_library(packtrace_glm ${PACKTRACE_GLM_DIR})
packtrace_header_library(packtrace_pegtl ${PACKTRACE_PEGTL_DIR})
packtrace_header_library(packtrace_cli11 ${PACKTRACE_CLI11_DIR})
packtrace_header_library(packtrace_json ${PACKTRACE_JSON_DIR})
packtrace_header_library(packtrace_stb ${PACKTRACE_STB_DIR})
packtrace_header_library(packtrace_boost ${PACKTRACE_BOOST_DIR})
packtrace_header_library(packtrace_deflate ${PACKTRACE_DEFLATE_DIR})
target_link_libraries(packtrace_deflate INTERFACE ${PACKTRACE_DEFLATE_LIBRARY})
