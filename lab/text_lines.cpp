// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/text_lines.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "generator/source_text.hpp"

namespace algest::lab {

int character_column(std::string_view line, std::size_t offset) {
    int column = 1;
    for (std::size_t k = 0; k < offset && k < line.size(); ++k) {
        const bool continues = (static_cast<unsigned char>(line[k]) & 0xC0U) == 0x80U;
        if (!continues) ++column;
    }
    return column;
}

TextLines::TextLines(const std::string& path, Diagnostics& diagnostics) : path_(path), diagnostics_(&diagnostics) {
    std::error_code no_matter;
    if (std::filesystem::is_directory(path, no_matter)) {
        refuse({}, "is a directory", "a CSV file");
        return;
    }
    file_.reset(gzopen(path.c_str(), "rb"));
    if (!file_) {
        refuse({}, std::string("cannot be read: ") + std::strerror(errno), "the path of a CSV file");
        return;
    }
    while (buffer_.size() < 3 && read_block()) {
    }
    if (refused_) return;
    if (buffer_.starts_with("\xFF\xFE") || buffer_.starts_with("\xFE\xFF")) {
        refuse({1, 1}, "the file is UTF-16", "the same text saved as UTF-8");
    } else if (buffer_.starts_with("\xEF\xBB\xBF")) {
        begin_ = 3;
    }
}

bool TextLines::read_block() {
    std::array<char, 65536> block;
    const int count = gzread(file_.get(), block.data(), static_cast<unsigned>(block.size()));
    int error = Z_OK;
    const char* const text = gzerror(file_.get(), &error);
    if (error == Z_ERRNO) return refuse({}, std::string("cannot be read: ") + std::strerror(errno), "the path of a CSV file");
    if (error != Z_OK) return refuse({}, error == Z_BUF_ERROR ? "the gzipped file ends too early" : std::string("the gzipped file is damaged: ") + text, "the file packed once more");
    buffer_.append(block.data(), static_cast<std::size_t>(std::max(count, 0)));
    return count > 0;
}

bool TextLines::refuse(Position at, const std::string& what, const std::string& right) {
    refused_ = true;
    diagnostics_->error(path_, at, what, right);
    return false;
}

bool TextLines::check_encoding() {
    const bool ascii = std::none_of(line_.begin(), line_.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80U; });
    if (ascii) return true;   // nearly every line: no need of a copy
    const auto at = model::not_utf8(std::string(line_));
    return !at || refuse({number_, at->column}, "a byte that is no UTF-8: the file is in another encoding",
                         "the same text in UTF-8; where it was Latin-1: iconv -f latin1 -t utf-8 OLD > NEW");
}

bool TextLines::check_line_end(bool has_end) {
    const bool crlf = has_end && line_.ends_with('\r');
    if (crlf) line_.remove_suffix(1);
    const std::size_t stray = line_.find('\r');
    if (stray != std::string_view::npos) {
        return refuse({number_, character_column(line_, stray)}, "a carriage return that does not end a line",
                      "lines that end with LF, or all with CRLF");
    }
    if (!has_end) return true;
    const LineEnd found = crlf ? LineEnd::crlf : LineEnd::lf;
    if (line_end_ == LineEnd::unknown) line_end_ = found;
    if (found != line_end_) {
        return refuse(
            {number_, character_column(line_, line_.size())},
            crlf ? "this line ends with CRLF, those before with LF" : "this line ends with LF, those before with CRLF",
            "one kind of line end in the whole file");
    }
    return true;
}

bool TextLines::next() {
    if (refused_) return false;
    std::size_t end = buffer_.find('\n', begin_);
    if (end == std::string::npos) {
        buffer_.erase(0, begin_);
        begin_ = 0;
    }
    while (end == std::string::npos && buffer_.size() <= longest_line) {
        const std::size_t searched = buffer_.size();
        if (!read_block()) break;
        end = buffer_.find('\n', searched);
    }
    const bool has_end = end != std::string::npos;
    if (refused_ || (!has_end && buffer_.empty())) return false;
    ++number_;
    line_ = std::string_view(buffer_).substr(begin_, has_end ? end - begin_ : std::string::npos);
    const std::size_t nul = line_.find('\0');
    if (nul != std::string_view::npos) {
        return refuse({number_, character_column(line_, nul)}, "a NUL byte: the file is UTF-16 or no text at all",
                      "a CSV file in UTF-8");
    }
    if (line_.size() > longest_line) {
        return refuse({number_, 1}, "the line is longer than 1 MiB", "a row of numbers, one line a sample");
    }
    begin_ = has_end ? end + 1 : buffer_.size();
    return check_encoding() && check_line_end(has_end);
}

}  // namespace algest::lab
