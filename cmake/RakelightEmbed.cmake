# SPDX-FileCopyrightText: 2026 The Rakelight authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# rakelight_embed(OUTPUT HEADER FOLDER FILES...)
# Makes OUTPUT, a source file that defines embedded_file() of HEADER: the texts of FILES, which lie in FOLDER, by name.
# Also the script that does so when the build runs it.
function(rakelight_embed output header folder)
  list(TRANSFORM ARGN PREPEND ${folder}/ OUTPUT_VARIABLE paths)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DHEADER=${header} -DFOLDER=${folder} "-DFILES=${ARGN}"
      -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
    DEPENDS ${paths} ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
    COMMENT "Embedding ${folder}"
    VERBATIM)
endfunction()

if(CMAKE_SCRIPT_MODE_FILE)
  file(WRITE ${OUTPUT} "#include \"${HEADER}\"\n\n#include <stdexcept>\n#include <string>\n\n"
    "namespace rakelight {\n\nstd::string_view embedded_file(std::string_view name) {\n")
  foreach(name IN LISTS FILES)
    file(READ ${FOLDER}/${name} text)
    file(APPEND ${OUTPUT} "  if (name == \"${name}\") return R\"EMBEDDED(${text})EMBEDDED\";\n")
  endforeach()
  file(APPEND ${OUTPUT} "  throw std::logic_error(\"no embedded file \" + std::string(name));\n}\n\n"
    "}  // namespace rakelight\n")
endif()
