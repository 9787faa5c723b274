# cmake -DFILES=<files, by commas> -DOUT=<source file> -P embed_rtl.cmake
#
# Writes a C++ source whose mote::hardware::rtl_library() holds the files' names and texts as raw strings.
string(REPLACE "," ";" FILES "${FILES}")
list(SORT FILES)
set(rows "")
foreach(path IN LISTS FILES)
  cmake_path(GET path FILENAME name)
  file(READ "${path}" text)
  string(FIND "${text}" ")mote_rtl\"" clash)
  if(NOT clash EQUAL -1)
    message(FATAL_ERROR "embed_rtl.cmake: ${path}: expected no )mote_rtl\" in the text, found one at ${clash}. Choose another delimiter.")
  endif()
  string(APPEND rows "    {\"${name}\", R\"mote_rtl(${text})mote_rtl\"},\n")
endforeach()
file(WRITE "${OUT}" "#include \"mote/hardware/rtl_library.hpp\"\n\nnamespace mote::hardware {\n\nstd::span<const RtlFile> rtl_library() {\n"
     "  static constexpr RtlFile kFiles[] = {\n" "${rows}" "  };\n  return kFiles;\n}\n\n}  // namespace mote::hardware\n")
