# cmake -DFILES=<files, by commas> -DOUT=<source file> -DHEADER=<declares it> -DFUNCTION=<name> -P embed_rtl.cmake
#
# Writes a C++ source whose mote::hardware::<name>() holds the files' names and texts as raw strings.
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
file(WRITE "${OUT}" "#include \"${HEADER}\"\n\nnamespace mote::hardware {\n\nstd::span<const RtlFile> ${FUNCTION}() {\n"
     "  static constexpr RtlFile kFiles[] = {\n" "${rows}" "  };\n  return kFiles;\n}\n\n}  // namespace mote::hardware\n")
