// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/csv_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
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

std::string name_of_separator(char separator) { return separator == ';' ? "semicolon" : separator == '\t' ? "tab" : "comma"; }

/// A number with its decimal sign as a point; a point that stood there is one no more.
std::string with_point(std::string text, char decimal) {
    if (decimal == '.') return text;
    for (char& c : text) c = c == decimal ? '.' : c == '.' ? decimal : c;
    return text;
}

/// Why a text is no sample; empty if it is one, in `value`.
std::string number_complaint(const std::string& text, char decimal, double& value) {
    if (text.empty()) return "a value is missing";
    const std::string number = with_point(text, decimal);
    const char* const end = number.data() + number.size();
    const auto [stop, error] = std::from_chars(number.data(), end, value);
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
    if (wrong.empty() && number_complaint(column.name, '.', number).empty()) {
        wrong = quoted(text) + " is a number where the header should be";
    }
    return column;
}

/// Reads the rows of one file into a Recording.
class Reader {
public:
    Reader(const std::string& path, const CsvStyle& style, TimeBase time, Diagnostics& diagnostics)
        : style_(style), time_base_(time), complaints_(path, diagnostics), lines_(path, diagnostics), row_(style.separator) {
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
        const std::size_t separator = lines_.line().find_first_of(style_.separator == ',' ? ";\t" : ",;\t");
        if (row_.fields().size() == 1 && separator != std::string_view::npos) {
            const char found = lines_.line()[separator];
            const std::string name = name_of_separator(found);
            complaints_.error(place_of(separator), "one column, with a " + name + " in its name",
                              "columns separated by " + name_of_separator(style_.separator) + "s, or --separator " + name + (found == ';' ? " (--decimal-comma where numbers are written 1,5)" : ""));
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

    /// What would be right in place of a text that is no number, or of a value that is none.
    std::string right_number(const std::string& text, double value) const {
        if (style_.decimal == '.' && style_.separator != ',' && text.find(',') != std::string::npos) return "--decimal-comma, if that is a decimal comma";
        if (!std::isfinite(value) || text.empty()) return "a number in every row; leave out the rows before or after the gap, so that time stays uniform";
        return fmt::format("a decimal number such as 1{}5 or -3e-4{}", style_.decimal, text.front() == '+' ? ", without a plus sign in front" : "");
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
            const std::string wrong = number_complaint(fields[k].text, style_.decimal, value);
            if (!wrong.empty()) {
                complaints_.error(place_of(fields[k].start), wrong + " in column " + quoted(columns[k].name), right_number(fields[k].text, value));
                if (complaints_.enough()) return;
            }
            columns[k].values.push_back(value);
        }
        if (!time_) return;
        written_.include(with_point(fields[*time_].text, style_.decimal));
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
        const TimeCheck check = algest::lab::check_time(t, written_, time_base_);
        if (!check.uniform) {
            complain_of(*check.uneven);
            return;
        }
        recording_.set_time(t, *check.uniform, *seconds_);
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

    CsvStyle style_;
    TimeBase time_base_;
    Complaints complaints_;
    TextLines lines_;
    CsvRow row_;
    Recording recording_{};
    std::optional<std::size_t> time_;  ///< index of the column t
    std::optional<units::Conversion> seconds_;
    WrittenDigits written_;
    std::vector<Position> time_at_;  ///< of t, by row
};

}  // namespace

std::optional<Recording> read_csv_recording(const std::string& path, const CsvStyle& style, TimeBase time, Diagnostics& diagnostics) {
    return Reader(path, style, time, diagnostics).read();
}

}  // namespace algest::lab
