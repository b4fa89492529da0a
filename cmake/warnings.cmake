# SPDX-License-Identifier: GPL-3.0-or-later
# How algest's own code is compiled: algest_code, linked privately by every target of ours.
add_library(algest_code INTERFACE)
target_compile_features(algest_code INTERFACE cxx_std_20)
target_compile_options(algest_code INTERFACE -Wall -Wextra -Wconversion $<$<BOOL:${ALGEST_WERROR}>:-Werror>)
target_compile_definitions(algest_code INTERFACE EIGEN_MPL2_ONLY)
