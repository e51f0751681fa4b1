option(PRESA_TESTS "Build the tests" ON)
set(PRESA_SANITIZE "" CACHE STRING "Value for -fsanitize= (address,undefined or thread); empty: none")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/presa)
# the program finds its libraries beside itself, wherever the folder is moved
set(CMAKE_BUILD_RPATH "$ORIGIN/../lib/presa;$ORIGIN")

add_library(presa_options INTERFACE)
# no -ffast-math and no -march: results are the same to the bit on every x86-64
target_compile_options(presa_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wno-restrict -Werror=return-type
  -ffp-contract=off -fno-math-errno
  -fno-semantic-interposition # nobody replaces our functions at load time: they may be inlined within their library
  -fPIC) # programs, too: one set of precompiled headers serves all
target_include_directories(presa_options INTERFACE ${PROJECT_SOURCE_DIR})
target_link_libraries(presa_options INTERFACE Eigen3::Eigen Boost::headers Threads::Threads)
if(PRESA_SANITIZE)
  target_compile_options(presa_options INTERFACE -fsanitize=${PRESA_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(presa_options INTERFACE -fsanitize=${PRESA_SANITIZE})
endif()

# presa_plugin(NAME SOURCES a.cpp … LIBRARIES …): the shared object presa_NAME.so, loaded only when a scene calls for it
function(presa_plugin name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_library(presa_${name} SHARED ${ARG_SOURCES})
  set_target_properties(presa_${name} PROPERTIES PREFIX "")
  target_link_libraries(presa_${name} PUBLIC presa_framework PRIVATE ${ARG_LIBRARIES})
endfunction()

# presa_add_each(FOLDER): every sub-folder that has a CMakeLists.txt
function(presa_add_each folder)
  file(GLOB lists CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*/CMakeLists.txt)
  foreach(list IN LISTS lists)
    get_filename_component(dir ${list} DIRECTORY)
    add_subdirectory(${dir})
  endforeach()
endfunction()

# presa_test(NAME LIBRARIES … LAUNCHER …): one GoogleTest program from every .cpp of the calling folder, run by the launcher
function(presa_test name)
  cmake_parse_arguments(ARG "" "" "LIBRARIES;LAUNCHER" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${name} ${sources})
  target_link_libraries(test_${name} PRIVATE presa_framework ${ARG_LIBRARIES} GTest::gtest_main)
  target_compile_definitions(test_${name} PRIVATE PRESA_SOURCE_DIR="${PROJECT_SOURCE_DIR}" PRESA_BINARY_DIR="${CMAKE_BINARY_DIR}")
  if(ARG_LAUNCHER)
    set_target_properties(test_${name} PROPERTIES CROSSCOMPILING_EMULATOR "${ARG_LAUNCHER}")
  endif()
  gtest_discover_tests(test_${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300 LABELS ${name}
    ENVIRONMENT PRESA_WATCH_TRANSPORT=1)
endfunction()
