// SPDX-License-Identifier: GPL-3.0-or-later
// One line of CSV split into fields by libcsv, with the place of each field in the line.
#pragma once
#include <csv.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace algest::lab {

/// A field: its text without quotes and surrounding blanks, and where it starts in the line.
struct Field {
    std::string text;
    std::size_t start;  ///< byte of its first character, blanks skipped
};

/// Splits lines one by one. Strict: a quote inside an unquoted field or one that is not closed on the line is an error.
class CsvRow {
public:
    explicit CsvRow(char separator = ',');
    ~CsvRow();
    CsvRow(const CsvRow&) = delete;
    CsvRow& operator=(const CsvRow&) = delete;

    /// Splits a line (no line end in it); false if its quotes are wrong. A blank line has no fields. Cost: its length.
    bool split(std::string_view line);

    const std::vector<Field>& fields() const { return fields_; }  ///< of the last line
    std::size_t wrong_at() const { return wrong_at_; }            ///< byte at which split gave up

private:
    static void take(void* text, std::size_t length, void* self);
    bool give_up(std::size_t at);
    void start();

    char separator_;
    csv_parser parser_;
    std::vector<Field> fields_;
    std::size_t wrong_at_ = 0;
};

}  // namespace algest::lab
