# Eigen and the standard library take most of the time that a file of Presa takes to compile. They are parsed once for the tree,
# once more for what is compiled quickly, and once more, with GoogleTest, for the tests (tests/CMakeLists.txt). Files include what they use all the same: -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON shows it.

set(presa_common_headers
  <Eigen/Core> <Eigen/Geometry> <Eigen/LU> <algorithm> <array> <atomic> <chrono> <cmath> <cstdint> <cstdio> <cstdlib> <cstring>
  <filesystem> <fstream> <functional> <limits> <map> <memory> <numbers> <numeric> <optional> <random> <set> <span> <sstream> <stdexcept> <string>
  <string_view> <utility> <variant> <vector>)

# Tests spend their time in the libraries, not in their own code, which takes a third less time to compile this way.
set(presa_test_options $<$<CONFIG:Release>:-O1> $<$<CONFIG:RelWithDebInfo>:-Og>)

# Commands and reports likewise (COMPILED_QUICKLY of presa_library): `./dev run` on a bare machine shows its first grasp 25 s sooner.
set(presa_quick_options)
if(CMAKE_BUILD_TYPE STREQUAL Release)
  set(presa_quick_options -O1)
endif()

# presa_precompiled(NAME HEADERS… LIBRARIES… OPTIONS…): the object library that others take the parsed headers from
function(presa_precompiled name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LIBRARIES;OPTIONS" ${ARGN})
  file(WRITE ${CMAKE_BINARY_DIR}/${name}.cpp.new "")
  configure_file(${CMAKE_BINARY_DIR}/${name}.cpp.new ${CMAKE_BINARY_DIR}/${name}.cpp COPYONLY)
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE presa_options ${ARG_LIBRARIES})
  target_compile_options(${name} PRIVATE ${ARG_OPTIONS})
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
  # what ccache goes by in place of the parsed headers, which are another file in each build folder
  string(SHA256 sum "${ARG_HEADERS} ${ARG_OPTIONS} ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${Eigen3_VERSION} ${GTest_VERSION}")
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${name}.dir/cmake_pch.hxx.gch.sum ${sum})
endfunction()

# presa_precompile(FOLDER): every target below it
function(presa_precompile folder)
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(below IN LISTS folders)
    presa_precompile(${below})
  endforeach()
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(NOT type MATCHES "^(STATIC_LIBRARY|SHARED_LIBRARY|EXECUTABLE)$")
      continue()
    endif()
    set(from presa_precompiled_headers)
    get_target_property(quickly ${target} PRESA_COMPILED_QUICKLY)
    if(quickly AND presa_quick_options)
      set(from presa_precompiled_quick_headers)
      target_compile_options(${target} PRIVATE ${presa_quick_options})
    endif()
    get_target_property(libraries ${target} LINK_LIBRARIES)
    if(libraries MATCHES "GTest::gtest")
      set(from presa_precompiled_test_headers)
      target_compile_options(${target} PRIVATE ${presa_test_options})
    endif()
    target_precompile_headers(${target} REUSE_FROM ${from})
  endforeach()
endfunction()

presa_precompiled(presa_precompiled_headers HEADERS ${presa_common_headers})
if(presa_quick_options)
  presa_precompiled(presa_precompiled_quick_headers HEADERS ${presa_common_headers} OPTIONS ${presa_quick_options})
endif()
