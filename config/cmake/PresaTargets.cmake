option(PRESA_TESTS "Build the tests" ON)
option(PRESA_UNITY "Compile several files of a library or a test at once: a cold build takes a third of the time" ON)
set(PRESA_BATCH 8 CACHE STRING "Files of a library that are compiled at once, and half of those of a test: large batches build faster from nothing, small ones after a change")
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
set(CMAKE_INSTALL_RPATH "${CMAKE_BUILD_RPATH}")

add_library(presa_options INTERFACE)
# no -ffast-math and no -march: results are the same to the bit on every x86-64
target_compile_options(presa_options INTERFACE -ffp-contract=off -fno-math-errno
  -fno-semantic-interposition # nobody replaces our functions at load time: they may be inlined within their library
  -fPIC # programs, too: one set of precompiled headers serves all
  $<BUILD_INTERFACE:-Wall$<SEMICOLON>-Wextra$<SEMICOLON>-Wpedantic$<SEMICOLON>-Wshadow$<SEMICOLON>-Wnon-virtual-dtor$<SEMICOLON>$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>$<SEMICOLON>-Werror=return-type>
  # GCC 12 warns of every std::string that grows, wrongly (its bugs 105329 and 105651)
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds$<SEMICOLON>-Wno-stringop-overflow$<SEMICOLON>-Wno-stringop-overread>>
  # the compiler's own memory is collected later: a build takes an eighth less time, a compilation up to 1.3 GB
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1048576$<SEMICOLON>--param=ggc-min-expand=200>>)
target_compile_features(presa_options INTERFACE cxx_std_20)
target_include_directories(presa_options INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/presa>)
target_link_libraries(presa_options INTERFACE Eigen3::Eigen Boost::headers Threads::Threads)
if(PRESA_SANITIZE)
  # The first finding ends the program: code that goes on after one takes a third more time to compile. Checks of each pointer for null
  # and alignment would double that time: the address sanitizer stops at null as well, and Eigen asserts its alignment.
  target_compile_options(presa_options INTERFACE -fsanitize=${PRESA_SANITIZE} -fno-sanitize-recover=all -fno-sanitize=null,alignment
                         -fno-omit-frame-pointer)
  target_link_options(presa_options INTERFACE -fsanitize=${PRESA_SANITIZE})
endif()

# presa_unity(TARGET ALONE pattern …): compiles its files in batches, but for those that a pattern fits: they have names in their unnamed
# name space that others of the batch have, too.
function(presa_unity target)
  cmake_parse_arguments(ARG "" "" "ALONE" ${ARGN})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${PRESA_UNITY} UNITY_BUILD_BATCH_SIZE ${PRESA_BATCH})
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    foreach(pattern IN LISTS ARG_ALONE)
      if(source MATCHES "${pattern}")
        set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      endif()
    endforeach()
  endforeach()
endfunction()

