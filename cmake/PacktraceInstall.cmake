# The components of `cmake --install`: `runtime`, which runs packtrace and programs that were built
# with it, `development`, which builds such programs, and `mpi`, the program that needs MPI.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(packtrace_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/packtrace)
set(packtrace_configured ${PROJECT_BINARY_DIR}/install)

# The libraries, each with its own targets file: a user of the shared library needs only GLM.
set(packtrace_kinds static)
install(TARGETS packtrace EXPORT packtrace_static
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
set_target_properties(packtrace PROPERTIES EXPORT_NAME static)
if(TARGET packtrace_shared)
    list(APPEND packtrace_kinds shared)
    install(TARGETS packtrace_shared EXPORT packtrace_shared
            LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime
            NAMELINK_COMPONENT development
            INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
    set_target_properties(packtrace_shared PROPERTIES EXPORT_NAME shared)
endif()
foreach(kind IN LISTS packtrace_kinds)
    install(EXPORT packtrace_${kind} FILE packtrace_${kind}.cmake NAMESPACE packtrace::
            DESTINATION ${packtrace_cmake_dir} COMPONENT development)
endforeach()

# Headers of features that this build lacks would declare functions that no library defines.
set(study_headers "/(certainty|explain|profile|report|write_report)\\.hpp$")
file(GLOB public_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/packtrace/*.hpp)
if(NOT PACKTRACE_BUILD_STUDY)
    list(FILTER public_headers EXCLUDE REGEX "${study_headers}")
endif()
install(FILES ${public_headers} ${PROJECT_BINARY_DIR}/include/packtrace/version.hpp
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/packtrace COMPONENT development)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/packtraceConfig.cmake.in
    ${packtrace_configured}/packtraceConfig.cmake
    INSTALL_DESTINATION ${packtrace_cmake_dir}
    NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${packtrace_configured}/packtraceConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${packtrace_configured}/packtraceConfig.cmake
              ${packtrace_configured}/packtraceConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/FindDeflate.cmake
        DESTINATION ${packtrace_cmake_dir} COMPONENT development)

# Paths in the pkg-config file are relative to the file itself, so that an installation can be
# moved.
set(pkgconfig_dir ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH packtrace_prefix ${pkgconfig_dir} ${CMAKE_INSTALL_PREFIX})
file(RELATIVE_PATH packtrace_libdir ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_LIBDIR})
file(RELATIVE_PATH packtrace_includedir ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_INCLUDEDIR})
configure_file(${CMAKE_CURRENT_LIST_DIR}/packtrace.pc.in ${packtrace_configured}/packtrace.pc @ONLY)
install(FILES ${packtrace_configured}/packtrace.pc
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

if(PACKTRACE_BUILD_PROGRAM)
    install(TARGETS packtrace_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
    if(TARGET packtrace_mpi)
        install(TARGETS packtrace_mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT mpi)
    endif()
    include(PacktraceDocuments)
endif()
file(GLOB example_scenes CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/scenes/*.scene)
install(FILES ${example_scenes}
        DESTINATION ${CMAKE_INSTALL_DATADIR}/packtrace/scenes COMPONENT runtime)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)

# CMake has no such target. A surrounding project has its own.
if(PROJECT_IS_TOP_LEVEL)
    add_custom_target(uninstall VERBATIM COMMAND ${CMAKE_COMMAND}
        -D MANIFEST=${CMAKE_BINARY_DIR}/install_manifest.txt
        -P ${CMAKE_CURRENT_LIST_DIR}/uninstall.cmake)
endif()
