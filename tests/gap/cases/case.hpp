// SPDX-License-Identifier: GPL-3.0-or-later
// A case: a machine with something hidden, its recording, and the truth.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "refit.hpp"

namespace algest::gap {

/// What can be hidden in a system: `none`, `none_coloured`, `none_process`, `effect@slot`, two of them with `+`, `one_speed`; with
/// `structural` those that are more than a term: `effect@index` (of a slot, an input or a signal), `parameter_error@index`.
std::vector<std::string> hidings(const std::string& family, bool structural);

/// The words between separators.
std::vector<std::string> parts(const std::string& text, char separator);

struct Case {
    std::string name, hidden;
    std::shared_ptr<System> system;
    Machine machine;               ///< the true one
    std::vector<double> believed;  ///< by quantity: what the model file declares known
    std::vector<std::vector<double>>
        unspoilt;  ///< by signal: for the check, where the model's language cannot say what is hidden; else empty
    std::vector<std::vector<double>> measured;  ///< by signal of the model
    std::vector<double> initial_guess;          ///< by quantity
    std::vector<double> noise, resolution;      ///< by signal
    std::vector<double> floor, nominal;  ///< nrmse by scored signal: of the true machine, of the model with true parameters
    std::vector<double> refitted;        ///< nrmse of the refitted model, to expect before the effect is named
    std::vector<std::string> rivals;     ///< effects that explain the recording as well
    std::vector<std::pair<std::string, std::string>>
        equal_terms;  ///< name and equation of terms that this recording cannot tell from a sensor's fault or a wrong constant
    bool ambiguous = false;
    std::string note;
};

/// Throws std::runtime_error where the seed gives no sound case.
Case make_case(const std::string& family, const std::string& hidden, std::uint64_t seed);

/// model.toml, measured.csv, answer.json, and truth.toml: the amended model, for a check by `algest simulate`.
void write_case(const Case& made, const std::string& folder);

}  // namespace algest::gap
