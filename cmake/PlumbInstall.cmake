# `cmake --install` and find_package(plumb).
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY PLUMB_MODULES)
install(TARGETS ${modules} plumb_flags EXPORT plumbTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT plumbTargets NAMESPACE plumb:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/plumb)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/plumbConfig.cmake.in ${PROJECT_BINARY_DIR}/plumbConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/plumb)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/plumbConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/plumbConfig.cmake ${PROJECT_BINARY_DIR}/plumbConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/PlumbDependencies.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/plumb)
