// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <string_view>
#include <system_error>

#include "generator/units.hpp"
#include "lab/csv_row.hpp"
#include "lab/text_lines.hpp"
#include "lab/uniform_time.hpp"

namespace algest::lab {

namespace {

/// Errors about one recording, at most most_complaints of them.
class Complaints {
public:
    Complaints(const std::string& file, Diagnostics& diagnostics) : file_(file), diagnostics_(&diagnostics) {}

    void error(Position at, const std::string& what, const std::string& right) {
        if (++count_ <= most_complaints) diagnostics_->error(file_, at, what, right);
        if (count_ == most_complaints) {
            diagnostics_->note(file_, fmt::format("stopped reading after {} complaints", most_complaints));
        }
    }
    bool any() const { return count_ > 0; }
    bool enough() const { return count_ >= most_complaints; }

private:
    std::string file_;
    Diagnostics* diagnostics_;
    int count_ = 0;
};

/// Why a text is no sample; empty if it is one, in `value`.
std::string number_complaint(const std::string& text, double& value) {
    if (text.empty()) return "a value is missing";
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (stop != end || error == std::errc::invalid_argument) return quoted(text) + " is not a number";
    if (error == std::errc::result_out_of_range) return quoted(text) + " is beyond the range of a double";
    if (!std::isfinite(value)) return quoted(text) + " is not finite";
    return {};
}

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// A header `name [unit]` taken apart; what is wrong with it, if anything, goes to `wrong`.
Column header_column(const std::string& text, int place, std::string& wrong) {
    Column column{{}, std::nullopt, place, {}};
    const std::size_t open = text.find('[');
    column.name = trimmed(std::string_view(text).substr(0, open));
    if (open != std::string::npos) {
        if (text.back() != ']') {
            wrong = "the unit in " + quoted(text) + " has no closing bracket at the end";
        } else {
            column.unit = trimmed(std::string_view(text).substr(open + 1, text.size() - open - 2));
        }
    }
    double number = 0.0;
    if (wrong.empty() && column.name.empty()) wrong = "a column has no name";
    if (wrong.empty() && number_complaint(column.name, number).empty()) {
        wrong = quoted(text) + " is a number where the header should be";
    }
    return column;
}

/// Reads the rows of one file into a Recording.
class Reader {
public:
    Reader(const std::string& path, Diagnostics& diagnostics, TimeBase time) : complaints_(path, diagnostics), lines_(path, diagnostics), time_base_(time) {
        recording_.file = path;
    }

    std::optional<Recording> read() {
        if (!next_row()) {
            if (!lines_.refused() && !complaints_.any()) {
                complaints_.error({1, 1}, "the file is empty", "a header such as `t [s],u [V]` and one row a sample");
            }
            return std::nullopt;
        }
        if (!read_header()) return std::nullopt;
        while (!complaints_.enough() && next_row()) read_row();
        if (lines_.refused() || complaints_.any()) return std::nullopt;
        check_time();
        if (complaints_.any()) return std::nullopt;
        return std::move(recording_);
    }

private:
    /// Moves to the next line that has fields; blank lines may only follow the last row.
    bool next_row() {
        int blank = 0;
        while (lines_.next()) {
            if (!row_.split(lines_.line())) {
                complaints_.error(place_of(row_.wrong_at()), "the quotes of this field do not match",
                                  "quotes around a whole field, closed on the same line");
                if (complaints_.enough() || recording_.columns.empty()) return false;
                continue;
            }
            if (row_.fields().empty()) {
                if (blank == 0) blank = lines_.number();
                continue;
            }
            if (blank != 0)
                complaints_.error({blank, 1}, "the line is blank", "a row of numbers; blank lines only at the end");
            return true;
        }
        return false;
    }

    Position place_of(std::size_t byte) const { return {lines_.number(), character_column(lines_.line(), byte)}; }

    /// False if reading on would only bring complaints that follow from this one.
    bool read_header() {
        const std::size_t separator = lines_.line().find_first_of(";\t");
        if (row_.fields().size() == 1 && separator != std::string_view::npos) {
            complaints_.error(place_of(separator), "one column, with a semicolon or tab in its name",
                              "columns separated by commas");
            return false;
        }
        std::map<std::string, int> place_of_name;
        for (const Field& field : row_.fields()) {
            const Position at = place_of(field.start);
            std::string wrong;
            Column column = header_column(field.text, at.column, wrong);
            if (!wrong.empty()) {
                complaints_.error(at, wrong, "`name [unit]`");
            } else if (const auto [first, is_new] = place_of_name.emplace(column.name, at.column); !is_new) {
                complaints_.error(
                    at, fmt::format("a second column {}; the first is at column {}", quoted(column.name), first->second),
                    "one column a name");
            }
            recording_.columns.push_back(std::move(column));
            if (complaints_.enough()) return false;
        }
        find_time();
        return true;
    }

    void find_time() {
        const Column* time = recording_.column("t");
        if (time == nullptr) {
            complaints_.error({lines_.number(), 1}, "there is no column `t`",
                              "a column `t [s]`; there are " + recording_.column_names());
            return;
        }
        time_ = static_cast<std::size_t>(time - recording_.columns.data());
        recording_.time_place = time->place;
        const Position at{lines_.number(), time->place};
        if (!time->unit) {
            complaints_.error(at, "`t` has no unit", "`t [s]`, or another unit of time");
            return;
        }
        seconds_ = units::conversion(*time->unit, "s");
        if (!seconds_) complaints_.error(at, "the unit " + quoted(*time->unit) + " of `t` is not one of time", "`t [s]`");
    }

