# SPDX-License-Identifier: GPL-3.0-or-later
"""replay of several recordings: a line each, failures last, the same numbers as one by one."""
import json
import unittest

from command_line import CommandLine, coil_rows, csv


class SeveralRecordings(CommandLine):
    def setUp(self):
        super().setUp()
        self.write("long.csv", csv(coil_rows(300)))
        self.write("still.csv", csv([(k / 1000, 0.0, 0.0) for k in range(200)]))
        self.write("broken.csv", csv(coil_rows(200)).replace("0.1,", "0.1,x", 1))
        self.files_given = ["broken.csv", "still.csv", "long.csv", "nothing.csv", "coil.csv"]

    def test_a_line_each_failures_last(self):
        out, err = self.algest("replay", "rl.toml", *self.files_given, exit_code=2)
        lines = out.splitlines()
        self.assertRegex(lines[0], r"^recording +R \[ohm\] +L \[H\] +ok \[%\] +condition \[1\]$")
        self.assertEqual([line.split()[0] for line in lines[1:6]], ["long.csv", "coil.csv", "still.csv", "broken.csv", "nothing.csv"])
        self.assertRegex(lines[4], r"^broken\.csv +failed: ")
        self.assertRegex(err, r"(?m)^broken\.csv:\d+:\d+: error: ")

    def test_json_has_of_each_what_one_alone_has(self):
        value = self.algest_json("replay", "rl.toml", *self.files_given, exit_code=2)
        self.assertEqual(value["model"], "rl.toml")
        self.assertEqual([r["recording"] for r in value["recordings"]], ["long.csv", "coil.csv", "still.csv", "broken.csv", "nothing.csv"])
        for found in value["recordings"][:3]:
            self.assertEqual(found, self.algest_json("replay", "rl.toml", found["recording"]))
        for found in value["recordings"][3:]:
            self.assertEqual(list(found), ["recording", "error"])
            self.assertEqual(found["error"], self.algest_json("replay", "rl.toml", found["recording"], exit_code=2)["error"])

    def test_the_number_of_jobs_changes_nothing(self):
        names = []
        for k in range(7):
            self.write(f"r{k}.csv", csv(coil_rows(200 + 10 * k)))
            names.append(f"r{k}.csv")
        said = {self.algest("replay", "rl.toml", *names, "--json", "--jobs", jobs)[0] for jobs in (1, 2, 16)}
        self.assertEqual(len(said), 1)
        self.assertEqual([r["samples"] for r in json.loads(said.pop())["recordings"]], [200 + 10 * k for k in range(7)])

    def test_what_is_of_one_recording_is_refused(self):
        for words in (("-o", "e.csv"), ("--report", "e.html"), ("--batch",)):
            _, err = self.algest("replay", "rl.toml", "coil.csv", "long.csv", *words, exit_code=2)
            self.assertIn("there are several", err)
        self.algest("replay", "rl.toml", "coil.csv", "--jobs", "0", exit_code=2)
        self.assertEqual(sorted(self.files()), sorted(["broken.csv", "coil.csv", "long.csv", "rl.toml", "still.csv"]))


if __name__ == "__main__":
    unittest.main()
