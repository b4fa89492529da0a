# SPDX-License-Identifier: GPL-3.0-or-later
"""Recordings that are refused: exit 2 within a second, at the right line and column, and no output file."""
import os
import time
import unittest

from command_line import HEADER, CommandLine, coil_rows, csv

ROWS = coil_rows(100)
GOOD = csv(ROWS)
LINES = GOOD.splitlines()
ROW_60 = LINES[60]                     # line 61 of the file: t = 0.059
T, U, I = ROW_60.split(",")
AT_U = len(T) + 2                      # columns of the fields of that line
AT_I = len(T) + len(U) + 3


def with_line_61(text):
    return "\n".join(LINES[:60] + [text] + LINES[61:]) + "\n"


def with_header(text):
    return "\n".join([text] + LINES[1:]) + "\n"


# name, bytes or text, line, column (0: none is known), words of the complaint
CASES = [
    ("empty file", "", 1, 1, "empty"),
    ("byte-order mark alone", b"\xef\xbb\xbf", 1, 1, "empty"),
    ("blank lines alone", "\n\n\n", 1, 1, "empty"),
    ("header alone", HEADER + "\n", 1, 1, "no rows"),
    ("one row", "\n".join(LINES[:2]) + "\n", 2, 1, "only one row"),
    ("fewer rows than the window", "\n".join(LINES[:40]) + "\n", 40, 1, "39 samples"),
    ("no header", "\n".join(LINES[1:]) + "\n", 1, 1, "number where the header"),
    ("text in a number", with_line_61(f"{T},{U},high"), 61, AT_I, "'high' is not a number"),
    ("text after a number", with_line_61(f"{T},{U}V,{I}"), 61, AT_U, "is not a number"),
    ("text in the time", with_line_61(f"noon,{U},{I}"), 61, 1, "'noon' is not a number"),
    ("decimal comma in quotes", with_line_61(f'{T},"1,5",{I}'), 61, AT_U, "'1,5' is not a number"),
    ("decimal comma", with_line_61(f"{T},1,5,{I}"), 61, AT_U + 4, "4 fields"),
    ("hexadecimal", with_line_61(f"{T},0x1p3,{I}"), 61, AT_U, "'0x1p3' is not a number"),
    ("plus sign", with_line_61(f"{T},+1,{I}"), 61, AT_U, "'+1' is not a number in column 'u'; a decimal number such as 1.5 or -3e-4, without a plus sign in front"),
    ("NaN", with_line_61(f"{T},{U},NaN"), 61, AT_I, "'NaN' is not finite in column 'i'; a number in every row"),
    ("infinity", with_line_61(f"{T},-inf,{I}"), 61, AT_U, "'-inf' is not finite"),
    ("beyond double", with_line_61(f"{T},1e400,{I}"), 61, AT_U, "beyond the range"),
    ("empty field", with_line_61(f"{T},,{I}"), 61, AT_U, "a value is missing in column 'u'; a number in every row"),
    ("NaN in a column that the model does not need", "\n".join([HEADER + ",x"] + [line + ",1" for line in LINES[1:60]]
                                                              + [ROW_60 + ",nan"] + [line + ",1" for line in LINES[61:]]) + "\n",
     61, len(ROW_60) + 2, "'nan' is not finite in column 'x'"),
    ("missing field", with_line_61(f"{T},{U}"), 61, len(f"{T},{U}") + 1, "2 fields"),
    ("additional field", with_line_61(f"{ROW_60},7"), 61, len(ROW_60) + 2, "4 fields"),
    ("cut off in the last row", GOOD[:GOOD.rindex(",")], 101, len(LINES[100][:LINES[100].rindex(",")]) + 1, "2 fields"),
    ("blank line in the middle", with_line_61("\n" + ROW_60), 61, 1, "blank"),
    ("a row left out", "\n".join(LINES[:60] + LINES[61:]) + "\n", 61, 1, "step of 0.002 s here, 0.001 s elsewhere"),
    ("a row twice", with_line_61(ROW_60 + "\n" + ROW_60), 62, 1, "stands still"),
    ("time goes back", with_line_61(f"0.03,{U},{I}"), 61, 1, "goes back"),
    ("jitter of two percent", with_line_61(f"0.05902,{U},{I}"), 61, 1, "not uniform"),
    ("another rate from the middle on", csv([(t if k < 60 else t + (k - 59) * 1e-5, u, i) for k, (t, u, i) in enumerate(ROWS)]),
     62, 1, "not uniform"),
    ("decreasing time", csv([(-t, u, i) for t, u, i in ROWS]), 3, 1, "goes back"),
    ("another period than the model's", csv([(2 * t, u, i) for t, u, i in ROWS]), 1, 1, "every 0.002 s, the model `rl` every 0.001 s"),
    ("no time", with_header("time [s],u [V],i [A]"), 1, 1, "no column `t`"),
    ("time without unit", with_header("t,u [V],i [A]"), 1, 1, "no unit"),
    ("time in volts", with_header("t [V],u [V],i [A]"), 1, 1, "not one of time"),
    ("missing column", with_header("t [s],u [V],current [A]"), 1, 1, "no column 'i'"),
    ("two columns of one name", with_header("t [s],u [V],u [V]"), 1, 13, "second column 'u'"),
    ("two columns of time", with_header("t [s],t [ms],i [A]"), 1, 7, "second column 't'"),
    ("duplicate beyond a letter of two bytes", with_header("t [s],\u03c9 [V],t [A]"), 1, 13, "second column 't'"),
    ("column without name", with_header("t [s],[V],i [A]"), 1, 7, "no name"),
    ("unit without closing bracket", with_header("t [s],u [V,i [A]"), 1, 7, "bracket"),
    ("unit of another dimension", with_header("t [s],u [A],i [A]"), 1, 7, "does not convert to 'V'"),
    ("unit that nobody knows", with_header("t [s],u [V],i [counts; 8192 per rev]"), 1, 13, "is not known"),
    ("misspelt unit", with_header("t [s],u [Nm],i [A]"), 1, 7, "write N.m"),
    ("semicolons", GOOD.replace(",", ";"), 1, 6, "commas"),
    ("tabs", GOOD.replace(",", "\t"), 1, 6, "commas"),
    ("quote that is not closed", with_line_61(f'{T},"{U},{I}'), 61, AT_U, "quotes"),
    ("quote inside a field", with_line_61(f'{T},1"2,{I}'), 61, AT_U + 1, "quotes"),
    ("NUL byte", with_line_61(f"{T},\0,{I}"), 61, AT_U, "NUL"),
    ("UTF-16", GOOD.encode("utf-16"), 1, 1, "UTF-16"),
    ("Latin-1 in the header", "t [s],T [\u00b0C],x [1]\n".encode("latin-1") + GOOD.split("\n", 1)[1].encode(), 1, 10, "iconv -f latin1"),
    ("UTF-16 without byte-order mark", GOOD.encode("utf-16-le"), 1, 2, "UTF-16"),
    ("LF among CRLF", GOOD.replace("\n", "\r\n").replace("\r\n", "\n", 61).replace("\n", "\r\n", 60), 61, len(ROW_60) + 1, "ends with LF"),
    ("CRLF among LF", GOOD.replace("\n", "\r\n", 61).replace("\r\n", "\n", 60), 61, len(ROW_60) + 1, "ends with CRLF"),
    ("CR alone", GOOD.replace("\n", "\r"), 1, len(HEADER) + 1, "carriage return"),
    ("a line of 100 MB", GOOD + "1" * 100_000_000, 102, 1, "longer than 1 MiB"),
    ("a first line of 100 MB", "," * 100_000_000, 1, 1, "longer than 1 MiB"),
    ("100 MB of zeros", b"\0" * 100_000_000, 1, 1, "NUL"),
    ("an image", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 1, 1, "no UTF-8"),
    ("terminal commands in a field", with_line_61(f"{T},\x1b[31m,{I}"), 61, AT_U, "'?[31m' is not a number"),
]


