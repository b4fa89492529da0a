# SPDX-License-Identifier: MIT-0
# algest_add_estimator(TARGET MODEL [SCALAR double|float] [ENGINE fir|moments])
#
# Generates the estimator of the model file MODEL while building, and gives the linkable target TARGET:
#
#     algest_add_estimator(motor models/dc_motor.toml SCALAR float)
#     target_link_libraries(controller PRIVATE motor)              # #include <dc_motor/dc_motor.hpp>
#
# The generator is ALGEST_EXECUTABLE if that is set (a cross build must: the tool runs on the host), else the target `algest`
# of this very build. It runs again when the model or the generator changes.
set(ALGEST_EXECUTABLE "" CACHE FILEPATH "The host tool that generates estimators")

function(algest_add_estimator target model)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "SCALAR;ENGINE" "")
  if(arg_UNPARSED_ARGUMENTS OR arg_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "algest_add_estimator(${target}): cannot read ${arg_UNPARSED_ARGUMENTS}${arg_KEYWORDS_MISSING_VALUES};"
      " write algest_add_estimator(TARGET MODEL [SCALAR double|float] [ENGINE fir|moments])")
  endif()
  cmake_path(ABSOLUTE_PATH model BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
  if(NOT EXISTS "${model}" OR IS_DIRECTORY "${model}")
    message(FATAL_ERROR "algest_add_estimator(${target}): there is no model file ${model}")
  endif()

  if(ALGEST_EXECUTABLE)
    set(generator "${ALGEST_EXECUTABLE}")
    set(generator_changes "${ALGEST_EXECUTABLE}")
  elseif(TARGET algest)
    set(generator "$<TARGET_FILE:algest>")
    set(generator_changes algest)
  else()
    message(FATAL_ERROR "algest_add_estimator(${target}): set ALGEST_EXECUTABLE to an algest that runs on this machine,"
      " or ALGEST_HOST to ON to build it along")
  endif()

  # The model's own `name` says what the files are called: a top-level key, so it stands before the first table.
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${model}")
  file(STRINGS "${model}" lines REGEX "^[ \t]*(name[ \t]*=|\\[)")
  list(GET lines 0 line)
  if(NOT line MATCHES "^[ \t]*name[ \t]*=[ \t]*[\"']([A-Za-z_][A-Za-z0-9_]*)[\"']")
    message(FATAL_ERROR "algest_add_estimator(${target}): ${model} gives no `name = \"...\"` before its first table")
  endif()
  set(name "${CMAKE_MATCH_1}")

  set(out "${CMAKE_CURRENT_BINARY_DIR}/estimators/${target}")
  set(files "${out}/${name}/${name}.hpp" "${out}/${name}/${name}_tables.hpp" "${out}/${name}/${name}.md")
  set(options "")
  if(arg_SCALAR)
    list(APPEND options --scalar ${arg_SCALAR})
  endif()
  if(arg_ENGINE)
    list(APPEND options --engine ${arg_ENGINE})
  endif()
  add_custom_command(OUTPUT ${files}
    COMMAND "${generator}" generate "${model}" -o "${out}" ${options}
    COMMAND "${CMAKE_COMMAND}" -E touch ${files}
    DEPENDS "${model}" "${generator_changes}"
    COMMENT "Generating the estimator ${target} of ${name}" VERBATIM)
  add_custom_target(${target}_generate DEPENDS ${files})
  add_library(${target} INTERFACE)
  add_dependencies(${target} ${target}_generate)
  target_include_directories(${target} INTERFACE "${out}")
  target_link_libraries(${target} INTERFACE algest::runtime)
endfunction()
