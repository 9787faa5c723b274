# cmake -DFILE=<text file> -DFUNCTION=<name> -DOUT=<source file> -P embed.cmake
#
# Writes a C++ source whose function mote::report::<name>() is the text of the file. A raw string compiles in well under
# a second for the bundle's size and needs no assembler. Without FILE the text is empty.
set(text "")
if(FILE)
  file(READ "${FILE}" text)
endif()
string(FIND "${text}" ")mote_text\"" clash)
if(NOT clash EQUAL -1)
  message(FATAL_ERROR "embed.cmake: ${FILE}: expected no )mote_text\" in the text, found one at ${clash}. Choose another delimiter.")
endif()
file(WRITE "${OUT}" "#include \"mote/report/text.hpp\"\n\nnamespace mote::report {\n"
     "std::string_view ${FUNCTION}() { return R\"mote_text(" "${text}" ")mote_text\"; }\n}  // namespace mote::report\n")
