# Plug-ins, in Presa's tree or in a project of their own that says find_package(Presa): a folder builds the same in both.
if(NOT PRESA_INTERFACE) # installed beside this file
  set(PRESA_INTERFACE ${CMAKE_CURRENT_LIST_DIR}/plugin_interface.cpp)
endif()
set(PRESA_PLUGIN_DIR lib/presa) # below the prefix; plug-ins, their manifests, and the libraries that only Presa uses

# presa_interface_of(TARGET): puts the hash of the headers that this shared object is compiled against into it. Without it, it is refused.
function(presa_interface_of target)
  target_sources(${target} PRIVATE ${PRESA_INTERFACE})
endfunction()

# presa_plugin(NAME SOURCES a.cpp … LIBRARIES … ALONE …): the shared object presa_NAME.so, loaded only when a scene calls for it,
# and beside it presa_NAME.xml, the folder's manifest.xml, if it has one, with the version of the project. ALONE: see presa_unity in PresaTargets.cmake.
function(presa_plugin name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES;ALONE" ${ARGN})
  set(folder ${CMAKE_BINARY_DIR}/${PRESA_PLUGIN_DIR})
  if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/manifest.xml)
    configure_file(manifest.xml ${folder}/presa_${name}.xml @ONLY)
    install(FILES ${folder}/presa_${name}.xml DESTINATION ${PRESA_PLUGIN_DIR})
  endif()
  add_library(presa_${name} SHARED ${ARG_SOURCES})
  set_target_properties(presa_${name} PROPERTIES PREFIX "" PRESA_PLUGIN ON LIBRARY_OUTPUT_DIRECTORY ${folder})
  target_link_libraries(presa_${name} PUBLIC Presa::framework PRIVATE ${ARG_LIBRARIES})
  if(COMMAND presa_unity)
    presa_unity(presa_${name} ALONE ${ARG_ALONE})
  endif()
  presa_interface_of(presa_${name})
  install(TARGETS presa_${name} DESTINATION ${PRESA_PLUGIN_DIR})
endfunction()

# presa_plugin_test(NAME SOURCES a_test.cpp …): a GoogleTest program that finds this project's plug-ins. SCENE_DIR is its folder `scene`.
function(presa_plugin_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES" ${ARGN})
  find_package(GTest REQUIRED)
  include(GoogleTest)
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE Presa::testing GTest::gtest_main)
  target_compile_definitions(test_${name} PRIVATE SCENE_DIR="${CMAKE_CURRENT_SOURCE_DIR}/scene")
  add_dependencies(test_${name} presa_${name})
  gtest_discover_tests(test_${name} PROPERTIES ENVIRONMENT
    "PRESA_PLUGIN_PATH=${CMAKE_BINARY_DIR}/${PRESA_PLUGIN_DIR};PRESA_WATCH_TRANSPORT=1")
endfunction()
