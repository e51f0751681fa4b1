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
endforeach()
foreach(header IN LISTS presa_headers)
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${header} DESTINATION include/presa/${folder} COMPONENT headers)
endforeach()

install(TARGETS ${presa_exported} EXPORT PresaExport
  RUNTIME DESTINATION bin LIBRARY DESTINATION ${PRESA_PLUGIN_DIR} ARCHIVE DESTINATION ${PRESA_PLUGIN_DIR})
install(TARGETS presa_supervisor RUNTIME DESTINATION ${PRESA_PLUGIN_DIR})
install(EXPORT PresaExport NAMESPACE Presa:: DESTINATION lib/cmake/Presa)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/PresaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES config/cmake/PresaConfig.cmake config/cmake/PresaPlugin.cmake ${PROJECT_BINARY_DIR}/PresaConfigVersion.cmake
  ${presa_interface} DESTINATION lib/cmake/Presa)

install(DIRECTORY config/cave config/meshes config/motions config/pictures config/rigs config/scenes config/schema config/temple config/textures
  DESTINATION share/presa/config PATTERN "*.py" EXCLUDE PATTERN "*.tsv" EXCLUDE)
install(DIRECTORY experiments/ DESTINATION share/presa/experiments FILES_MATCHING
  PATTERN "*.xml" PATTERN "*.csv" PATTERN "*.obj" PATTERN "README.md")
install(FILES README.md CHANGELOG.md LICENSE DESTINATION share/doc/presa)
install(DIRECTORY docs/ DESTINATION share/doc/presa/docs FILES_MATCHING PATTERN "*.md" PATTERN _static EXCLUDE)

# bash looks for completions of a program in the share folder beside its bin
install(FILES config/shell/presa.bash DESTINATION share/bash-completion/completions RENAME presa)
# the pages say what the installed program says of itself
install(CODE "execute_process(COMMAND \"${PROJECT_SOURCE_DIR}/config/shell/man_pages.sh\" \"${PROJECT_BINARY_DIR}/bin/presa\"
  \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/share/man/man1\" ${PROJECT_VERSION} COMMAND_ERROR_IS_FATAL ANY)")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME presa)
set(CPACK_PACKAGE_CONTACT "the developers of Presa")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/PresaPackageDepends.cmake)
set(CPACK_DEBIAN_PACKAGE_DEPENDS libjs-three) # beside the libraries: presa replay --page reads it
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "cmake, make, g++, libeigen3-dev, libboost-dev, libgtest-dev, libgmock-dev, python3-numpy, python3-h5py") # for authors of plug-ins, and for programs in Python
set(CPACK_DEBIAN_COMPRESSION_TYPE zstd) # the slowest part of making the package, else
include(CPack)
