# SPDX-License-Identifier: GPL-3.0-or-later
# Writes the C++ source that holds every file below DIR, byte for byte, for generator/template_text.hpp:
#   cmake -D DIR=templates -D FILES="cpp/a.mustache;..." -D OUT=template_text.cpp -P embed_templates.cmake
set(cases "")
foreach(file IN LISTS FILES)
  file(READ "${DIR}/${file}" bytes HEX)
  string(LENGTH "${bytes}" size)
  math(EXPR size "${size} / 2")
  string(REGEX REPLACE "(..)" "\\\\x\\1" text "${bytes}")
  string(REPLACE "\\x0a" "\\x0a\"\n        \"" text "${text}")  # a line of the template is a line of the source
  string(APPEND cases "    if (path == \"${file}\")\n        return {\"${text}\", ${size}};\n")
endforeach()
file(WRITE "${OUT}" "// Made by cmake/embed_templates.cmake from templates/. Do not edit.
#include \"generator/template_text.hpp\"

namespace algest::generator {

std::string_view template_text(std::string_view path) {
${cases}    return {};
}

}  // namespace algest::generator
")
