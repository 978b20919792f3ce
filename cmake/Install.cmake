include(CMakePackageConfigHelpers)

get_property(stages GLOBAL PROPERTY INDET_STAGES)
install(TARGETS ${stages} EXPORT indetTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
get_property(folders GLOBAL PROPERTY INDET_STAGE_FOLDERS)
foreach(folder IN LISTS folders)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder}
    FILES_MATCHING PATTERN "*.h")
endforeach()

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/indet)
install(EXPORT indetTargets NAMESPACE indet:: DESTINATION ${config_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/indetConfig.cmake.in
  ${PROJECT_BINARY_DIR}/indetConfig.cmake INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/indetConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/indetConfig.cmake ${PROJECT_BINARY_DIR}/indetConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/FindGLPK.cmake ${PROJECT_SOURCE_DIR}/cmake/FindGMP.cmake
  ${PROJECT_SOURCE_DIR}/cmake/FindLAPACKE.cmake ${PROJECT_SOURCE_DIR}/cmake/FindSuiteSparse.cmake
  DESTINATION ${config_dir})
# The documents link to each other as they do in the source folder.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
# What users run in other codes, so that indet can read their packings.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/apps/exporters DESTINATION ${CMAKE_INSTALL_DATADIR}/indet)
