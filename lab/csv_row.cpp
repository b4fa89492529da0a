// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/csv_row.hpp"

#include <new>

namespace algest::lab {

namespace {

constexpr unsigned char options = CSV_STRICT | CSV_STRICT_FINI;

std::size_t skip_blanks(std::string_view line, std::size_t at) {
    const std::size_t found = line.find_first_not_of(" \t", at);
    return found == std::string_view::npos ? line.size() : found;
}

}  // namespace

CsvRow::CsvRow() {
    if (csv_init(&parser_, options) != 0) throw std::bad_alloc();
}

CsvRow::~CsvRow() { csv_free(&parser_); }

void CsvRow::take(void* text, std::size_t length, void* self) {
    static_cast<CsvRow*>(self)->fields_.push_back({std::string(static_cast<const char*>(text), length), 0});
}

bool CsvRow::give_up(std::size_t at) {
    wrong_at_ = at;
    csv_free(&parser_);
    if (csv_init(&parser_, options) != 0) throw std::bad_alloc();
    return false;
}

bool CsvRow::split(std::string_view line) {
    fields_.clear();
    std::size_t begin = 0;  // of the piece that the parser gets next: up to and with a comma
    std::size_t field_begin = 0;
    while (begin < line.size()) {
        const std::size_t comma = line.find(',', begin);
        const std::size_t end = comma == std::string_view::npos ? line.size() : comma + 1;
        const std::size_t before = fields_.size();
        const std::size_t parsed = csv_parse(&parser_, line.data() + begin, end - begin, take, nullptr, this);
        if (parsed != end - begin) return give_up(begin + parsed);
        if (fields_.size() > before) {
            fields_.back().start = skip_blanks(line, field_begin);
            field_begin = end;
        }
        begin = end;
    }
    const std::size_t before = fields_.size();
    if (csv_fini(&parser_, take, nullptr, this) != 0) return give_up(skip_blanks(line, field_begin));
    if (fields_.size() > before) fields_.back().start = skip_blanks(line, field_begin);
    return true;
}

}  // namespace algest::lab