# presa_library(NAME SHARED COMPILED_QUICKLY LIBRARIES … ALONE …): a static (or shared) library from every .cpp of the calling folder and
# below, without its programs (main.cpp) and without folders that have targets of their own. COMPILED_QUICKLY: nothing in it is worth optimising
function(presa_library name)
  cmake_parse_arguments(ARG "SHARED;COMPILED_QUICKLY" "" "LIBRARIES;ALONE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.cpp)
  list(FILTER sources EXCLUDE REGEX "/main.cpp$")
  file(GLOB rooms CONFIGURE_DEPENDS */CMakeLists.txt) # these have targets of their own
  foreach(room IN LISTS rooms)
    get_filename_component(room ${room} DIRECTORY)
    foreach(source IN LISTS sources)
      cmake_path(IS_PREFIX room ${source} inside)
      if(inside)
        list(REMOVE_ITEM sources ${source})
      endif()
    endforeach()
  endforeach()
  set(kind STATIC)
  if(ARG_SHARED)
    set(kind SHARED)
  endif()
  add_library(presa_${name} ${kind} ${sources})
  target_link_libraries(presa_${name} PUBLIC presa_framework ${ARG_LIBRARIES})
  set_target_properties(presa_${name} PROPERTIES PRESA_COMPILED_QUICKLY ${ARG_COMPILED_QUICKLY})
  presa_unity(presa_${name} ALONE ${ARG_ALONE})
  if(ARG_SHARED)
    install(TARGETS presa_${name} DESTINATION ${PRESA_PLUGIN_DIR})
  endif()
endfunction()

# presa_hide_inlines(PROGRAM): its copies of inline functions are its own. Otherwise the framework and the plug-ins would run them in
# place of theirs, which are optimised more (COMPILED_QUICKLY).
function(presa_hide_inlines program)
  target_link_options(${program} PRIVATE LINKER:--exclude-libs,ALL)
endfunction()

# presa_program(COMMAND MAIN main.cpp LIBRARIES …): the program presa-COMMAND, which `presa COMMAND` starts. The target presa_programs
# builds all of them.
function(presa_program command)
  cmake_parse_arguments(ARG "" "MAIN" "LIBRARIES" ${ARGN})
  if(NOT ARG_MAIN)
    set(ARG_MAIN main.cpp)
  endif()
  add_executable(presa-${command} ${ARG_MAIN})
  target_link_libraries(presa-${command} PRIVATE ${ARG_LIBRARIES})
  presa_hide_inlines(presa-${command})
  add_dependencies(presa_programs presa-${command})
  install(TARGETS presa-${command})
endfunction()

# presa_embed(TARGET HEADER NAMESPACE FILES…): the texts of these files as strings, each under its file's name, so that the program needs
# no file beside itself. HEADER declares them.
function(presa_embed target header namespace)
  get_filename_component(name ${header} NAME_WE)
  set(embedded ${CMAKE_CURRENT_BINARY_DIR}/${target}_${name}.cpp)
  set(text "#include \"${header}\"\nnamespace ${namespace} {\n")
  foreach(file IN LISTS ARGN)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${file})
    get_filename_component(name ${file} NAME_WE)
    file(READ ${PROJECT_SOURCE_DIR}/${file} contents)
    string(APPEND text "const char* const ${name} = R\"TEXT(${contents})TEXT\";\n")
  endforeach()
  file(GENERATE OUTPUT ${embedded} CONTENT "${text}}\n")
  target_sources(${target} PRIVATE ${embedded})
endfunction()

# presa_embed_files(TARGET HEADER NAMESPACE FILES…): their paths and texts, for any number of files of any name. HEADER, in the
# namespace, declares `struct File { const char *path, *text; }` and `const std::vector<File>& files()`.
function(presa_embed_files target header namespace)
  get_filename_component(name ${header} NAME_WE)
  set(embedded ${CMAKE_CURRENT_BINARY_DIR}/${target}_${name}.cpp)
  set(text "#include \"${header}\"\nnamespace ${namespace} {\nconst std::vector<File>& files() {\n  static const std::vector<File> all{\n")
  foreach(file IN LISTS ARGN)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${file})
    file(READ ${PROJECT_SOURCE_DIR}/${file} contents)
    string(APPEND text "{\"${file}\", R\"TEXT(${contents})TEXT\"},\n")
  endforeach()
  file(GENERATE OUTPUT ${embedded} CONTENT "${text}};\n  return all;\n}\n}\n")
  target_sources(${target} PRIVATE ${embedded})
endfunction()

# presa_add_each(FOLDER): every sub-folder that has a CMakeLists.txt
function(presa_add_each folder)
  file(GLOB lists CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*/CMakeLists.txt)
  foreach(list IN LISTS lists)
    get_filename_component(dir ${list} DIRECTORY)
    add_subdirectory(${dir})
  endforeach()
endfunction()

