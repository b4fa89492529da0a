# SPDX-License-Identifier: GPL-3.0-or-later
"""discover on four recordings of one servo at once (`make test-long`): its friction, beside least squares of our own."""
import math
import tempfile
import unittest
from pathlib import Path

from discovery import discover, names, show, values
from environment import SHARED, SOURCE, skip
from filtered_samples import column, least_squares, motion, rms, sign, smooth

RECORDINGS = SHARED / "recordings"
RUNS = [RECORDINGS / f"servo_{name}.csv" for name in ("lift_and_drop", "sin_sin", "sin_time_square", "up_and_down")]
R = 4.02   # ohm, published


class Servo(unittest.TestCase):
    def test_dry_friction_of_a_servo(self):
        # Volts over acceleration, speed, direction and sine of the angle, on the training stretches while it is on and turns.
        half = 4   # 45 ms; 25 and 65 ms move the friction by 4 percent
        columns, volts = [[], [], [], []], []
        for run in RUNS:
            q, voltage, on = column(run, "position"), column(run, "motor_voltage"), column(run, "torque_enable")
            speed, acceleration = motion(q, 5e-3, half)
            regressors = [acceleration, speed, smooth([sign(v) if abs(v) > 0.05 else 0.0 for v in speed], half), [math.sin(x) for x in smooth(q, half)[1:-1]]]
            voltage = smooth(voltage, half)[1:-1]
            for k in range(8 * half, 7 * len(q) // 10 - 8 * half):
                if on[k] > 0.5 and abs(speed[k]) > 0.05:   # below it stands, in steps of its encoder
                    for into, x in zip(columns, regressors):
                        into.append(x[k])
                    volts.append(voltage[k])
        (_, smooth_kt, _), smooth_left = least_squares([columns[0], columns[1], columns[3]], volts)
        (_, kt, drop, _), left = least_squares(columns, volts)
        friction = drop * kt / R
        print(f"   least squares: kt {smooth_kt:.3f} N m/A without friction, {kt:.3f} with {friction:.4f} N m; residual {100 * smooth_left / rms(volts):.0f} and {100 * left / rms(volts):.0f} %")
        self.assertLess(abs(kt / 0.387 - 1), 0.05)   # published

        with tempfile.TemporaryDirectory(prefix="algest-servo-") as folder:
            found = discover(SOURCE / "tests" / "gap" / "models" / "servo.toml", RUNS[0], Path(folder) / "found", *RUNS[1:])
        show("servo, no friction", found)
        self.assertEqual((found["verdict"], names(found)), ("named", ["coulomb_friction"]))
        self.assertEqual(found["effects"][0]["equation"], "torque balance")
        # It depends on the load as well, which neither of the two says: their weights on lifting and turning differ.
        self.assertLess(abs(values(found)["Tc"] / friction - 1), 0.2)
        self.assertTrue(any("something else is missing" in d for d in found["doubts"]), found["doubts"])


if __name__ == "__main__":
    if not RUNS[0].exists():
        skip(f"there are no recordings in {SHARED}")
    unittest.main()
