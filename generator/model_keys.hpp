// SPDX-License-Identifier: GPL-3.0-or-later
// The keys of a model file: which stand where, and what each means. The readers of the sections take their lists from here, `algest keys` prints
// them, and docs/model-file.md holds what it prints: a key that is not in this table is refused, and one that is in it is explained.
#pragma once
#include <string>
#include <vector>

namespace algest::model {

/// A table of a model file.
enum class Where { top, sampling, signal, constant, parameter, equation, transfer, transfer_input, estimator, ratio_filter, discrete, row_filter, filter, feedback };

struct Key {
    std::string name;
    std::string unit;        ///< of its number; empty: it is none, or a pure one
    std::string by_default;  ///< TOML text of the value that counts where the key is left out; or words, in parentheses; empty: nothing does
    std::string meaning;     ///< one line
    std::string page;        ///< of docs/, that says more; may be empty
};

struct KeySection {
    Where where;
    std::string heading;     ///< as it stands in the file: "[sampling]"
    std::vector<Key> keys;
};

/// All tables, in the order in which a person writes them.
const std::vector<KeySection>& key_sections();

/// The names of the keys that may stand there.
std::vector<std::string> key_names(Where where);

}  // namespace algest::model
