// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "lab/csv_recording.hpp"
#include "lab/mat_recording.hpp"

namespace algest::lab {

namespace {

/// Of a header; a file without lines has no places.
Position header_at(int place) { return place > 0 ? Position{1, place} : Position{}; }

/// The column's unit does not convert to the model's: because it is unknown, or of another dimension.
void complain_of_unit(const Recording& recording, const Column& column, const WantedSignal& wanted,
                      Diagnostics& diagnostics) {
    const std::string target = fmt::format("{} of the signal `{}`", quoted(wanted.unit), wanted.name);
    const Position at = header_at(column.place);
    if (units::Unit::parse(*column.unit)) {
        diagnostics.error(
            recording.file, at,
            fmt::format("{} of column {} does not convert to {}", quoted(*column.unit), quoted(column.name), target),
            "a column in a unit that does");
        return;
    }
    const auto spelling = units::right_spelling(*column.unit);
    diagnostics.error(
        recording.file, at,
        fmt::format("the unit {} of column {} is not known, so it does not convert to {}", quoted(*column.unit),
                    quoted(column.name), target),
        spelling
            ? "write " + *spelling
            : fmt::format("a unit in UDUNITS syntax, or the signal `{}` without a unit or with this very text as its unit",
                          wanted.name));
}

}  // namespace

const Column* Recording::column(const std::string& name) const {
    for (const Column& c : columns) {
        if (c.name == name) return &c;
    }
    return nullptr;
}

std::string Recording::column_names() const {
    constexpr std::size_t most = 30;
    std::string out;
    for (std::size_t k = 0; k < columns.size() && k < most; ++k) out += (k == 0 ? "" : ", ") + quoted(columns[k].name);
    if (columns.size() > most) out += fmt::format(" and {} more", columns.size() - most);
    return out;
}

void Recording::set_time(const std::vector<double>& instants, const UniformTime& found, const units::Conversion& to_seconds) {
    t = instants;
    if (to_seconds.scale != 1.0 || to_seconds.offset != 0.0) {
        for (double& instant : t) instant = instant * to_seconds.scale + to_seconds.offset;
    }
    uniform = found.uniform;
    period = found.period * to_seconds.scale;
    period_uncertainty = found.uncertainty * to_seconds.scale;
}

std::optional<Recording> read_recording(const std::string& path, Diagnostics& diagnostics, const CsvStyle& style, TimeBase time) {
    return std::string_view(path).ends_with(".mat") ? read_mat_recording(path, time, diagnostics) : read_csv_recording(path, style, time, diagnostics);
}

std::optional<std::vector<double>> signal_values(const Recording& recording, const WantedSignal& wanted,
                                                 Diagnostics& diagnostics) {
    const Column* column = recording.column(wanted.column);
    if (column == nullptr) {
        diagnostics.error(
            recording.file, header_at(std::min(recording.time_place, 1)),
            fmt::format("there is no column {} for the signal `{}` of the model", quoted(wanted.column), wanted.name),
            fmt::format("that column, or `column = \"...\"` of the signal naming one of {}", recording.column_names()));
        return std::nullopt;
    }
    const Position at = header_at(column->place);
    if (wanted.unit.empty() || column->unit == wanted.unit) return column->values;
    if (!column->unit) {
        diagnostics.warning(recording.file, at, fmt::format("column {} has no unit", quoted(column->name)),
                            fmt::format("taken to be in {} as the signal `{}`", wanted.unit, wanted.name));
        return column->values;
    }
    const auto conversion = units::conversion(*column->unit, wanted.unit);
    if (!conversion) {
        complain_of_unit(recording, *column, wanted, diagnostics);
        return std::nullopt;
    }
    if (units::takes_turns_for_radians(*column->unit, wanted.unit)) {
        diagnostics.warning(recording.file, at, fmt::format("column {} in {} is read as an angular speed, one per unit of time as one radian", quoted(column->name), *column->unit),
                            "write rpm or revolution/s where turns are counted");
    }
    std::vector<double> values = column->values;
    for (double& value : values) value = value * conversion->scale + conversion->offset;
    return values;
}

bool check_period(const Recording& recording, const std::string& model, double period, Diagnostics& diagnostics) {
    const double allowed = period_tolerance * period + recording.period_uncertainty;
    if (std::abs(recording.period - period) <= allowed) return true;
    diagnostics.error(
        recording.file, header_at(recording.time_place),
        fmt::format("the recording is sampled every {:.9g} s, the model `{}` every {:.9g} s", recording.period, model, period),
        fmt::format("`period = {:.9g}` under [sampling] of the model, or the recording resampled to the model's period",
                    recording.period));
    return false;
}

}  // namespace algest::lab
