# SPDX-License-Identifier: GPL-3.0-or-later
"""One recording in every form that is read: the numbers that come out are the same."""
import gzip
import struct
import unittest

from command_line import CommandLine, coil_rows, csv

ROWS = coil_rows(200)
PLAIN = csv(ROWS)


def element(kind, data):
    """A data element of MATLAB's level 5 format: a tag, the bytes, and zeros up to a multiple of eight."""
    return struct.pack("<II", kind, len(data)) + data + bytes(-len(data) % 8)


def matrix(name, kind, dims, content, flags=0):
    head = element(6, struct.pack("<II", kind | flags << 8, 0)) + element(5, struct.pack("<ii", *dims)) + element(1, name.encode())
    return element(14, head + content)


def vector(name, values):
    return matrix(name, 6, (len(values), 1), element(9, struct.pack(f"<{len(values)}d", *values)))


def units(**texts):
    width = 32
    names = b"".join(n.encode().ljust(width, b"\0") for n in texts)
    fields = b"".join(matrix("", 4, (1, len(t)), element(4, struct.pack(f"<{len(t)}H", *t.encode()))) for t in texts.values())
    return matrix("units", 2, (1, 1), struct.pack("<HHi", 5, 4, width) + element(1, names) + fields)


def mat(*variables):
    return b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack("<H", 0x0100) + b"IM" + b"".join(variables)


T, U, I = ([row[k] for row in ROWS] for k in range(3))


class Formats(CommandLine):
    def parameters(self, recording, *words):
        return self.algest_json("replay", "rl.toml", recording, *words)["parameters"]

    def refused(self, recording, *words):
        return self.algest("replay", "rl.toml", recording, *words, exit_code=2)[1]

    def test_text(self):
        expected = self.parameters("coil.csv")
        semicolons = PLAIN.replace(",", ";")
        self.write("packed.csv.gz", gzip.compress(PLAIN.encode()))
        self.write("semicolons.csv", semicolons)
        self.write("comma.csv", semicolons.replace(".", ","))
        self.write("tabs.csv", PLAIN.replace(",", "\t"))
        self.write("tabs_comma.csv", PLAIN.replace(",", "\t").replace(".", ","))
        for words in (["packed.csv.gz"], ["semicolons.csv", "--separator", "semicolon"], ["comma.csv", "--decimal-comma"],
                      ["tabs.csv", "--separator", "tab"], ["tabs_comma.csv", "--decimal-comma", "--separator", "tab"]):
            with self.subTest(words=words):
                self.assertEqual(self.parameters(*words), expected)
        self.assertIn("--decimal-comma", self.refused("comma.csv"))
        self.assertIn("--decimal-comma", self.refused("comma.csv", "--separator", "semicolon"))
        self.assertIn("1,5", self.refused("semicolons.csv", "--decimal-comma"))   # its points are no decimal signs
        self.assertIn("comma", self.refused("coil.csv", "--separator", "dash"))

    def test_simulate_and_discover_read_them_too(self):
        model = (self.folder / "rl.toml").read_text().replace('unit = "A"', 'unit = "A", initial = 0')
        self.write("rl.toml", model)
        self.write("comma.csv", PLAIN.replace(",", ";").replace(".", ","))
        self.assertEqual(self.algest_json("simulate", "rl.toml", "comma.csv", "--decimal-comma")["outputs"],
                         self.algest_json("simulate", "rl.toml", "coil.csv")["outputs"])
        self.assertEqual(self.algest_json("discover", "rl.toml", "comma.csv", "--decimal-comma", "-o", "a")["verdict"],
                         self.algest_json("discover", "rl.toml", "coil.csv", "-o", "b")["verdict"])

    def test_a_packed_file_cut_off(self):
        packed = gzip.compress(PLAIN.encode())
        self.write("cut.csv.gz", packed[:len(packed) // 2])
        self.assertIn("cut.csv.gz: error: the gzipped file ends too early", self.refused("cut.csv.gz"))
        self.write("bent.csv.gz", packed[:40] + bytes(20) + packed[60:])
        self.assertIn("bent.csv.gz: error: the gzipped file is damaged", self.refused("bent.csv.gz"))

    def test_matlab(self):
        self.write("run.mat", mat(vector("t", T), vector("u", [1000 * u for u in U]), vector("i", I), vector("gain", [1.0, 2.0]), units(u="mV", i="A")))
        out, err = self.algest("replay", "rl.toml", "run.mat", "--json")
        self.assertIn("run.mat: note: variable 'gain' is left out", err)
        self.assertNotIn("warning", err)
        for found, expected in zip(self.parameters("run.mat"), self.parameters("coil.csv")):
            self.assertAlmostEqual(found["median"], expected["median"], delta=1e-9 * expected["median"])   # 1000 times, and back
        self.write("bare.mat", mat(vector("t", T), vector("u", U), vector("i", I)))
        self.assertEqual(self.parameters("bare.mat"), self.parameters("coil.csv"))

    def test_a_unit_shorter_than_its_file_promises_is_none(self):
        # 300 characters, of which there are three: reading on would be reading what is not there (found by fuzzing)
        promised = units(u="mmV").replace(struct.pack("<ii", 1, 3), struct.pack("<ii", 1, 300))
        self.write("short.mat", mat(vector("t", T), vector("u", U), vector("i", I), promised))
        self.assertEqual(self.parameters("short.mat"), self.parameters("coil.csv"))

    def test_matlab_files_at_fault(self):
        uneven = T[:50] + [t + 0.01 for t in T[50:]]
        nan = I[:7] + [float("nan")] + I[8:]
        for content, words in ((b"no such file", "cannot be read as a MATLAB file"), (mat(vector("u", U)), "there is no vector `t`"),
                               (mat(vector("t", uneven), vector("u", U), vector("i", I)), "a step of 0.011 s at t(51), 0.001 s elsewhere"),
                               (mat(vector("t", T), vector("u", U), vector("i", nan)), "i(8) is not finite"),
                               (mat(vector("t", T), vector("u", U)), "no column 'i'"),
                               (mat(vector("t", T), vector("u", U), vector("i", I), units(t="V")), "not one of time")):
            with self.subTest(words=words):
                self.write("wrong.mat", content)
                self.assertIn(words, self.refused("wrong.mat"))


if __name__ == "__main__":
    unittest.main()
