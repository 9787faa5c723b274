# mote_npm(<folder> FILES package.json package-lock.json ...)
#
# Copies the files into <folder> (in the build tree), runs `npm ci` there and again whenever one of the two package files
# changes; <folder>/.installed is the stamp to depend on. Nothing is written to the source tree.
find_program(MOTE_NODE NAMES node nodejs)
find_program(MOTE_NPM npm)

function(mote_npm folder)
  cmake_parse_arguments(ARG "" "" "FILES" ${ARGN})
  list(TRANSFORM ARG_FILES PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/")
  file(RELATIVE_PATH shown ${PROJECT_BINARY_DIR} ${folder})
  add_custom_command(
    OUTPUT ${folder}/.installed
    COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
    COMMAND ${CMAKE_COMMAND} -E copy ${ARG_FILES} ${folder}
    COMMAND ${CMAKE_COMMAND} -E chdir ${folder} ${MOTE_NPM} ci --ignore-scripts --no-audit --no-fund --no-update-notifier
    COMMAND ${CMAKE_COMMAND} -E touch ${folder}/.installed
    DEPENDS ${ARG_FILES}
    COMMENT "npm ci in ${shown} (-DMOTE_REPORT_PAGE=OFF builds without npm)"
    VERBATIM)
endfunction()
