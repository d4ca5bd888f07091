# `cpack` in the build folder makes Debian packages, one of each installed component:
#   packtrace          runtime: the program, the shared library, example scenes
#   libpacktrace-dev   development: headers, the static library, CMake and pkg-config files
#   packtrace-mpi      mpi: the program for many ranks, if MPI is installed
#   python3-packtrace  python: the Python package, with PACKTRACE_PYTHON=ON
# A package made on Debian 12 also installs on Debian 13, except the Python package.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME packtrace)
set(CPACK_PACKAGE_VENDOR "The packtrace authors")
set(CPACK_PACKAGE_CONTACT "The packtrace authors <packtrace@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)

get_cmake_property(CPACK_COMPONENTS_ALL COMPONENTS)
list(REMOVE_ITEM CPACK_COMPONENTS_ALL Unspecified)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME packtrace)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION graphics)
# Draws the plots of reports.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS gnuplot-nox)
# Names the package with the shared library, for packages of programs that need it. CPack would also
# write this file, but would include the Python module, which no program links.
file(WRITE ${PROJECT_BINARY_DIR}/install/shlibs "libpacktrace \
${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} packtrace (= ${PROJECT_VERSION})\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/install/shlibs)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
    "The program packtrace, the shared library, and example scenes.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libpacktrace-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "packtrace (= ${PROJECT_VERSION}), libglm-dev, libtbb-dev, libpng-dev, libdeflate-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "Headers, the static library, and what CMake and pkg-config find them by.")

set(CPACK_DEBIAN_MPI_PACKAGE_NAME packtrace-mpi)
set(CPACK_DEBIAN_MPI_PACKAGE_SECTION graphics)
# The package with mpirun of the MPI that the program is linked to.
set(CPACK_DEBIAN_MPI_PACKAGE_RECOMMENDS openmpi-bin)
if("${MPI_CXX_LIBRARIES}" MATCHES mpich)
    set(CPACK_DEBIAN_MPI_PACKAGE_RECOMMENDS mpich)
endif()
set(CPACK_DEBIAN_MPI_PACKAGE_SUGGESTS packtrace)
set(CPACK_COMPONENT_MPI_DESCRIPTION
    "The program packtrace-mpi, which renders, intersects and studies on many machines.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-packtrace)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
# A module works with one Python version: that of the Debian it was built on.
if(PACKTRACE_PYTHON)
    math(EXPR next_python "${Python_VERSION_MINOR} + 1")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3-numpy, \
python3 (>= 3.${Python_VERSION_MINOR}~), python3 (<< 3.${next_python})")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
        ${CMAKE_CURRENT_LIST_DIR}/python3-packtrace/prerm)
endif()
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "The Python module packtrace.")

# Debian's own places for licences and for zsh completions.
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian_paths.cmake)
include(CPack)