# presa_test(NAME REAL_TIME LIBRARIES … LAUNCHER … ALONE …): one GoogleTest program from every .cpp of the calling folder, run by the launcher;
# REAL_TIME: its threads keep periods of a millisecond, so that no other test may run beside it; TOGETHER: suites whose tests run in one
# process, because what they share takes long to make; APART: suites that need a process of their own, because they choose the plug-ins'
# folder, which a process reads once
function(presa_test name)
  cmake_parse_arguments(ARG "REAL_TIME" "" "LIBRARIES;LAUNCHER;ALONE;TOGETHER;APART" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${name} ${sources})
  target_link_libraries(test_${name} PRIVATE presa_framework ${ARG_LIBRARIES} GTest::gtest_main)
  presa_unity(test_${name} ALONE ${ARG_ALONE})
  math(EXPR batch "2 * ${PRESA_BATCH}")
  set_target_properties(test_${name} PROPERTIES UNITY_BUILD_BATCH_SIZE ${batch})
  target_compile_definitions(test_${name} PRIVATE PRESA_SOURCE_DIR="${PROJECT_SOURCE_DIR}" PRESA_BINARY_DIR="${CMAKE_BINARY_DIR}")
  if(PRESA_SANITIZE)
    target_compile_definitions(test_${name} PRIVATE PRESA_SANITIZE) # tests/support/effort.h
    set(timeout 1200) # whole programs run ten times as long
  else()
    set(timeout 300)
  endif()
  if(ARG_LAUNCHER)
    set_target_properties(test_${name} PROPERTIES CROSSCOMPILING_EMULATOR "${ARG_LAUNCHER}")
  endif()
  set(properties TIMEOUT ${timeout} LABELS ${name} RUN_SERIAL ${ARG_REAL_TIME} ENVIRONMENT PRESA_WATCH_TRANSPORT=1)
  if(PRESA_SANITIZE)
    list(APPEND ARG_TOGETHER ${ARG_APART}) # in a plain build each test has a process
  endif()
  foreach(suite IN LISTS ARG_TOGETHER)
    add_test(NAME ${suite} COMMAND test_${name} --gtest_filter=${suite}.*)
    set_tests_properties(${suite} PROPERTIES ${properties} COST 100) # begins early
  endforeach()
  list(JOIN ARG_TOGETHER ".*:" together)
  set(others)
  if(together)
    set(others "-${together}.*")
  endif()
  if(PRESA_SANITIZE)
    presa_test_in_parts(${name} "${others}" ${properties})
    return()
  endif()
  set(filter)
  if(others)
    set(filter TEST_FILTER "${others}")
  endif()
  gtest_discover_tests(test_${name} ${filter} DISCOVERY_TIMEOUT 60 PROPERTIES ${properties})
endfunction()

# presa_test_in_parts(NAME FILTER PROPERTIES…): about a dozen tests in each process, because a sanitized program takes as long to start as
# most tests to run
function(presa_test_in_parts name filter)
  get_target_property(sources test_${name} SOURCES)
  set(parts 1)
  foreach(source IN LISTS sources)
    file(STRINGS ${source} tests REGEX "^[A-Z_]*TEST(_[FP])?\\(")
    list(LENGTH tests count)
    math(EXPR parts "${parts} + ${count}")
  endforeach()
  math(EXPR parts "(${parts} + 11) / 12")
  math(EXPR last "${parts} - 1")
  set(arguments --gtest_brief=1)
  if(filter)
    list(APPEND arguments --gtest_filter=${filter})
  endif()
  foreach(part RANGE ${last})
    add_test(NAME ${name}/${part} COMMAND test_${name} ${arguments})
    set_tests_properties(${name}/${part} PROPERTIES ${ARGN})
    set_property(TEST ${name}/${part} APPEND PROPERTY ENVIRONMENT GTEST_TOTAL_SHARDS=${parts} GTEST_SHARD_INDEX=${part})
  endforeach()
endfunction()