class Malformed(CommandLine):
    def refused(self, name, line, column, words):
        start = time.monotonic()
        out, err = self.algest("replay", "rl.toml", name, "-o", "out.csv", exit_code=2)
        self.assertLess(time.monotonic() - start, 1.0)
        self.assertEqual(out, "")
        self.assertNotIn("\x1b", err)
        place = f"{name}:{line}:{column}: error: " if line else f"{name}: error: "
        matching = [text for text in err.splitlines() if text.startswith(place) and words in text]
        self.assertTrue(matching, f"no line starts with {place!r} and contains {words!r}:\n{err}")
        self.assertLess(len(err), 10_000)
        self.assertEqual([f for f in self.files() if f not in ("rl.toml", "coil.csv", name)], [])

    def test_the_recording_they_are_made_from_is_sound(self):
        self.write("r.csv", GOOD)
        self.algest("replay", "rl.toml", "r.csv")

    def test_each_is_refused_where_it_is_wrong(self):
        for name, content, line, column, words in CASES:
            with self.subTest(name):
                self.write("r.csv", content)
                self.refused("r.csv", line, column, words)

    def test_what_is_no_readable_file(self):
        (self.folder / "folder.csv").mkdir()
        self.refused("folder.csv", 0, 0, "is a directory")
        self.refused("nothing.csv", 0, 0, "No such file")
        self.refused("rl.toml/r.csv", 0, 0, "Not a directory")
        if os.geteuid() != 0:
            self.write("secret.csv", GOOD).chmod(0)
            self.refused("secret.csv", 0, 0, "Permission denied")

    def test_several_complaints_come_at_once_up_to_a_limit(self):
        self.write("r.csv", csv([("a", "b", "c")] * 3))
        _, err = self.algest("replay", "rl.toml", "r.csv", exit_code=2)
        self.assertEqual(err.count(": error: "), 9)
        self.write("r.csv", csv([("a", "b", "c")] * 100_000))
        _, err = self.algest("replay", "rl.toml", "r.csv", exit_code=2)
        self.assertEqual(err.count(": error: "), 20)


if __name__ == "__main__":
    unittest.main()
