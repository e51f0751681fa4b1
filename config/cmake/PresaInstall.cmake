# What lies below the prefix (cmake --install build --prefix P, ./dev package): program, plug-ins, headers for their authors, scenes.
include(CMakePackageConfigHelpers)

set(presa_exported presa_options presa_framework presa_test_support presa)
set_target_properties(presa_options PROPERTIES EXPORT_NAME options)
set_target_properties(presa_framework PROPERTIES EXPORT_NAME framework)
set_target_properties(presa_test_support PROPERTIES EXPORT_NAME testing)
foreach(room IN ITEMS core plugin haptics geometry scene device)
  add_library(presa_room_${room} INTERFACE)
  target_link_libraries(presa_room_${room} INTERFACE presa_framework)
  set_target_properties(presa_room_${room} PROPERTIES EXPORT_NAME ${room})
  list(APPEND presa_exported presa_room_${room})
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} framework/${room}/*.h)
  list(FILTER headers EXCLUDE REGEX "_plugin/|scene/xml/(document_data|schema_compiled|schema_reader).h") # they need libxml2
  list(APPEND presa_headers ${headers})
endforeach()
list(APPEND presa_headers framework/session/module_plugin.h framework/session/view_part.h
  apps/studies/cost/metric.h apps/studies/cost/trace.h
  experiments/runner/psychophysics/axis.h experiments/runner/psychophysics/method.h experiments/runner/psychophysics/method_plugin.h)
foreach(support IN ITEMS alloc_lock_guard body_effect_field drawn_part effect_field friction_track lockstep_run method_run rendered_body)
  list(APPEND presa_headers tests/support/${support}.h)
endforeach()
foreach(header IN LISTS presa_headers)
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${header} DESTINATION include/presa/${folder})
endforeach()

install(TARGETS ${presa_exported} EXPORT PresaExport
  RUNTIME DESTINATION bin LIBRARY DESTINATION ${PRESA_PLUGIN_DIR} ARCHIVE DESTINATION ${PRESA_PLUGIN_DIR})
install(TARGETS presa_supervisor RUNTIME DESTINATION ${PRESA_PLUGIN_DIR})
install(EXPORT PresaExport NAMESPACE Presa:: DESTINATION lib/cmake/Presa)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/PresaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES config/cmake/PresaConfig.cmake config/cmake/PresaPlugin.cmake ${PROJECT_BINARY_DIR}/PresaConfigVersion.cmake
  DESTINATION lib/cmake/Presa)

install(DIRECTORY config/meshes config/motions config/pictures config/rigs config/scenes config/schema config/temple config/textures
  DESTINATION share/presa/config PATTERN "*.py" EXCLUDE PATTERN "*.tsv" EXCLUDE)
install(DIRECTORY experiments/ DESTINATION share/presa/experiments FILES_MATCHING
  PATTERN "*.xml" PATTERN "*.csv" PATTERN "*.obj" PATTERN "README.md")
install(FILES README.md CHANGELOG.md LICENSE docs/plugins.md DESTINATION share/doc/presa)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME presa)
set(CPACK_PACKAGE_CONTACT "the developers of Presa")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_PACKAGE_DEPENDS libjs-three) # beside the libraries: presa replay --page reads it
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "cmake, make, g++, libeigen3-dev, libboost-dev, libgtest-dev, libgmock-dev") # for authors of plug-ins
set(CPACK_DEBIAN_COMPRESSION_TYPE zstd) # the slowest part of making the package, else
include(CPack)