    void read_row() {
        const std::vector<Field>& fields = row_.fields();
        std::vector<Column>& columns = recording_.columns;
        if (fields.size() != columns.size()) {
            const bool missing = fields.size() < columns.size();
            complaints_.error(place_of(missing ? lines_.line().size() : fields[columns.size()].start),
                              fmt::format("the row has {} fields", fields.size()),
                              fmt::format("{} fields, as in the header", columns.size()));
            return;
        }
        for (std::size_t k = 0; k < fields.size(); ++k) {
            double value = 0.0;
            const std::string wrong = number_complaint(fields[k].text, value);
            if (!wrong.empty()) {
                complaints_.error(place_of(fields[k].start), wrong + " in column " + quoted(columns[k].name),
                                  "a decimal number such as 1.5 or -3e-4, without a plus sign in front");
                if (complaints_.enough()) return;
            }
            columns[k].values.push_back(value);
        }
        if (!time_) return;
        written_.include(fields[*time_].text);
        time_at_.push_back(place_of(fields[*time_].start));
    }

    void check_time() {
        const std::vector<double>& t = recording_.columns[*time_].values;
        if (t.size() < 2) {
            complaints_.error({lines_.number(), 1},
                              t.empty() ? "there are no rows after the header" : "there is only one row",
                              "one row a sample, two or more");
            return;
        }
        const TimeCheck check = check_uniform(t, written_);
        recording_.uniform = check.uniform.has_value();
        if (!recording_.uniform && time_base_ == TimeBase::uniform) {
            complain_of(*check.uneven);
            return;
        }
        const auto back = std::adjacent_find(t.begin(), t.end(), std::greater_equal<>());
        if (back != t.end()) {
            complain_of({static_cast<std::size_t>(back - t.begin()) + 1, back[1] - back[0], 0.0, 1});
            return;
        }
        const bool in_seconds = seconds_->scale == 1.0 && seconds_->offset == 0.0;
        recording_.t = t;
        if (!in_seconds) {
            for (double& instant : recording_.t) instant = instant * seconds_->scale + seconds_->offset;
        }
        const UniformTime mean = check.uniform.value_or(UniformTime{(t.back() - t.front()) / static_cast<double>(t.size() - 1), 0.0});
        recording_.period = mean.period * seconds_->scale;
        recording_.period_uncertainty = mean.uncertainty * seconds_->scale;
    }

    void complain_of(const UnevenStep& uneven) {
        const std::string unit = *recording_.columns[*time_].unit;
        if (!(uneven.step > 0.0)) {
            complaints_.error(
                time_at_[uneven.row],
                uneven.step < 0.0 ? "`t` goes back here" : "`t` stands still here: the same value as in the row before",
                "instants that increase, one row a sample");
            return;
        }
        std::string what = fmt::format("`t` is not uniform: a step of {:.6g} {} here, {:.6g} {} elsewhere", uneven.step,
                                       unit, uneven.period, unit);
        if (uneven.count > 1) what += fmt::format(" ({} such steps)", uneven.count);
        complaints_.error(time_at_[uneven.row], what,
                          "steps equal to 0.1 percent, and `t` written with digits enough to show it");
    }

    Complaints complaints_;
    TextLines lines_;
    TimeBase time_base_;
    CsvRow row_;
    Recording recording_{};
    std::optional<std::size_t> time_;  ///< index of the column t
    std::optional<units::Conversion> seconds_;
    WrittenDigits written_;
    std::vector<Position> time_at_;  ///< of t, by row
};

/// The column's unit does not convert to the model's: because it is unknown, or of another dimension.
void complain_of_unit(const Recording& recording, const Column& column, const WantedSignal& wanted,
                      Diagnostics& diagnostics) {
    const std::string target = fmt::format("{} of the signal `{}`", quoted(wanted.unit), wanted.name);
    const Position at{1, column.place};
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
            ? quoted(*spelling)
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

std::optional<Recording> read_recording(const std::string& path, Diagnostics& diagnostics, TimeBase time) {
    return Reader(path, diagnostics, time).read();
}

std::optional<std::vector<double>> signal_values(const Recording& recording, const WantedSignal& wanted,
                                                 Diagnostics& diagnostics) {
    const Column* column = recording.column(wanted.column);
    if (column == nullptr) {
        diagnostics.error(
            recording.file, {1, 1},
            fmt::format("there is no column {} for the signal `{}` of the model", quoted(wanted.column), wanted.name),
            fmt::format("that column, or `column = \"...\"` of the signal naming one of {}", recording.column_names()));
        return std::nullopt;
    }
    const Position at{1, column->place};
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
        recording.file, {1, recording.time_place},
        fmt::format("the recording is sampled every {:.9g} s, the model `{}` every {:.9g} s", recording.period, model, period),
        fmt::format("`period = {:.9g}` under [sampling] of the model, or the recording resampled to the model's period",
                    recording.period));
    return false;
}

}  // namespace algest::lab
