# SPDX-License-Identifier: GPL-3.0-or-later
"""The functionals from their definitions (000, equations 3 and 8 to 10, form 1), in exact arithmetic, by other means than the
generator's: integrals interval by interval of the products (t-tau)^gamma (-tau)^j, and roundings of whole numbers.

Everything lives on the window [0,1]: t = 1, sigma = tau, sigma = 0 at the oldest sample.
"""
import math
import struct
from fractions import Fraction
from functools import lru_cache
from itertools import repeat


def leibniz_coefficient(n, kappa, i, j):
    """c_ij of Pi s^i Y = sum_j c_ij s^(i+j-n) Y^(j)."""
    power = i + j - n
    return math.comb(kappa + n, j) * math.factorial(kappa + i) // math.factorial(power) if power >= 0 else 0


def definition(n, kappa, i, p):
    """F_{i,p}[f] = sum over (j, gamma, c) of c times the integral of (1-sigma)^gamma sigma^j f: the signs of (-sigma)^j are in c."""
    terms = []
    for j in range(kappa + n + 1):
        c = leibniz_coefficient(n, kappa, i, j)
        gamma = kappa + 2 * n + p - i - j - 1
        if c != 0:
            terms.append((j, gamma, Fraction((-1) ** j * c, math.factorial(gamma))))
    return terms


def value(terms, sigma):
    return sum((c * (1 - sigma) ** gamma * sigma ** j for j, gamma, c in terms), Fraction(0))


def moment(terms, r):
    """F[sigma^r] by Euler's beta integral: the integral of (1-s)^g s^(j+r) over [0,1] is g! (j+r)! / (g+j+r+1)!."""
    return sum((c * Fraction(math.factorial(gamma) * math.factorial(j + r), math.factorial(gamma + j + r + 1))
                for j, gamma, c in terms), Fraction(0))


def polynomial(terms):
    """Coefficients in sigma, lowest power first, without zeros at the end."""
    out = [Fraction(0)] * (1 + max(j + gamma for j, gamma, _ in terms))
    for j, gamma, c in terms:
        for k in range(gamma + 1):
            out[j + k] += c * math.comb(gamma, k) * (-1) ** k
    while out and out[-1] == 0:
        out.pop()
    return out


def interval_integrals(terms, intervals, chosen):
    """For each m of `chosen`: the integrals over [m/M, (m+1)/M] of kernel and of x times kernel, where sigma = (m + x)/M.

    Whole numbers, and the one denominator of all of them.
    """
    degrees = {j + gamma for j, gamma, _ in terms}
    assert len(degrees) == 1          # gamma + j = kappa + 2n + p - i - 1 whatever j is: M^-degree comes out of the sum
    degree = degrees.pop()
    common = math.lcm(*(c.denominator for _, _, c in terms))
    parts = math.lcm(*range(1, degree + 3))      # of the integrals of x^k and x^(k+1)
    products = [(j, gamma, c.numerator * (common // c.denominator)) for j, gamma, c in terms]
    binomial = [[math.comb(a, k) for k in range(a + 1)] for a in range(degree + 1)]
    whole = [parts // (k + 1) for k in range(degree + 1)]
    tilted = [parts // (k + 2) for k in range(degree + 1)]
    out = {}
    for m in chosen:
        below, above = powers(m, degree), powers(intervals - m, degree)
        total = [0] * (degree + 1)               # of the kernel times common M^degree, in x
        for j, gamma, c in products:
            # (M - m - x)^gamma (m + x)^j, both binomials written out
            left = [c * (-1) ** k * b * above[gamma - k] for k, b in enumerate(binomial[gamma])]
            right = [b * below[j - k] for k, b in enumerate(binomial[j])]
            for k, a in enumerate(left):
                if a:
                    for q, b in enumerate(right):
                        total[k + q] += a * b
        out[m] = (sum(a * b for a, b in zip(total, whole)), sum(a * b for a, b in zip(total, tilted)))
    return out, common * parts * intervals ** (degree + 1)


def powers(base, most):
    out = [1]
    for _ in repeat(None, most):
        out.append(out[-1] * base)
    return out


@lru_cache(maxsize=None)
def weights(n, kappa, i, p, intervals, kind, chosen=None):
    """What each sample is multiplied by, oldest first: whole numbers and their denominator. `chosen`: of these samples only.

    kind zoh: sample m is held over [m/M, (m+1)/M]. linear: the straight lines between samples. trapezoid, simpson: kernel times
    sample, by that rule.
    """
    terms = definition(n, kappa, i, p)
    samples = tuple(range(intervals + 1)) if chosen is None else chosen
    if kind in ("zoh", "linear"):
        needed = {m for s in samples for m in ((s,) if kind == "zoh" else (s - 1, s)) if 0 <= m < intervals}
        integrals, denominator = interval_integrals(terms, intervals, sorted(needed))
        none = (0, 0)
        if kind == "zoh":
            return [integrals.get(m, none)[0] for m in samples], denominator
        # the hat of sample m: 1 - x on the interval after it, x on the interval before
        return [integrals.get(m, none)[0] - integrals.get(m, none)[1] + integrals.get(m - 1, none)[1] for m in samples], denominator
    rule = {"trapezoid": lambda m: Fraction(1, 2) if m in (0, intervals) else Fraction(1),
            "simpson": lambda m: Fraction(1 if m in (0, intervals) else 4 if m % 2 == 1 else 2, 3)}[kind]
    fractions = [value(terms, Fraction(m, intervals)) * rule(m) / intervals for m in samples]
    denominator = math.lcm(*(f.denominator for f in fractions))
    return [f.numerator * (denominator // f.denominator) for f in fractions], denominator


def nearest_double(numerator, denominator):
    """float(Fraction) is the quotient of two whole numbers, which Python rounds once, to nearest even, denormals included."""
    try:
        return numerator / denominator
    except OverflowError:
        return math.inf if numerator > 0 else -math.inf


def nearest_float(numerator, denominator):
    """The nearest number of IEEE binary32, as a Python float: a whole multiple of the spacing there, halves to even."""
    size = abs(numerator)
    exponent = size.bit_length() - denominator.bit_length()        # 2^(exponent-1) < size/denominator < 2^(exponent+1)
    if size and size < denominator * Fraction(2) ** exponent:
        exponent -= 1                                               # 2^exponent <= size/denominator
    spacing = max(exponent - 23, -149)
    above, below = (size << -spacing, denominator) if spacing < 0 else (size, denominator << spacing)
    multiple, rest = divmod(above, below)
    if 2 * rest > below or (2 * rest == below and multiple % 2 == 1):
        multiple += 1
    out = math.inf if size and multiple * Fraction(2) ** spacing >= Fraction(2) ** 128 else math.ldexp(multiple, spacing)
    return -out if numerator < 0 else out


def bits(number):
    """Tells -0 from 0, and makes a difference visible."""
    return struct.pack(">d", number).hex()
