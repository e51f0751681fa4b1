# find_package(Presa): the targets Presa::core, plugin, haptics, geometry, scene, device (one library, a target for each room of headers),
# Presa::testing, the program Presa::presa, and the functions of PresaPlugin.cmake.
include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(Eigen3 NO_MODULE)
find_dependency(Boost)
include(${CMAKE_CURRENT_LIST_DIR}/PresaExport.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/PresaPlugin.cmake)
