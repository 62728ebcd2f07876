include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/steradian)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/steradian DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        PATTERN kernels EXCLUDE)  # a link in the source tree, a folder in the installed one
install(DIRECTORY ${PROJECT_SOURCE_DIR}/kernels/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/steradian/kernels
        PATTERN *_cases.glsl EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/dist/ DESTINATION ${CMAKE_INSTALL_DATADIR}/steradian/dist
        PATTERN *.py EXCLUDE PATTERN __pycache__ EXCLUDE PATTERN source EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(STERADIAN_APPS)
  install(TARGETS steradian_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(DIRECTORY ${PROJECT_BINARY_DIR}/texts/share/ DESTINATION ${CMAKE_INSTALL_DATAROOTDIR})  # the manual page, completions
endif()

# One file of targets a layer, so that a program asks for what it uses. A static library passes on what it is made of: whoever
# links one of ours needs its packages, under the same names.
install(TARGETS steradian_kernels EXPORT steradian-kernels)
install(EXPORT steradian-kernels NAMESPACE steradian:: DESTINATION ${config_dir} FILE steradian-kernels.cmake)
set(STERADIAN_TABLE "set(steradian_layers ${STERADIAN_BUILT})\n")
foreach(name ${STERADIAN_BUILT})
  install(TARGETS steradian_${name} EXPORT steradian-${name} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT steradian-${name} NAMESPACE steradian:: DESTINATION ${config_dir} FILE steradian-${name}.cmake)
  string(APPEND STERADIAN_TABLE "set(steradian_${name}_needs ${STERADIAN_${name}_needs})\n"
                                "set(steradian_${name}_packages \"${STERADIAN_${name}_packages}\")\n")
endforeach()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/steradian-config.cmake.in
  ${PROJECT_BINARY_DIR}/steradian-config.cmake INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/steradian-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/steradian-config.cmake ${PROJECT_BINARY_DIR}/steradian-config-version.cmake
        DESTINATION ${config_dir})
