# The SIMD engine is compiled once for every instruction set; the program chooses at run time.
#
# -ffp-contract=fast: a product and a sum become one instruction. -fno-trapping-math, -fno-signed-zeros: constants leave
# loops, and x + 0 is x; no result depends on exceptions or on the sign of a zero. -fno-gnu-unique: such symbols stay
# global whatever objcopy is told.
set(MOTE_VECTOR_OPTIONS -ffp-contract=fast -fno-math-errno -fno-trapping-math -fno-signed-zeros -Wno-ignored-attributes -Wno-attributes
    $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>)
set(MOTE_ISA_SSE4 -march=x86-64-v2 -maes -mpclmul) # the least that Highway 1.0.3 has vectors for with g++ 12.2
set(MOTE_ISA_AVX2 -march=x86-64-v3 -maes -mpclmul)
set(MOTE_ISA_AVX512 -march=x86-64-v4 -maes -mpclmul)
if(MOTE_SANITIZE OR MOTE_COVERAGE OR MOTE_FUZZ)
  set(isas SSE4 AVX2) # one wide and one narrow: instrumented builds are slow enough
else()
  set(isas SSE4 AVX2 AVX512)
endif()
set(MOTE_ISAS "${isas}" CACHE STRING "Instruction sets of the SIMD engine: fewer build faster, and run on fewer machines")

# mote_simd(<target> NAME <name> SOURCES <files>): compiles the files for every instruction set and adds them to the target.
# Each set becomes one object whose only global symbols are simd_filter(...): an inline function of another header that
# was compiled for AVX-512 there must never be the one that the linker picks for everybody.
function(mote_simd target)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  foreach(isa IN LISTS MOTE_ISAS)
    string(TOLOWER ${isa} name)
    set(copies "")
    foreach(source IN LISTS ARG_SOURCES) # options belong to a source: each set has copies of its own
      cmake_path(GET source STEM stem)
      set(copy ${CMAKE_CURRENT_BINARY_DIR}/simd/${name}/${stem}_${name}.cpp)
      cmake_path(GET copy PARENT_PATH folder)
      file(RELATIVE_PATH path ${folder} ${source}) # the same text in every clone, so that a compiler cache knows it
      file(CONFIGURE OUTPUT ${copy} CONTENT "#include \"${path}\"\n" @ONLY)
      list(APPEND copies ${copy})
    endforeach()
    set_source_files_properties(${copies} PROPERTIES COMPILE_OPTIONS "${MOTE_ISA_${isa}};${MOTE_VECTOR_OPTIONS}")
    add_library(${target}_${name} OBJECT ${copies})
    target_link_libraries(${target}_${name} PRIVATE ${ARG_LINKS} mote_warnings)
    if(MOTE_SANITIZE OR MOTE_COVERAGE)
      target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_${name}>)
    else()
      set(object ${CMAKE_CURRENT_BINARY_DIR}/${target}_${name}.o)
      add_custom_command(OUTPUT ${object}
        COMMAND ${CMAKE_LINKER} -r --force-group-allocation -o ${object} $<TARGET_OBJECTS:${target}_${name}>
        COMMAND ${CMAKE_OBJCOPY} --wildcard --keep-global-symbol=*simd_filter* ${object}
        DEPENDS ${target}_${name} $<TARGET_OBJECTS:${target}_${name}> COMMAND_EXPAND_LISTS VERBATIM)
      set_source_files_properties(${object} PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
      target_sources(${target} PRIVATE ${object})
    endif()
    target_compile_definitions(${target} PUBLIC MOTE_SIMD_${isa})
  endforeach()
endfunction()

# The instruction sets that this machine runs, the narrowest first.
file(READ /proc/cpuinfo processor)
set(MOTE_ISAS_HERE "")
foreach(pair IN ITEMS "SSE4; sse4_2" "AVX2; avx2" "AVX512; avx512vl")
  list(GET pair 0 isa)
  list(GET pair 1 flag)
  if(isa IN_LIST MOTE_ISAS AND processor MATCHES "${flag}")
    list(APPEND MOTE_ISAS_HERE ${isa})
  endif()
endforeach()

# mote_simd_tests(<name> [ENDS] [LABEL nightly] SOURCES <files> LINKS <targets>): the program <name>_<set> for every instruction set that
# this machine runs; ENDS: for the narrowest and the widest, where compiling takes minutes.
function(mote_simd_tests name)
  cmake_parse_arguments(ARG "ENDS" "LABEL" "SOURCES;LINKS" ${ARGN})
  set(isas ${MOTE_ISAS_HERE})
  if(ARG_ENDS)
    list(GET MOTE_ISAS_HERE 0 -1 isas)
    list(REMOVE_DUPLICATES isas)
  endif()
  foreach(isa IN LISTS isas)
    string(TOLOWER ${isa} set)
    set(copies "")
    foreach(source IN LISTS ARG_SOURCES)
      cmake_path(GET source STEM stem)
      set(copy ${CMAKE_CURRENT_BINARY_DIR}/simd/${set}/${stem}_${set}.cpp)
      file(CONFIGURE OUTPUT ${copy} CONTENT "#include \"${CMAKE_CURRENT_SOURCE_DIR}/${source}\"\n" @ONLY)
      list(APPEND copies ${copy})
    endforeach()
    set_source_files_properties(${copies} PROPERTIES COMPILE_OPTIONS "${MOTE_ISA_${isa}};${MOTE_VECTOR_OPTIONS}")
    add_executable(${name}_${set} ${copies})
    target_link_libraries(${name}_${set} PRIVATE ${ARG_LINKS} GTest::gtest_main mote_warnings)
    gtest_discover_tests(${name}_${set} TEST_PREFIX ${name}_${set}. PROPERTIES LABELS "${ARG_LABEL}" TIMEOUT 3000 DISCOVERY_TIMEOUT 60)
  endforeach()
endfunction()
