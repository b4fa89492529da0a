// SPDX-License-Identifier: GPL-3.0-or-later
// A measured recording: columns `name [unit]` over a uniform time `t`, read from a file and checked whole.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"
#include "generator/units.hpp"
#include "lab/uniform_time.hpp"

namespace algest::lab {

/// One column as it stands in the file.
struct Column {
    std::string name;
    std::optional<std::string> unit;  ///< as written between the brackets; nullopt: no brackets
    int place;                        ///< character column of its header
    std::vector<double> values;       ///< finite, one a row, in the unit of the file
};

struct Recording {
    std::string file;
    std::vector<Column> columns;  ///< in the order of the file, t among them; names are distinct
    std::vector<double> t;        ///< s, increasing, uniform
    int time_place;               ///< character column of the header of t
    double period;                ///< s, mean step
    bool uniform = true;          ///< false only where TimeBase::increasing was asked for
    double period_uncertainty;    ///< s, from the digits in which t is written

    std::size_t samples() const { return t.size(); }
    const Column* column(const std::string& name) const;  ///< null: there is none
    std::string column_names() const;                     ///< for messages: `a`, `b`, `t`

    /// Takes instants that were found right, both in one unit.
    void set_time(const std::vector<double>& instants, const UniformTime& found, const units::Conversion& to_seconds);
};

/// Complaints after which reading stops.
constexpr int most_complaints = 20;

/// How a CSV file is written.
struct CsvStyle {
    char separator = ',';   ///< between fields
    char decimal = '.';     ///< in numbers
};

/// Reads the file, by the end of its name:
/// .mat: every vector of real numbers that is as long as the vector `t` is a column; the fields of a struct `units` give units, and t is
/// in s if they do not. Other variables are left out, with a note.
/// All others are CSV, as they are or gzipped. Accepted: UTF-8 with or without byte-order mark, LF or CRLF, quoted fields, blanks around
/// fields, blank lines at the end, two rows or more. Refused with line and column: everything that is no plain finite number in a field,
/// rows of another length than the header, columns of one name, a time that is not what `time` asks for (check_time) or has no unit
/// of time, and what TextLines refuses. Nullopt if anything was refused.
/// Cost: linear in the file; all columns are kept in memory, 8 bytes a value.
std::optional<Recording> read_recording(const std::string& path, Diagnostics& diagnostics, const CsvStyle& style = {}, TimeBase time = TimeBase::uniform);

/// What a model says of a measured signal.
struct WantedSignal {
    std::string name;
    std::string column;  ///< name of the column
    std::string unit;    ///< empty: not declared, values are taken as they are
};

/// The samples of one signal in the model's unit; nullopt, and an error in `diagnostics`, if the column is missing or its
/// unit cannot be converted. A unit that UDUNITS does not know fits only the identical text or a model without unit. A
/// column without unit is taken to be in the model's, with a warning. Cost: one multiplication and addition a row.
std::optional<std::vector<double>> signal_values(const Recording& recording, const WantedSignal& wanted,
                                                 Diagnostics& diagnostics);

/// Difference of the recording's period from the model's that is accepted, relative. A wrong period falsifies a
/// derivative of order n by n times that: far less than any estimate here is good for, and far more than decimals do.
constexpr double period_tolerance = 1e-4;

/// True when the recording is sampled as the model says; else an error in `diagnostics`. period in s.
bool check_period(const Recording& recording, const std::string& model, double period, Diagnostics& diagnostics);

}  // namespace algest::lab
