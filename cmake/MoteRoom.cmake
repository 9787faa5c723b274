# mote_room(<name> [SOURCES ...] [SEES rooms...] [LINKS public libraries...] [TESTS ...] [NIGHTLY ...] [FUZZ ...])
#
# A room is a folder under mote/, a target mote::<name>, its installed headers and one test program per label.
# NIGHTLY files are slow statistics: built with the rest, run by `./check --all` only (ctest label "nightly").
# FUZZ files hold an LLVMFuzzerTestOneInput each: built by the preset "fuzz", run by tools/fuzz.
function(mote_room name)
  cmake_parse_arguments(ARG "" "" "SOURCES;SEES;LINKS;PRIVATE_LINKS;TESTS;TEST_LINKS;NIGHTLY;FUZZ" ${ARGN})
  list(TRANSFORM ARG_SEES PREPEND "mote::")
  set(target mote_${name})
  if(ARG_SOURCES)
    add_library(${target} STATIC ${ARG_SOURCES})
    target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_link_libraries(${target} PUBLIC mote::arithmetic ${ARG_SEES} ${ARG_LINKS} PRIVATE $<BUILD_INTERFACE:mote_strict> ${ARG_PRIVATE_LINKS})
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_link_libraries(${target} INTERFACE mote::arithmetic ${ARG_SEES} ${ARG_LINKS})
  endif()
  add_library(mote::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY MOTE_ROOMS ${target})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mote/${name}
          FILES_MATCHING PATTERN "*.hpp" PATTERN "page" EXCLUDE)
  if(MOTE_TESTS)
    mote_tests(${name}_tests "" SOURCES ${ARG_TESTS} LINKS ${target} ${ARG_TEST_LINKS})
    mote_tests(${name}_nightly nightly SOURCES ${ARG_NIGHTLY} LINKS ${target} ${ARG_TEST_LINKS})
  endif()
  if(MOTE_FUZZ)
    foreach(source IN LISTS ARG_FUZZ)
      mote_fuzz(${source} LINKS ${target} ${ARG_TEST_LINKS})
    endforeach()
  endif()
endfunction()

# mote_tests(<program> <label> SOURCES ... LINKS ...): a GoogleTest program, each case a ctest of its own.
function(mote_tests program label)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  if(NOT ARG_SOURCES)
    return()
  endif()
  add_executable(${program} ${ARG_SOURCES})
  target_link_libraries(${program} PRIVATE ${ARG_LINKS} GTest::gtest_main mote_strict)
  target_precompile_headers(${program} PRIVATE <gtest/gtest.h> <algorithm> <array> <cmath> <functional> <map> <span> <string> <vector>)
  if(label)
    gtest_discover_tests(${program} TEST_PREFIX ${program}. PROPERTIES LABELS ${label} TIMEOUT 3000 DISCOVERY_TIMEOUT 60)
  else()
    gtest_discover_tests(${program} TEST_PREFIX ${program}. PROPERTIES TIMEOUT 600 DISCOVERY_TIMEOUT 60)
  endif()
endfunction()

# mote_fuzz(<file> LINKS ...): the libFuzzer program fuzz/<room>.<file's stem>; seeds in the folder <stem>.corpus/ beside it.
if(MOTE_FUZZ)
  add_custom_target(fuzz)
  file(WRITE ${PROJECT_BINARY_DIR}/fuzz/programs.txt "")
endif()
function(mote_fuzz source)
  cmake_parse_arguments(ARG "" "" "LINKS" ${ARGN})
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME folder)
  cmake_path(GET source STEM stem)
  set(program ${folder}.${stem})
  add_executable(${program} ${source})
  target_link_libraries(${program} PRIVATE ${ARG_LINKS} mote_strict)
  target_link_options(${program} PRIVATE -fsanitize=fuzzer)
  set_target_properties(${program} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/fuzz)
  add_dependencies(fuzz ${program})
  file(APPEND ${PROJECT_BINARY_DIR}/fuzz/programs.txt "${program}\n")
  if(IS_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/${stem}.corpus)
    file(COPY ${CMAKE_CURRENT_SOURCE_DIR}/${stem}.corpus/ DESTINATION ${PROJECT_BINARY_DIR}/fuzz/${program}.corpus)
  endif()
endfunction()

# Whoever includes past rooms.txt breaks the build.
find_program(MOTE_PYTHON python3 REQUIRED)
add_custom_command(
  OUTPUT ${PROJECT_BINARY_DIR}/rooms.stamp
  COMMAND ${MOTE_PYTHON} ${PROJECT_SOURCE_DIR}/tools/check_rooms ${PROJECT_SOURCE_DIR} --stamp ${PROJECT_BINARY_DIR}/rooms.stamp
          --depfile ${PROJECT_BINARY_DIR}/rooms.d
  DEPENDS ${PROJECT_SOURCE_DIR}/tools/check_rooms
  DEPFILE ${PROJECT_BINARY_DIR}/rooms.d
  COMMENT "Who includes whom: tools/check_rooms" VERBATIM)
add_custom_target(mote_rooms ALL DEPENDS ${PROJECT_BINARY_DIR}/rooms.stamp)
