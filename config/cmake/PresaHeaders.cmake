# The interface of plug-ins: the headers that their authors compile against (installed by PresaInstall.cmake), and one hash of all of them,
# which the build puts into every plug-in and into the framework. The loader refuses a plug-in with another hash: its idea of where a field or
# a virtual function lies may be wrong, which would crash instead of telling.
set(presa_headers)
foreach(room IN ITEMS core plugin haptics geometry scene device)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/framework/${room}/*.h)
  list(FILTER headers EXCLUDE REGEX "_plugin/|scene/xml/(document_data|schema_compiled|schema_reader).h") # they need libxml2
  list(APPEND presa_headers ${headers})
endforeach()
list(APPEND presa_headers framework/session/module_plugin.h framework/session/view_part.h
  apps/studies/cost/metric.h apps/studies/cost/trace.h
  experiments/runner/psychophysics/axis.h experiments/runner/psychophysics/method.h experiments/runner/psychophysics/method_plugin.h)
foreach(support IN ITEMS alloc_lock_guard body_effect_field drawn_part effect_field friction_track held_tool lockstep_run method_run rendered_body)
  list(APPEND presa_headers tests/support/${support}.h)
endforeach()

set(presa_interface ${PROJECT_BINARY_DIR}/plugin_interface.cpp)
set(listed ${PROJECT_BINARY_DIR}/interface_headers.txt)
list(JOIN presa_headers "\n" lines)
file(CONFIGURE OUTPUT ${listed} CONTENT "${lines}\n" @ONLY)
list(TRANSFORM presa_headers PREPEND ${PROJECT_SOURCE_DIR}/ OUTPUT_VARIABLE paths)
add_custom_command(OUTPUT ${presa_interface} DEPENDS ${paths} ${listed} ${CMAKE_CURRENT_LIST_DIR}/PresaInterface.cmake COMMENT ""
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DHEADERS=${listed} -DVERSION=${PROJECT_VERSION} -DFILE=${presa_interface}
    -P ${CMAKE_CURRENT_LIST_DIR}/PresaInterface.cmake VERBATIM)
add_library(presa_plugin_interface OBJECT ${presa_interface})
add_library(presa_framework_interface OBJECT ${presa_interface})
target_compile_definitions(presa_framework_interface PRIVATE presa_plugin_interface=presa_framework_interface)
set_target_properties(presa_plugin_interface presa_framework_interface PROPERTIES POSITION_INDEPENDENT_CODE ON UNITY_BUILD OFF)
set(PRESA_INTERFACE $<TARGET_OBJECTS:presa_plugin_interface>) # for PresaPlugin.cmake
