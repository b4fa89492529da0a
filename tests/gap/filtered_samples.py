# SPDX-License-Identifier: GPL-3.0-or-later
"""Least squares over filtered samples, as a reader would check a force balance by hand: nothing of algest is in it."""
import math


def smooth(x, half):
    """Three moving averages of 2 half + 1 samples, symmetric: no delay."""
    for _ in range(3):
        sums = [0.0]
        for value in x:
            sums.append(sums[-1] + value)
        ends = [(max(0, k - half), min(len(x), k + half + 1)) for k in range(len(x))]
        x = [(sums[b] - sums[a]) / (b - a) for a, b in ends]
    return x


def motion(position, period, half):
    """Speed and acceleration of the filtered position by central differences; the first and last sample are left out."""
    q = smooth(position, half)
    speed = [(q[k + 1] - q[k - 1]) / (2 * period) for k in range(1, len(q) - 1)]
    acceleration = [(q[k + 1] - 2 * q[k] + q[k - 1]) / period**2 for k in range(1, len(q) - 1)]
    return speed, acceleration


def sign(x):
    return math.copysign(1.0, x) if x else 0.0


def least_squares(columns, y):
    """Coefficients of the columns, rms of what is left."""
    size = len(columns)
    rows = [[sum(p * q for p, q in zip(a, b)) for b in columns] + [sum(p * q for p, q in zip(a, y))] for a in columns]
    for i in range(size):   # Gauss-Jordan with pivots: at most five columns
        pivot = max(range(i, size), key=lambda r: abs(rows[r][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for r in range(size):
            if r != i:
                factor = rows[r][i] / rows[i][i]
                rows[r] = [a - factor * b for a, b in zip(rows[r], rows[i])]
    coefficients = [rows[i][size] / rows[i][i] for i in range(size)]
    return coefficients, rms(residual(columns, coefficients, y))


def residual(columns, coefficients, y):
    return [v - sum(c * column[k] for c, column in zip(coefficients, columns)) for k, v in enumerate(y)]


def rms(x):
    return math.sqrt(sum(v * v for v in x) / len(x))


def column(recording, name):
    """A column of a CSV file by the name in its header, unit left away."""
    lines = recording.read_text(encoding="utf-8").splitlines()
    header = [cell.split(" [")[0] for cell in lines[0].split(",")]
    place = header.index(name)
    return [float(line.split(",")[place]) for line in lines[1:]]
