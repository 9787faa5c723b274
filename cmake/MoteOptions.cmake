# How everything is compiled: one interface target that every room links.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
find_program(MOTE_CCACHE ccache)
if(MOTE_CCACHE)
  # g++'s precompiled headers of the tests are cached only with this allowance; the base makes clones share the cache.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
      CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} ${MOTE_CCACHE})
endif()
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

# What a user of the headers must also have: the language and the arithmetic.
# -ffp-contract=off: the same lines give the same bits on every machine and in every number type (a recorded graph
# evaluates a*b+c in two roundings, so must the direct call). -fno-math-errno: sqrt and friends compile to instructions.
add_library(mote_arithmetic INTERFACE)
add_library(mote::arithmetic ALIAS mote_arithmetic)
set_target_properties(mote_arithmetic PROPERTIES EXPORT_NAME arithmetic)
target_compile_features(mote_arithmetic INTERFACE cxx_std_20)
target_compile_options(mote_arithmetic INTERFACE -ffp-contract=off -fno-math-errno)
# Eigen's alignment depends on -march; without vectors a program and an installed library always agree (its matrices are small here).
target_compile_definitions(mote_arithmetic INTERFACE EIGEN_DONT_VECTORIZE)

# What only our own files are compiled with; mote_strict adds the processor that they are compiled for.
add_library(mote_warnings INTERFACE)
add_library(mote_strict INTERFACE)
target_link_libraries(mote_strict INTERFACE mote_warnings)
target_compile_options(mote_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror
                       $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>)  # clang counts it to -Wconversion, g++ does not
# g++ 12 sees these in memcpy and intrinsics that it has inlined from libstdc++ and Boost, where the sizes are right.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(mote_warnings INTERFACE -Wno-stringop-overread -Wno-stringop-overflow -Wno-maybe-uninitialized -Wno-array-bounds -Wno-restrict)
endif()
if(MOTE_NATIVE)
  target_compile_options(mote_strict INTERFACE -march=native)
endif()
if(MOTE_SANITIZE)
  target_compile_options(mote_warnings INTERFACE -fsanitize=${MOTE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(mote_warnings INTERFACE -fsanitize=${MOTE_SANITIZE})
endif()
if(MOTE_COVERAGE)
  target_compile_options(mote_warnings INTERFACE --coverage -fprofile-update=atomic -Og)
  target_link_options(mote_warnings INTERFACE --coverage)
endif()
