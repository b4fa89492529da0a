// SPDX-License-Identifier: GPL-3.0-or-later
// A text file, gzipped or not, line by line. What no recording may contain is refused at the line where it stands, without reading on: a
// line without end, a NUL byte, UTF-16 and other encodings than UTF-8, line ends of two kinds.
#pragma once
#include <zlib.h>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "generator/diagnostics.hpp"

namespace algest::lab {

/// Bytes that a line may have.
constexpr std::size_t longest_line = std::size_t{1} << 20U;

/// Column of byte `offset` of a line, counted from 1 in characters (UTF-8 code points). Cost: offset.
int character_column(std::string_view line, std::size_t offset);

class TextLines {
public:
    /// Opens the file; a complaint goes to `diagnostics`, which must live as long. Skips a UTF-8 byte-order mark.
    TextLines(const std::string& path, Diagnostics& diagnostics);

    /// Moves to the next line; false at the end of the file and after a complaint. Cost: the length of the line;
    /// never reads more than longest_line and one block ahead.
    bool next();

    std::string_view line() const { return line_; }  ///< without its end; valid until the next call of next()
    int number() const { return number_; }           ///< from 1
    bool refused() const { return refused_; }        ///< a complaint was made

private:
    struct Close {
        void operator()(gzFile_s* file) const { gzclose(file); }
    };

    bool read_block();
    bool refuse(Position at, const std::string& what, const std::string& right);
    bool check_encoding();
    bool check_line_end(bool has_end);

    std::string path_;
    Diagnostics* diagnostics_;
    std::unique_ptr<gzFile_s, Close> file_;
    std::string buffer_;
    std::size_t begin_ = 0;  ///< where the next line starts in buffer_
    std::string_view line_;
    int number_ = 0;
    bool refused_ = false;
    enum class LineEnd {
        unknown,
        lf,
        crlf
    } line_end_ = LineEnd::unknown;
};

}  // namespace algest::lab
