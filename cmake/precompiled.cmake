# SPDX-License-Identifier: GPL-3.0-or-later
# algest_precompile(TARGET [HEADER...]): with ALGEST_QUICK_BUILD the standard headers that most of algest's files include, and those of libraries, are
# parsed once for each target. Own headers never: they change. <filesystem> is left out, since it brings std::quoted, which hides our own quoted().
# algest_precompile_like(TARGET OTHER): those of OTHER, whose flags must be the same.
function(algest_precompile target)
  if(ALGEST_QUICK_BUILD)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <cstddef> <fstream> <functional> <limits> <map> <memory> <optional>
      <random> <set> <string> <string_view> <utility> <variant> <vector> <fmt/format.h> ${ARGN})
    algest_precompile_for_ccache(${target})
  endif()
endfunction()

function(algest_precompile_like target other)
  if(ALGEST_QUICK_BUILD)
    target_precompile_headers(${target} REUSE_FROM ${other})
    algest_precompile_for_ccache(${target})
  endif()
endfunction()

# What ccache needs to know files that were compiled so, beside CCACHE_SLOPPINESS=pch_defines,time_macros. Through precompiled headers GCC 12 takes
# moves of strings for overflows.
function(algest_precompile_for_ccache target)
  target_compile_options(${target} PRIVATE "$<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess;-Wno-array-bounds>" "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endfunction()
