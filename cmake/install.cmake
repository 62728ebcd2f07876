include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS steradian_kernels steradian EXPORT steradian-targets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/steradian DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/kernels/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/steradian/kernels
        PATTERN *_cases.glsl EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(STERADIAN_APPS)
  install(TARGETS steradian_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

# A static library passes on what it is made of: whoever links ours needs these, under the same names.
set(STERADIAN_DEPENDENCIES "")
foreach(package OpenEXR fmt simdjson PNG JPEG TBB "embree 3" NLopt pugixml)
  string(APPEND STERADIAN_DEPENDENCIES "find_dependency(${package})\n")
endforeach()

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/steradian)
install(EXPORT steradian-targets NAMESPACE steradian:: DESTINATION ${config_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/steradian-config.cmake.in
  ${PROJECT_BINARY_DIR}/steradian-config.cmake INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/steradian-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/steradian-config.cmake ${PROJECT_BINARY_DIR}/steradian-config-version.cmake
        DESTINATION ${config_dir})
