// SPDX-License-Identifier: GPL-3.0-or-later
// Which names a model may use: they become C++ members, file names and columns.
#pragma once
#include <optional>
#include <string>

namespace algest::model {

/// What is wrong with the name of a signal, constant or parameter, and what would be right; nullopt if it is fine.
struct NameFault {
    std::string what;
    std::string right;
};
std::optional<NameFault> fault_of_name(const std::string& name);

/// Lower case, digits and single underscores, a letter first: what a file or a folder may be called anywhere.
bool is_lower_case_name(const std::string& name);

/// What is wrong with the name of a model: lower case, digits, underscores; it becomes a directory and a class.
std::optional<NameFault> fault_of_model_name(const std::string& name);

/// In lower case: names that differ by case alone have one such text.
std::string folded(std::string name);

/// PmsmElectrical for pmsm_electrical.
std::string class_name(const std::string& model_name);

/// What is wrong with one line of free text that goes into comments of generated code; nullopt if it is fine.
std::optional<NameFault> fault_of_prose(const std::string& text);

}  // namespace algest::model
