// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/csv_row.hpp"

#include <new>

namespace algest::lab {

namespace {

constexpr unsigned char options = CSV_STRICT | CSV_STRICT_FINI;

/// Past blanks; a tab that separates fields is none.
std::size_t skip_blanks(std::string_view line, std::size_t at, char separator) {
    const std::size_t found = line.find_first_not_of(separator == '\t' ? " " : " \t", at);
    return found == std::string_view::npos ? line.size() : found;
}

}  // namespace

CsvRow::CsvRow(char separator) : separator_(separator) { start(); }

void CsvRow::start() {
    if (csv_init(&parser_, options) != 0) throw std::bad_alloc();
    csv_set_delim(&parser_, static_cast<unsigned char>(separator_));
}

CsvRow::~CsvRow() { csv_free(&parser_); }

void CsvRow::take(void* text, std::size_t length, void* self) {
    static_cast<CsvRow*>(self)->fields_.push_back({std::string(static_cast<const char*>(text), length), 0});
}

bool CsvRow::give_up(std::size_t at) {
    wrong_at_ = at;
    csv_free(&parser_);
    start();
    return false;
}

bool CsvRow::split(std::string_view line) {
    fields_.clear();
    std::size_t begin = 0;  // of the piece that the parser gets next: up to and with a separator
    std::size_t field_begin = 0;
    while (begin < line.size()) {
        const std::size_t separator = line.find(separator_, begin);
        const std::size_t end = separator == std::string_view::npos ? line.size() : separator + 1;
        const std::size_t before = fields_.size();
        const std::size_t parsed = csv_parse(&parser_, line.data() + begin, end - begin, take, nullptr, this);
        if (parsed != end - begin) return give_up(begin + parsed);
        if (fields_.size() > before) {
            fields_.back().start = skip_blanks(line, field_begin, separator_);
            field_begin = end;
        }
        begin = end;
    }
    const std::size_t before = fields_.size();
    if (csv_fini(&parser_, take, nullptr, this) != 0) return give_up(skip_blanks(line, field_begin, separator_));
    if (fields_.size() > before) fields_.back().start = skip_blanks(line, field_begin, separator_);
    return true;
}

}  // namespace algest::lab
