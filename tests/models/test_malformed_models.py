# SPDX-License-Identifier: GPL-3.0-or-later
"""Model files that are refused: exit 2 within a second, at the right line and column, and nothing is written; the same from
`check`, `derive` and `generate`. In the texts below the mark ▸ stands where the complaint belongs (two complaints: two marks)."""
import json
import os
import unittest

from model_case import MARK, ModelCase, complaints, without_marks

# An RL circuit, with units.
COIL = """\
name = "m"

[sampling]
period = 0.001
window = 0.02

[signals]
v = { unit = "V" }
i = { unit = "A" }

[constants]
gain = { value = 2, unit = "1" }

[parameters]
R = { unit = "ohm" }
L = { unit = "H" }

[[equation]]
ode = "L*der(i) = gain*v - R*i"
"""

# The same shape without units, where only the formula counts.
PLAIN = """\
name = "m"
[sampling]
period = 0.001
window = 0.02
[signals]
x = {}
y = {}
u = {}
[constants]
c = { value = 2 }
[parameters]
a = {}
b = {}
[[equation]]
ode = "der(x) = a*x + b*u"
"""

TRANSFER = """\
name = "m"
[sampling]
period = 0.001
window = 0.02
[signals]
y = { unit = "rad" }
u = { unit = "V" }
w = { unit = "-" }
[transfer]
n = 2
unknowns = ["a0", "a1", "b0"]
"""

SEVERAL_INPUTS = """\
name = "m"
[sampling]
period = 0.001
window = 0.02
[signals]
y = { unit = "rad" }
u = { unit = "V" }
w = { unit = "-" }
[transfer]
n = 1
unknowns = ["a0"]
[[transfer.input]]
signal = "u"
unknowns = ["b0"]
[[transfer.input]]
signal = "w"
unknowns = ["c0"]
"""


HEAT = """\
name = "m"
[sampling]
period = 1
window = 20
[signals]
T = { unit = "degC" }
room = { unit = "K" }
[parameters]
rate = { unit = "1/s" }
[[equation]]
ode = "der(T)/rate = -(T - room)"
"""

# Two equations of different units that share a parameter.
MOTOR = """\
name = "m"
[sampling]
period = 0.001
window = 0.02
[signals]
u = { unit = "V" }
i = { unit = "A" }
w = { unit = "rad/s" }
[parameters]
R = { unit = "ohm" }
K = { unit = "V.s/rad" }
b = { unit = "N.m.s/rad" }
[constants]
L = { value = 0.1, unit = "H" }
J = { value = 0.1, unit = "kg.m^2/rad" }
c = { value = 1, unit = "N.m.rad/(V.A.s)" }
[[equation]]
ode = ▸"L*der(i) = u - R*i - K*w"
[[equation]]
ode = "J*der(w) = c*K*i - b*w"
[estimator]
solve = "robust"
"""


def changed(text, *pairs):
    """The text with replacements; what is replaced must stand there exactly once."""
    for old, new in zip(pairs[::2], pairs[1::2]):
        assert text.count(old) == 1, (old, text.count(old))
        text = text.replace(old, new)
    return text


def coil(*pairs):
    return changed(COIL, *pairs)


def transfer(*pairs):
    return changed(TRANSFER, *pairs)


def inputs(*pairs):
    return changed(SEVERAL_INPUTS, *pairs)


def ode(text):
    """PLAIN with another equation, in double quotes."""
    return changed(PLAIN, "der(x) = a*x + b*u", text)


def coil_ode(text):
    return coil("L*der(i) = gain*v - R*i", text)


def written(quotes):
    """PLAIN with another equation; quotes and all."""
    return changed(PLAIN, '"der(x) = a*x + b*u"', quotes)


def estimator(text):
    return COIL + "[estimator]\n" + text


NOISY = COIL.replace('i = { unit = "A" }', 'i = { unit = "A", noise = 0.01 }')


def noisy(text):
    """COIL with noise on the current."""
    return NOISY + "[estimator]\n" + text


# Operating points of the coil; the last section is [estimator].
POINTS = changed(estimator('functional = "average"\nsolve = "least_squares"\n'), 'i = { unit = "A" }', 'i = { unit = "A", steady = 0.1 }', "L*der(i) = gain*v - R*i", "v = R*i + L*der(i)",
                 'gain = { value = 2, unit = "1" }', 'L = { value = 2, unit = "H" }', 'L = { unit = "H" }\n\n[[', '\n[[')


def computed(formula):
    """COIL with a computed signal beside another one."""
    return coil('v = { unit = "V" }', 'v = { unit = "V" }\np = { unit = "V", formula = "v" }\nq2 = { unit = "V", formula = "' + formula + '" }')


def equation(text):
    """COIL with more keys in its equation, the last section."""
    return COIL + text


def feedback(text):
    return COIL + "[[feedback]]\n" + text


def declared(name):
    """COIL with one more parameter, which is in use, so that the name is all that is wrong."""
    return coil("L = {", name + ' = { unit = "V" }\nL = {')


def crlf(text):
    return text.replace("\n", "\r\n")


TOML = [
    ("text not closed", coil('name = "m"', 'name = "m▸'), "not closed on its line"),
    ("text not closed, CRLF", crlf(coil('unit = "V" }', 'unit = "V }▸')), "not closed on its line"),
    ("no value", coil('name = "m"', "name = ▸"), "expected value"),
    ("no equals sign", coil('name = "m"', 'name ▸"m"'), "expected '='"),
    ("something after a value", coil("0.02", "0.02 ▸s"), "expected"),
    ("decimal comma", coil("0.02", "0▸,02"), "expected"),
    ("key twice", coil("[sampling]", 'name = ▸"n"\n[sampling]'), "redefine"),
    ("section twice", COIL + "▸[sampling]\n", "redefine"),
    ("section not closed", coil("[sampling]", "[sampling▸"), "expected ']'"),
    ("inline table not closed", coil('{ unit = "H" }', '{ unit = "H" ▸'), "closing '}'"),
    ("comma before the end of an inline table", coil('{ unit = "H" }', '{ unit = "H", ▸}'), "dangling comma"),
    ("unknown escape", coil('name = "m"', 'name = "\\▸q"'), "escape"),
    ("control character", coil('name = "m"', 'name = "m▸\x01"'), "control characters"),
    ("literal text not closed", coil("[sampling]", "source = '''x▸", ).split("period")[0].rstrip("\n") + "\n", "end-of-file"),
    ("NUL byte", coil("[sampling]", "▸\0[sampling]"), "\\u0000"),
    ("an executable", "▸\x7fELF\x02\x01\x01\0\0\0", "\\u007F"),
    ("an image", "▸\udc89PNG\r\n\x1a\n\0\0", "not UTF-8"),
    ("not UTF-8", coil('name = "m"', 'name = "größe▸\udcff"'), "not UTF-8"),
    ("overlong UTF-8", coil('name = "m"', 'name = "▸\udcc0\udcaf"'), "not UTF-8"),
    ("a surrogate", coil('name = "m"', 'name = "▸\udced\udca0\udc80"'), "not UTF-8"),
    ("cut off in a character", COIL + "# ▸\udce2\udc86", "not UTF-8"),
    ("UTF-16", "▸\udcff\udcfen\0a\0", "not UTF-8"),
    ("carriage returns alone", '# model▸\rname = "m"\r', "'\\r'"),
    ("bare key that is not ASCII", coil("R = {", "▸ω = {"), "saw 'ω'"),
    ("arrays in arrays", "x = " + "[" * 256 + "▸" + "[" * 1000, "depth"),
    ("key of eleven parts", "a.b.c.d.e.f.g.h.i.j▸.k = 1\n", "more than 10 parts"),
    ("key of 200 000 parts", "s = '.' # ...\n" + "a." * 9 + "a▸" + ".a" * 200_000 + " = 1\n", "more than 10 parts"),
    ("section of 200 000 parts", 's = """"\n\\"..."""\n[' + "a." * 9 + "a▸" + ".a" * 200_000 + "]\n", "more than 10 parts"),
]

KEYS = [
    ("misspelt key", coil("[sampling]", '▸sumary = "x"\n[sampling]'), "did you mean summary?"),
    ("misspelt section", COIL + "[▸estimater]\n", "did you mean estimator?"),
    ("key of another program", COIL + "[▸plotting]\n", "keys here: format, name"),
    ("misspelt key of sampling", coil("[sampling]", "[sampling]\n▸growning = true"), "did you mean growing?"),
    ("misspelt key of a signal", coil('i = { unit = "A"', 'i = { unit = "A", ▸niose = 1'), "did you mean noise?"),
    ("misspelt key of a constant", coil('unit = "1"', 'unit = "1", ▸val = 1'), "did you mean value?"),
    ("misspelt key of a parameter", coil('R = { ', 'R = { ▸inital = 1, '), "did you mean initial?"),
    ("misspelt key of an equation", COIL + "▸kapa = 1\n", "did you mean kappa?"),
    ("misspelt key of the transfer equation", transfer("n = 2", "n = 2\n▸unknown = []"), "did you mean unknowns?"),
    ("misspelt key of an input", inputs('"w"', '"w"\n▸knwon = {}'), "did you mean known?"),
    ("misspelt key of the estimator", estimator("▸forgeting = 1\n"), "did you mean forgetting?"),
    ("misspelt key of feedback", feedback('signal = "v"\nlaw = "i"\n▸gain = 1\n'), "unknown key 'gain'"),
    ("key as near to one as to another", coil('R = { ', 'R = { ▸mix = 1, '), "unknown key 'mix'; keys here"),
    ("capital letter", coil('R = { unit', 'R = { ▸Unit'), "did you mean unit?"),
    ("no name", "▸" + coil('name = "m"', ""), "no name"),
    ("nothing", "▸▸▸", "no name"),
    ("comments alone", "▸▸▸# a model\n", "no equation"),
    ("byte-order mark alone", "\ufeff▸▸▸", "no [signals]"),
    ("no signals", '▸name = "m"\n[sampling]\nperiod = 1\nwindow = 2\n[[equation]]\node = "▸i = 1"\n', "unknown name 'i'"),
    ("no equation", "▸" + COIL.split("[[equation]]")[0], "no equation"),
    ("empty list of equations", "▸" + changed(COIL.split("[[equation]]")[0], "[sampling]", "equation = []\n[sampling]"), "no equation"),
    ("no ode", COIL + "▸[[equation]]\nkappa = 0\n", "without ode"),
    ("constant without value", coil('gain = { value = 2, ', "▸gain = { "), "has no value"),
    ("feedback without law", COIL + '▸[[feedback]]\nsignal = "v"\n', "needs signal and law"),
    ("feedback without signal", COIL + '▸[[feedback]]\nlaw = "i"\n', "needs signal and law"),
    ("transfer without n", transfer("[transfer]\nn = 2", "▸[transfer]"), "without n"),
    ("input without signal", inputs('[[transfer.input]]\nsignal = "w"', "▸[[transfer.input]]"), "without signal"),
    ("transfer and equation", TRANSFER + '▸[[equation]]\node = "der(y) = u"\n', "one or the other"),
    ("equation in single brackets", coil("[[equation]]", "▸[equation]"), "write [[equation]]"),
    ("transfer in double brackets", transfer("[transfer]", "▸[[transfer]]"), "write [transfer]"),
    ("signals in double brackets", 'name = "m"\n▸[[signals]]\nx = {}\n[[equation]]\node = "▸x = 1"\n', "write [signals]"),
    ("101 signals", coil("i = {", "".join(f's{k} = {{ unit = "V" }}\n' for k in range(98)) + 'i = { unit = "A" }\n▸t = {'), "more than 100"),
    ("101 equations", COIL + '[[equation]]\node = "i = i"\n' * 99 + '▸[[equation]]\node = "i = i"\n' + '[[equation]]\node = "nonsense"\n' * 9, "more than 100"),
]

VALUES = [
    ("name that is a number", coil('name = "m"', "name = ▸3"), "not a text"),
    ("another format", "format = ▸2\n" + COIL, "format is not 1"),
    ("format as text", 'format = ▸"1"\n' + COIL, "format is not 1"),
    ("summary that is a list", "summary = ▸[]\n" + COIL, "not a text"),
    ("sampling that is a number", "sampling = ▸3\n" + COIL.replace("[sampling]\nperiod = 0.001\nwindow = 0.02\n", ""), "write [sampling]"),
    ("signal that is a text", coil('v = { unit = "V" }', 'v = ▸"V"', "gain*v", "gain*▸v"), "not a table"),
    ("unit that is a number", coil('unit = "H"', "unit = ▸1"), "not a text"),
    ("hold that is a number", coil('unit = "V"', 'unit = "V", hold = ▸0'), "not a text"),
    ("unknown hold", coil('unit = "V"', 'unit = "V", hold = ▸"cubic"'), "linear | zoh"),
    ("column that is a number", coil('unit = "V"', 'unit = "V", column = ▸3'), "not a text"),
    ("scored that is a text", coil('unit = "V"', 'unit = "V", scored = ▸"no"'), "true or false"),
    ("period that is a text", coil("0.001", '▸"fast"'), "not a number"),
    ("period that is a truth", coil("0.001", "▸true"), "not a number"),
    ("period that is a date", coil("0.001", "▸1979-05-27"), "not a number"),
    ("period with a unit", coil("0.001", '▸"1 ms"'), "not a number"),
    ("fraction with zero below", coil("0.001", '▸"1/0"'), "not a number"),
    ("window that is a list", coil("0.02", "▸[0.02]"), "not a number"),
    ("window that is not a number", coil("0.02", "▸nan"), "not finite"),
    ("infinite window", coil("0.02", "▸inf"), "not finite"),
    ("infinite period", coil("0.001", "▸-inf"), "not finite"),
    ("noise that is not a number", coil('unit = "A"', 'unit = "A", noise = ▸nan'), "not finite"),
    ("infinite constant", coil("value = 2", "value = ▸+inf"), "not finite"),
    ("constant beyond double", coil("value = 2", 'value = ▸"1e101"'), "beyond 1e100"),
    ("constant next to zero", coil("value = 2", "value = ▸-1e-101"), "closer to 0 than 1e-100"),
    ("exponent beyond all reading", coil("value = 2", 'value = ▸"1e99999999999"'), "not a number"),
    ("a number of 300 000 digits", coil("value = 2", 'value = ▸"' + "1" * 300_000 + '"'), "not a number"),
    ("period of zero", coil("0.001", "▸0"), "not positive"),
    ("negative period", coil("0.001", "▸-0.001"), "not positive"),
    ("period of a picosecond", coil("0.001", "▸1e-12", "0.02", "1e-9"), "below 1e-9 s"),
    ("window of zero", coil("0.02", "▸0.0"), "not positive"),
    ("negative window", coil("0.02", '▸"-1/50"'), "not positive"),
    ("window of three centuries", coil("0.02", "▸1e10"), "beyond 1e9 s"),
    ("window with a rest", coil("0.02", "▸0.0205"), "between 20 and 21"),
    ("window of one period", coil("0.02", "▸0.001"), "shorter than two"),
    ("window shorter than a period", coil("0.02", "▸0.0005"), "shorter than two"),
    ("window of a million and one periods", coil("0.02", "▸1000.001"), "more than 1000000"),
    ("growing window on tables", coil("window = 0.02", "window = 0.02\ngrowing = ▸true"), "needs engine moments"),
    ("growing that is a number", coil("window = 0.02", "window = 0.02\ngrowing = ▸1"), "true or false"),
    ("negative noise", coil('unit = "A"', 'unit = "A", noise = ▸-0.1'), "negative"),
    ("negative resolution", coil('unit = "A"', 'unit = "A", resolution = ▸-0.1'), "negative"),
    ("limits the wrong way round", coil('unit = "A"', 'unit = "A", min = 2, max = ▸1'), "not above min"),
    ("limits that leave nothing", coil('unit = "H"', 'unit = "H", min = 1, max = ▸1'), "not above min"),
    ("initial value below its limit", coil('unit = "H"', 'unit = "H", min = 1, initial = ▸0.5'), "outside [min, max]"),
    ("initial value above its limit", coil('unit = "H"', 'unit = "H", initial = ▸"7/2", max = 3'), "outside [min, max]"),
    ("kappa with a point", COIL + "kappa = ▸1.0\n", "whole number from 0 to 8"),
    ("negative kappa", COIL + "kappa = ▸-1\n", "whole number from 0 to 8"),
    ("kappa of nine", COIL + "kappa = ▸9\n", "whole number from 0 to 8"),
    ("no rows", COIL + "rows = ▸0\n", "whole number from 1 to 40"),
    ("rows as text", COIL + 'rows = ▸"2"\n', "whole number from 1 to 40"),
    ("an empty list of rows", COIL + "rows = ▸[]\n", "rows is empty"),
    ("a row twice", COIL + "rows = [1, 2, ▸1]\n", "each once"),
    ("row 41", COIL + "rows = [1, ▸41]\n", "from 1 to 40"),
    ("row with a point", COIL + "rows = [▸1.5, 2]\n", "from 1 to 40"),
    ("row of 2^63 - 1", COIL + "rows = ▸9223372036854775807\n", "from 1 to 40"),
    ("fewer rows than unknowns", COIL + "rows = ▸1\n", "cannot determine R/L, from which R follows: 1 row for 2 unknowns"),
    ("fewer rows than unknowns in the second equation", PLAIN + '[[equation]]\node = "der(y) = p*u + q*x"\nrows = ▸1\n[parameters.p]\n[parameters.q]\n', "cannot determine q: 3 rows for 4 unknowns"),
    ("scale of zero", COIL + "scale = ▸0\n", "not positive"),
    ("ode that is a number", coil('"L*der(i) = gain*v - R*i"', "▸3"), "not a text"),
    ("two equations of a name", COIL + 'name = "a"\n[[equation]]\nname = ▸"a"\node = "i = i"\n', "two equations are named 'a'"),
    ("unknown functional", estimator('functional = ▸"magic"\n'), "annihilator | discrete | derivative | average"),
    ("average without a word on what is steady", estimator('functional = ▸"average"\nsolve = "least_squares"\n'), "nothing says when the machine is steady"),
    ("average of the rows of one instant", estimator('functional = "average"\nstretches = "v"\nsolve = ▸"square"\n'), "pooled over operating points"),
    ("average over three periods", changed(POINTS, "0.02", "▸0.003"), "at least four periods"),
    ("average of a decimated signal", changed(POINTS, "[sampling]\n", "▸[sampling]\ndecimate = 2\n"), "averages already"),
    ("average that annihilates", changed(POINTS, 'ode = "', 'kappa = 1\node = ▸"'), "asks for kappa"),
    ("average of two rows", changed(POINTS, 'ode = "', 'rows = 2\node = ▸"'), "asks for rows"),
    ("average of derivatives alone", changed(POINTS, '"v = R*i + L*der(i)"', '▸"L*der(i) = R/2*der(q)"', 'v = { unit = "V" }', 'v = { unit = "V" }\nq = { unit = "A" }', 'L = { value = 2, unit = "H" }', 'L = { value = 2, unit = "ohm" }'), "says nothing of it"),
    ("average of a derivative's sign", changed(POINTS, '"v = R*i + L*der(i)"', '▸"v = R*i*sgn(der(i))"'), "no mean in a steady state"),
    ("stretches that no signal numbers", POINTS + 'stretches = ▸"vv"\n', "did you mean v?"),
    ("stretches of windows", estimator('stretches = ▸"v"\n'), 'stretches is for functional = "average"'),
    ("stages of least squares", estimator('solve = "least_squares"\nstages = ▸["equation 1"]\n'), 'stages is for solve = "elimination"'),
    ("a stage that is no equation", estimator('solve = "elimination"\nstages = [▸"equation 2"]\n'), "did you mean equation 1?"),
    ("a stage twice", estimator('solve = "elimination"\nstages = ["equation 1", ▸"equation 1"]\n'), "is there twice"),
    ("an equation in no stage", changed(PLAIN, 'ode = "der(x) = a*x + b*u"\n', 'name = "p"\node = "der(x) = a*x + b*u"\n[[equation]]\nname = "q"\node = "der(y) = a*x + b*u"\n[estimator]\nsolve = "elimination"\nstages = [▸"p"]\n'), "leaves out equation 'q'"),
    ("elimination of what has no known side", PLAIN.replace('"der(x) = a*x + b*u"', '▸"a*der(x) = a^2*x + b*u"') + '[estimator]\nsolve = "elimination"\n', "elimination needs one that has none"),
    ("elimination of three parameters", PLAIN.replace('"der(x) = a*x + b*u"', '▸"der(x) = a*b*x + b*d*u + a*d*y + a^2*x*u"').replace("b = {}", "b = {}\nd = {}") + '[estimator]\nsolve = "elimination"\n', "here are 3: a, b, d, because of the term (-a*b)*x"),
    ("perturbation beside elimination", changed(PLAIN, 'ode = "', 'kappa = 1\nperturbation = ▸"shove"\node = "') + '[estimator]\nsolve = "elimination"\n', "not to be had with elimination"),
    ("resultant of too high a degree", PLAIN.replace('"der(x) = a*x + b*u"', '▸"der(x) = a^5*b*x + b^5*a*u + a*b*y"') + '[estimator]\nsolve = "elimination"\n', "too high a degree"),
    ("formula of an unknown name", computed("2*▸q"), "unknown name 'q'"),
    ("formula with a derivative", computed("▸der(v)"), "der() in a computed signal"),
    ("formula with a delay", computed("▸delay(v, 0.001)"), "delay() in a computed signal"),
    ("formula with a parameter", computed("▸R*i"), "a parameter in a computed signal"),
    ("formula of a computed signal", computed("2*▸p"), "is computed too"),
    ("formula of another unit", computed("▸i"), "differ"),
    ("a computed signal under the parabola filter", changed(coil('v = { unit = "V" }', 'v = { unit = "V" }\n▸q2 = { unit = "A", formula = "2*i" }'), "L*der(i) = gain*v - R*i", "L*der(i) = gain*v - R*i + L*0.001*sgn(der(q2))*der(i)"), "runs on measured signals"),
    ("empty formula", coil('v = { unit = "V" }', 'v = { unit = "V" }\np = { unit = "V", formula = ▸"" }'), "an empty formula"),
    ("formula beside a column", coil('v = { unit = "V" }', 'v = { unit = "V" }\np = { unit = "V", formula = "v", column = ▸"c" }'), "column beside formula"),
    ("drift of zero", coil('v = { unit = "V" }', 'v = { unit = "V", steady = ▸0 }'), "not positive"),
    ("unknown solver", estimator('solve = ▸"cholesky"\n'), "square | robust | least_squares | elimination"),
    ("misspelt solver", estimator('solve = ▸"least_sqaures"\n'), "did you mean least_squares?"),
    ("form 3", estimator("form = ▸3\n"), "whole number from 1 to 2"),
    ("unknown engine", estimator('engine = ▸"gpu"\n'), "fir | moments"),
    ("unknown quadrature", estimator('quadrature = ▸"romberg"\n'), "exact | trapezoid | simpson"),
    ("Simpson with an odd number of periods", changed(estimator('quadrature = ▸"simpson"\n'), "0.02", "0.021"), "even number of periods"),
    ("equations of different units pooled", MOTOR, "pooled with equations of other units"),
    ("equations of different units pooled, noise of one", changed(MOTOR, 'unit = "A"', 'unit = "A", noise = 0.1', "robust", "least_squares"), "noise = "),
    ("equations of different units pooled, scale of one", changed(MOTOR, "- b*w\"", "- b*w\"\nscale = 3"), "scale = "),
    ("equations of different units in more rows than unknowns", changed(MOTOR, "robust", "square", "- b*w\"", "- b*w\"\nrows = 3"), "pooled with equations of other units"),
    ("forgetting above 1", estimator("forgetting = ▸1.01\n"), "above 1"),
    ("forgetting everything", estimator("forgetting = ▸0\n"), "not positive"),
    ("whiten that is no boolean", noisy("whiten = ▸1\n"), "neither true nor false"),
    ("whitened S(t)", noisy('solve = "robust"\nwhiten = ▸true\n'), "whiten is for the rows of one instant"),
    ("whitened without noise", estimator("whiten = ▸true\n"), "needs the noise of the sensors"),
    ("whitened without initial values", changed(noisy("whiten = true\n"), "[estimator]", "rows = 4\n▸[estimator]"), "declare initial"),
    ("whitened rows without noise", changed(PLAIN, "x = {}", "x = { noise = 1 }", "a = {}", "a = { initial = 1 }", "b = {}", "b = { initial = 1 }",
                                            'ode = "der(x) = a*x + b*u"\n', 'ode = "der(x) = a*x + b*u"\nrows = 2\n[[equation]]\node = "der(y) = a*y + b*u"\nrows = 2\n'
                                            "▸[estimator]\nwhiten = true\n"), "have no noise"),
    ("a negative deviation limit", noisy("deviation_limit = ▸-0.1\n"), "is negative"),
    ("deviation limit without noise", estimator("deviation_limit = ▸0.1\n"), "needs the noise of the sensors"),
    ("deviation limit of all rows since reset", noisy('solve = "least_squares"\ndeviation_limit = ▸0.1\n'), "not to be had with least_squares"),
    ("uncertainty that is no boolean", noisy('uncertainty = ▸"yes"\n'), "neither true nor false"),
    ("a deviation limit without uncertainty", noisy("deviation_limit = 0.1\nuncertainty = ▸false\n"), "leaves out what whiten and deviation_limit need"),
    ("whitening without uncertainty", noisy("whiten = true\nuncertainty = ▸false\n"), "leaves out what whiten and deviation_limit need"),
    ("uncertainty without noise", estimator("uncertainty = ▸true\n"), "needs the noise of the sensors"),
    ("uncertainty of all rows since reset", noisy('solve = "least_squares"\nuncertainty = ▸true\n'), "not to be had with least_squares"),
    ("ratio filter that is a number", estimator("ratio_filter = ▸15\n"), "table"),
    ("ratio filter of a square solve", estimator("ratio_filter = ▸{ omega_n = 15 }\n"), 'needs solve = "robust"'),
    ("ratio filter without omega_n", estimator('solve = "robust"\nratio_filter = ▸{ zeta = 1 }\n'), "without omega_n"),
    ("ratio filter with a misspelt key", estimator('solve = "robust"\nratio_filter = { omega_n = 15, ▸zetta = 1 }\n'), "did you mean zeta?"),
    ("ratio filter, negative omega_n", estimator('solve = "robust"\nratio_filter = { omega_n = ▸-15 }\n'), "not positive"),
    ("ratio filter, zeta above 10", estimator('solve = "robust"\nratio_filter = { omega_n = 15, zeta = ▸11 }\n'), "above 10"),
    ("ratio filter faster than the samples", estimator('solve = "robust"\nratio_filter = ▸{ omega_n = 1001 }\n'), "faster than the samples"),
    ("decimation by half", coil("period = 0.001", "period = 0.001\ndecimate = ▸0.5"), "whole number from 1 to 10000"),
    ("decimation by nothing", coil("period = 0.001", "period = 0.001\ndecimate = ▸0"), "whole number from 1 to 10000"),
    ("window with a rest of a decimated period", coil("period = 0.001", "period = 0.001\ndecimate = 3", "0.02", "▸0.02"), "not a whole number of decimated periods"),
    ("solve_window with a rest of a decimated period", changed(estimator('solve = "robust"\nsolve_window = ▸0.012\n'), "period = 0.001", "period = 0.001\ndecimate = 5"), "not a whole number of decimated periods"),
    ("noise that enters no row", changed(estimator("deviation_limit = 0.1\n"), "[estimator]", "▸[estimator]", "- R*i", "- R*sgn(w)*i", 'v = {', 'w = { unit = "A", noise = 1 }\nv = {'), "enters no row"),
    ("noise that goes through the parabola filter into means", changed(noisy('uncertainty = true\n'), "window = 0.02", "window = 0.02\ndecimate = 2", "[estimator]", "▸[estimator]", "- R*i", "- R*sin(der(i)*tau)*i", "[constants]", '[constants]\ntau = { value = 1, unit = "s/A" }'), "through the parabola filter"),
    ("a perturbation that nothing annihilates", equation('perturbation = ▸"force"\n'), "kappa = 0 annihilates none"),
    ("a perturbation with a signal's name", equation('kappa = 1\nperturbation = ▸"i"\n'), "of something else"),
    ("a perturbation whose first coefficient is a signal", changed(equation('kappa = 2\nperturbation = ▸"f"\n'), "v = {", 'f1 = { unit = "V" }\nv = {'), "of something else"),
    ("a perturbation that is no name", equation('kappa = 1\nperturbation = ▸"a force"\n'), "is not a name"),
    ("a perturbation that is a keyword", equation('kappa = 1\nperturbation = ▸"double"\n'), "C++"),
    ("condition limit of zero", estimator("condition_limit = ▸0\n"), "not positive"),
    ("solve_window with a rest", estimator("solve_window = ▸0.0015\n"), "not a whole number of periods"),
    ("solve_window of a million and one periods", estimator("solve_window = ▸1000.001\n"), "more than 1000000"),
    ("negative solve_window", estimator("solve_window = ▸-1\n"), "not positive"),
]

NAMES = [
    ("C++ keyword", declared("▸double"), "C++ keyword"),
    ("C++ keyword that a formula uses", coil("i = {", "▸class = {").replace("der(i)", "der(class)").replace("R*i", "R*class"), "C++ keyword"),
    ("newer C++ keyword", declared("▸co_await"), "C++ keyword"),
    ("alternative spelling of C++", declared("▸xor"), "C++ keyword"),
    ("two underscores", declared("▸k__p"), "reserved"),
    ("underscore at the end", declared("▸k_"), "reserved"),
    ("underscore at the front", declared("▸_k"), "does not start with a letter"),
    ("digit at the front", declared("▸2x"), "does not start with a letter"),
    ("member of the generated class", declared("▸status"), "taken by generated code"),
    ("macro of the standard library", declared("▸NULL"), "taken by generated code"),
    ("macro of cmath", declared("▸M_PI"), "taken by generated code"),
    ("function", declared("▸sin"), "is a function"),
    ("derivative", declared("▸der"), "is a function"),
    ("case alone", declared("▸r"), "'r' and 'R' differ by case alone"),
    ("case alone in two sections", declared("▸GAIN"), "differ by case alone"),
    ("a signal and a parameter", declared("▸v"), "declared twice"),
    ("hyphen", declared("▸k-p"), "not a name"),
    ("blank", declared('▸"k p"'), "not a name"),
    ("empty", declared('▸""'), "empty name"),
    ("not ASCII", declared('▸"ω"'), "'ω' is not a name"),
    ("behind what is not ASCII", coil('v = { unit = "V" }', 'v = { column = "größe→𝄞", ▸unti = "V", unit = "V" }'), "unknown key 'unti'"),
    ("61 characters", declared("▸" + "k" * 61), "61 characters"),
    ("300 000 characters", declared("▸" + "k" * 300_000), "300000 characters"),
    ("template marks", declared('▸"{{k}}"'), "not a name"),
    ("line break", declared('▸"k\\nm"'), "'k?m' is not a name"),
    ("model name with a capital", coil('"m"', '▸"Motor"'), "not a model name"),
    ("model name with a blank", coil('"m"', '▸"dc motor"'), "not a model name"),
    ("model name that leaves the folder", coil('"m"', '▸"../m"'), "not a model name"),
    ("model name with a slash", coil('"m"', '▸"m/n"'), "not a model name"),
    ("model name with a line break", coil('"m"', '▸"m\\n"'), "'m?' is not a model name"),
    ("model name that is empty", coil('"m"', '▸""'), "not a model name"),
    ("model name that is a keyword", coil('"m"', '▸"double"'), "C++ keyword"),
    ("model name that hides a class of the runtime", coil('"m"', '▸"status"'), "taken by generated code"),
    ("model name of 61 characters", coil('"m"', '▸"' + "m" * 61 + '"'), "not a model name"),
    ("summary with template marks", 'summary = ▸"{{name}}"\n' + COIL, "'{{'"),
    ("summary that closes a comment", 'summary = ▸"a */ b"\n' + COIL, "'*/'"),
    ("summary that opens a comment", 'summary = ▸"a /* b"\n' + COIL, "'/*'"),
    ("summary of two lines", 'summary = ▸"""\na\nb"""\n' + COIL, "line break"),
    ("summary with an escape", 'summary = ▸"a\\u0007b"\n' + COIL, "control character"),
    ("summary with a backslash at the end", "summary = ▸'what follows is a comment \\'\n" + COIL, "backslash"),
    ("summary with a trigraph", "summary = ▸'what??/'\n" + COIL, "'??/'"),
    ("summary of 301 characters", 'summary = ▸"' + "s" * 301 + '"\n' + COIL, "301 bytes"),
    ("source with template marks", 'source = ▸"x }} y"\n' + COIL, "'}}'"),
    ("equation named with template marks", COIL + 'name = ▸"{{#rows}}"\n', "'{{'"),
    ("equation named with a line break", COIL + 'name = ▸"a\\r\\nb"\n', "line break"),
    ("unit of newton metres without a point", coil('"ohm"', '▸"Nm"'), "write N.m"),
    ("unit of damping without a point", coil('"ohm"', '▸"Ns/m"'), "write N.s/m"),
    ("unit of inertia without a point", coil('"ohm"', '▸"kgm2"'), "write kg.m^2"),
    ("ohm in Greek letters and words", coil('"ohm"', '▸"Ω pro Meter"'), "UDUNITS does not know"),
    ("no unit at all", coil('"ohm"', '▸"parsnip"'), "UDUNITS does not know the unit 'parsnip'"),
    ("unit with a line break", coil('"ohm"', '▸"ohm\\n"'), "UDUNITS does not know"),
    ("unit of a thousand parentheses", coil('"ohm"', '▸"' + "(" * 1000 + "m" + ")" * 1000 + '"'), "UDUNITS does not know"),
    ("unit with a power of 300", coil('"ohm"', '▸"m^300"'), "UDUNITS does not know"),
]

FORMULAS = [
    ("unknown name", ode("der(x) = a*x + b*▸z"), "unknown name 'z'"),
    ("misspelt name", coil_ode("L*der(i) = ▸gian*v - R*i"), "did you mean gain?"),
    ("name as near to one as to another", changed(PLAIN, "a = {}", "i_d = {}\ni_q = {}", "a*x + b*u", "i_d*x + i_q*y + ▸i_x*b*u"), "'i_x'; declare it"),
    ("name of one letter", ode("der(x) = a*x + b*▸w"), "'w'; declare it"),
    ("misspelt function", ode("der(x) = a*x + b*▸sine(u)"), "did you mean sin?"),
    ("function of another language", ode("der(x) = a*x + b*▸integral(u)"), "is not a function; functions are der"),
    ("unknown name that differs by case", ode("der(x) = ▸A*x + b*u"), "did you mean a?"),
    ("unknown names on both sides", ode("der(▸z) = a*x + b*▸w"), "unknown name 'w'"),
    ("function without parentheses", ode("der(x) = a*x + b*▸sin"), "unknown name 'sin'"),
    ("unknown function", ode("der(x) = a*x + b*▸sinh(u)"), "'sinh' is not a function"),
    ("product without a sign", ode("der(x) = ▸a(x) + b*u"), "'a' is not a function; functions are der"),
    ("name right after a number", ode("der(x) = 2▸a*x + b*u"), "write * between them"),
    ("name right after an exponent", ode("der(x) = 2e5▸a*x + b*u"), "write * between them"),
    ("parenthesis right after a number", ode("der(x) = 2▸(a*x + b*u)"), "an operator is missing before '('"),
    ("two names", ode("der(x) = a ▸x + b*u"), "an operator is missing before 'x'"),
    ("two parentheses", ode("der(x) = (a)▸(x) + b*u"), "an operator is missing before '('"),
    ("two points in a number", ode("der(x) = 1.5▸.2*a*x + b*u"), "unexpected '.'"),
    ("a point", ode("der(x) = a*x + b*u + ▸."), "not a number"),
    ("fraction of 402 digits", ode("der(x) = a*x + b*u + ▸1.5e-400"), "at most 400 digits"),
    ("number of 401 digits", ode("der(x) = a*x + b*u + ▸0." + "1" * 401), "at most 400 digits"),
    ("number with a huge exponent", ode("der(x) = a*x + b*u + ▸1e401"), "within +-400"),
    ("closed too often", ode("der(x) = (a*x + b*u)▸)"), "')' without '('"),
    ("closed too often in the middle", ode("der(x)▸) = a*x + b*u"), "')' without '('"),
    ("never closed", ode("der(x) = a*x + b*▸(u + (1 + 2)"), "'(' is never closed"),
    ("call never closed", ode("der(x) = a*x + b*▸sin(u"), "'(' of sin is never closed"),
    ("square bracket", ode("der(x) = a*x + b*(u▸])"), "unexpected ']'"),
    ("operand missing at the end", ode("der(x) = a*x + b*▸"), "ends too early"),
    ("operand missing before a parenthesis", ode("der(x) = a*x + (b + ▸)*u"), "an operand is missing before ')'"),
    ("nothing in parentheses", ode("der(x) = a*x + (▸)*u"), "an operand is missing before ')'"),
    ("operand missing before an operator", ode("der(x) = a*x + ▸*b*u"), "an operand is missing before '*'"),
    ("nothing on the left", ode("▸= a*x + b*u"), "an operand is missing before '='"),
    ("nothing on the right", ode("der(x) = ▸"), "ends too early"),
    ("empty", ode("▸"), "ends too early"),
    ("blanks alone", ode("   ▸"), "ends too early"),
    ("empty, three quotes", written('"""▸"""'), "ends too early"),
    ("empty, three apostrophes", written("'''▸'''"), "ends too early"),
    ("no equals sign", ode("der(x) - a*x + b*u▸"), "without '='"),
    ("two equals signs", ode("der(x) = a*x ▸= b*u"), "a second '='"),
    ("comparison", ode("der(x) =▸= a*x + b*u"), "a second '='"),
    ("power as in Python", ode("der(x) = a*x▸**2 + b*u"), "write ^ for a power"),
    ("factorial", ode("der(x) = a*x▸! + b*u"), "unexpected '!'"),
    ("a comment", ode("der(x) = a*x + b*u ▸# motor"), "unexpected '#'"),
    ("minus sign of a word processor", ode("der(x) = a*x ▸− b*u"), "no formula has"),
    ("middle dot", ode("der(x) = a▸·x + b*u"), "no formula has"),
    ("control character", ode("der(x) = a*x + ▸\\u0007b*u"), "no formula has"),
    ("NUL", ode("der(x) = a*x + ▸\\u0000b*u"), "no formula has"),
    ("no-break space", ode("der(x) =▸\u00a0a*x + b*u"), "no formula has"),
    ("sin of two", ode("der(x) = a*▸sin(x, u) + b*u"), "sin takes one argument"),
    ("sin of nothing", ode("der(x) = a*▸sin() + b*u"), "sin takes one argument"),
    ("min of one", ode("der(x) = a*▸min(x) + b*u"), "min takes two arguments"),
    ("max of five", ode("der(x) = a*▸max(x, u, y, 1, 2) + b*u"), "max takes two arguments"),
    ("der of nothing", ode("▸der() = a*x + b*u"), "der takes a signal"),
    ("der of three", ode("▸der(x, 1, 2) = a*x + b*u"), "der takes a signal"),
    ("der of a product", ode("der(▸x*y) = a*x + b*u"), "der() of something that is not a signal"),
    ("der of a parameter", ode("der(▸a) = a*x + b*u"), "der() of something that is not a signal"),
    ("der of a number", ode("der(▸1) = a*x + b*u"), "der() of something that is not a signal"),
    ("der of der", ode("der(▸der(x)) = a*x + b*u"), "der() of something that is not a signal"),
    ("der of order 0", ode("der(x, ▸0) = a*x + b*u"), "whole number from 1 to 12"),
    ("der of order 1.5", ode("der(x, ▸1.5) = a*x + b*u"), "whole number from 1 to 12"),
    ("der of order 99", ode("der(x, ▸99) = a*x + b*u"), "whole number from 1 to 12"),
    ("der of order -1", ode("der(x, ▸-1) = a*x + b*u"), "whole number from 1 to 12"),
    ("der of a constant's order", ode("der(x, ▸c) = a*x + b*u"), "whole number from 1 to 12"),
    ("huge exponent", ode("der(x) = a*x + b*2^▸99999999*u"), "the exponent is beyond 32"),
    ("exponent of 33", ode("der(x) = a*x^▸33 + b*u"), "the exponent is beyond 32"),
    ("exponent of -33", ode("der(x) = a*x^▸-33 + b*u"), "the exponent is beyond 32"),
    ("exponent that adds up to 33", ode("der(x) = a*x^▸(16 + 17) + b*u"), "the exponent is beyond 32"),
    ("tower of powers", ode("der(x) = a*x + b*2^▸9^9*u"), "the exponent is beyond 32"),
    ("powers of powers", ode("der(x) = a*((((x^32)^32)^32)^▸32)^32 + b*u"), "powers of powers beyond 32"),
    ("powers of powers of a number", ode("der(x) = a*x + b*((((((((2^32)^32)^32)^32)^32)^32)^32)^▸32)^32*u"), "powers of powers beyond 32"),
    ("a number that grows", ode("der(x) = a*x + b*(▸" + "*".join(["1e30"] * 4) + "*u)"), "beyond 1e100"),
    ("a number that shrinks", ode("der(x) = a*x + b*(▸1e-60/1e60*u)"), "closer to 0 than 1e-100"),
    ("a huge number", ode("der(x) = a*x + b*▸1e101*u"), "beyond 1e100"),
    ("a fraction that grows", ode("der(x) = a*x + b*u*(▸" + " + ".join(f"1/{k}" for k in range(10 ** 18 + 1, 10 ** 18 + 300, 2)) + ")"), "thousands of digits"),
    ("division by zero", ode("der(x) = a*x + b*u/▸0"), "division by zero"),
    ("division by a difference of numbers", ode("der(x) = a*x + b*u/▸(c - 2)"), "division by zero"),
    ("zero to the power of zero", ode("der(x) = a*x + b*u*▸0^0"), "0 to a power"),
    ("zero below", ode("der(x) = a*x + b*u*▸0^-1"), "0 to a power"),
    ("root of a negative number", ode("der(x) = a*x + b*u*▸sqrt(1 - c)"), "not a real number"),
    ("logarithm of zero", ode("der(x) = a*x + b*u*▸log(c - 2)"), "not a real number"),
    ("negative number to a fraction", ode("der(x) = a*x + b*u*▸(-8)^(1/3)"), "not whole"),
    ("exponential beyond all numbers", ode("der(x) = a*x + b*u*▸exp(2000)"), "not a real number"),
    ("a thousand minus signs", ode("der(x) = " + "-" * 101 + "▸" + "-" * 899 + "a*x + b*u"), "nested deeper than 100"),
    ("a thousand parentheses", ode("der(x) = " + "(" * 101 + "▸" + "(" * 899 + "a" + ")" * 1000 + "*x + b*u"), "nested deeper than 100"),
    ("a million parentheses", ode("▸" + "(" * 1_000_000), "1000000 characters"),
    ("a million parentheses, closed", ode("▸der(x) = " + "(" * 500_000 + "a*x" + ")" * 500_000 + " + b*u"), "more than 20000"),
    ("two thousand terms", ode("x" + "+x" * 1999 + "▸+x" + "+x" * 3000 + " = 0"), "more than 4000 operations"),
    ("ten thousand terms", ode("▸der(x) = a*x" + "+b*u" * 10_000), "more than 20000"),
    ("a name of 61 characters", ode("der(x) = ▸" + "a" * 61 + "*x + b*u"), "61 characters"),
    ("a power that would explode", ode("der(x) = ▸-(x + y + u + a + b + c)^20"), "more than 2000 terms"),
    ("a law with an equals sign", feedback('signal = "v"\nlaw = "v ▸= gain*i"\n'), "'=' in an expression"),
    ("a law that is cut off", feedback('signal = "v"\nlaw = "gain*(i - ▸"\n'), "ends too early"),
    ("a law with an unknown name", feedback('signal = "v"\nlaw = "gain*(▸r - i)"\n'), "unknown name 'r'"),
    ("a law that divides by zero", feedback('signal = "v"\nlaw = "i/▸0"\n'), "division by zero"),
    ("a law that is a number", feedback('signal = "v"\nlaw = ▸1\n'), "not a text"),
    ("a law for nothing", feedback('signal = ▸"r"\nlaw = "i"\n'), "'r' is not a signal"),
    ("two laws for one signal", feedback('signal = "v"\nlaw = "i"\n[[feedback]]\nsignal = ▸"v"\nlaw = "2*i"\n'), "a second law"),
]

# Where a complaint stands in a formula, for every way to write a text in TOML.
PLACES = [
    ("literal", written("'der(x) = a*x + b*▸z'"), "'z'"),
    ("several lines", written('"""\nder(x) =\n   a*x\n + b*▸z"""'), "'z'"),
    ("several lines that begin at once", written('"""der(x) =\n   a*x\n + b*▸z"""'), "'z'"),
    ("several literal lines", written("'''\nder(x) =\n\ta*x\n + b*▸z'''"), "'z'"),
    ("several lines, CRLF", crlf(written('"""\nder(x) =\n   a*x\n + b*▸z\n"""')), "'z'"),
    ("several literal lines, CRLF", crlf(written("'''\nder(x) =\n   a*x\n + b*▸z\n'''")), "'z'"),
    ("lines joined by a backslash", written('"""\\\n  der(x) = \\\n\n     a*x \\   \n + b*▸z"""'), "'z'"),
    ("lines joined by a backslash, CRLF", crlf(written('"""\\\n  der(x) = \\\n\n     a*x \\   \n + b*▸z"""')), "'z'"),
    ("escape before it", written('"der(x) =\\ta*x\\n + b*▸z"'), "'z'"),
    ("letter as an escape before it", written('"der(x) = \\u0061*x + \\U00000062*▸z"'), "'z'"),
    ("escape itself", written('"der(x) = a*x + b*▸\\u007A"'), "'z'"),
    ("character of two bytes as an escape", written('"der(x) = a*x + ▸\\u00e9*z"'), "no formula has"),
    ("character of four bytes as an escape", written('"der(x) = a*x + ▸\\U0001D11E*z"'), "no formula has"),
    ("quotes inside three quotes", written('"""der(x) = a*x + ▸"b"*z"""'), "unexpected '\"'"),
    ("three quotes that end in five", written('"""der(x) = a*x + b*u▸"""""'), "unexpected '\"'"),
    ("backslash in a literal", written("'der(x) = a*x + ▸\\b*z'"), "unexpected '\\'"),
    ("UTF-8 before it on the line", changed(PLAIN.split("[[equation]]")[0], "[sampling]", 'equation = [ { name = "größe→𝄞", ode = "der(x) = a*x + b*▸z" } ]\n[sampling]'), "'z'"),
    ("UTF-8 on the line above", ode("der(x) = a*x + b*▸z").replace("ode =", 'name = "größe→𝄞" # ü\node ='), "'z'"),
    ("tabs before it", ode("der(x) = a*x + b*▸z").replace("ode =", "\t\tode\t="), "'z'"),
    ("CRLF", crlf(ode("der(x) = a*x + b*▸z")), "'z'"),
    ("byte-order mark", "\ufeff" + ode("der(x) = a*x + b*▸z"), "'z'"),
    ("byte-order mark and CRLF", "\ufeff" + crlf(ode("der(x) = a*x + b*▸z")), "'z'"),
    ("byte-order mark before a fault in line 1", "\ufeff" + coil('"m"', '▸"M"'), "not a model name"),
    ("byte-order mark before a fault of the syntax in line 1", "\ufeff" + coil('name = "m"', 'name ▸"m"'), "expected '='"),
    ("last line without end", ode("der(x) = a*x + b*▸z").rstrip("\n"), "'z'"),
]

MATHEMATICS = [
    ("second derivative inside a nonlinearity", ode("der(x) = a*x + b*sgn(▸der(y, 2))"), "order above 1"),
    ("second derivative times a signal", ode("der(x) = a*x + b*u*▸der(y, 2)"), "order above 1"),
    ("products that outnumber the parameters", changed(PLAIN, '"der(x) = a*x + b*u"', '▸"der(x) = a*x + b*u + a*b*y"'), "because of the term"),
    ("a square that cannot be undone", changed(PLAIN, '"der(x) = a*x + b*u"', '▸"der(x) = a^2*x + b*u"'), "cannot be solved for a"),
    ("a square behind denominators", changed(PLAIN, "a = {}\nb = {}", "a = {}\nb = {}\nq = {}\nd = {}\ne = {}", '"der(x) = a*x + b*u"',
        '▸"b*e*der(x) = 6*d*u"\n[[equation]]\node = "b*der(y) = q^2*d/e*u + (2*d + q)*x"\n[[equation]]\node = "a*der(u) = (9 - e)*x + 2/5/b*y"'), "cannot be solved for a, b, q, d, e"),
    ("division by what cancels", ode("der(x) = a*x + b*u + y/▸(a - a)"), "division by zero"),
    ("division by signals that cancel", ode("der(x) = a*x + b*u/▸(y + u - u - y)"), "division by zero"),
    ("division by what cancels once it is multiplied out", ode("der(x) = a*x + b*u + y*▸((a + b)^2 - a^2 - 2*a*b - b^2)^-1"), "division by zero"),
    ("many denominators", changed(PLAIN, "b = {}", "b = {}\n" + "".join(f"p{k} = {{}}\n" for k in range(13)),
                                  "der(x) = a*x + b*u", "der(x) = ▸a*x + " + " + ".join(f"u^{k + 1}/(p{k} + p{k + 1})" for k in range(12))), "more than 2000 terms"),
    ("parameters that cannot be solved for in bounded space", changed(PLAIN, "b = {}", "b = {}\n" + "".join(f"p{k} = {{}}\n" for k in range(7)),
        '"der(x) = a*x + b*u"', '▸"p0*der(x) = u + ' + " + ".join(f"(p{k - 1} + p{k}^3)*sin({k}*u)" for k in range(1, 7)) + '"', "a = {}", "", "b = {}", ""), "cannot be solved"),
    ("volts and volts squared", coil_ode("L*der(i) = v*v - ▸R*i"), "differ in dimension"),
    ("sides that differ", coil_ode("L*der(i) = ▸(gain*v - R*i)/R"), "differ in dimension"),
    ("number beside volts", coil_ode("L*der(i) = gain*v - ▸1 - R*i"), "differ in dimension"),
    ("derivative forgotten", coil_ode("L*i = ▸gain*v - R*i"), "differ in dimension"),
    ("milliamperes", coil('i = { unit = "A" }', 'i = { unit = "mA" }', "gain*v - R*i", "▸gain*v - ▸R*i"), "differ in scale"),
    ("exponential of amperes", coil_ode("L*der(i) = gain*v - R*i + v*exp(▸i)"), "the argument of exp has the unit [A]"),
    ("sine of degrees", coil('i = { unit = "A" }', 'i = { unit = "degree" }', "gain*v - R*i", "gain*v*sin(▸i) - ▸R*i", '"ohm"', '"V/degree"', '"H"', '"V.s/degree"').replace("- ▸R", "- R"), "the argument of sin"),
    ("smaller of volts and amperes", coil_ode("L*der(i) = ▸min(v, i) - R*i"), "differ in dimension"),
    ("volts to the power of a signal", coil_ode("L*der(i) = gain*v - R*i + ▸v^▸i"), "an exponent has the unit"),
    ("degrees Celsius and kelvins", HEAT.replace("T - ", "T - ▸"), "differ in their zero"),
    ("a long sum", coil_ode("L*der(i) = " + "gain*v + " * 300 + "▸i - R*i"), "differ in dimension"),
    ("unit of another parameter", coil('"H"', '"F"', "gain*v", "▸gain*v"), "differ in dimension"),
]

DELAYS = [
    ("delay without a time", ode("der(x) = a*x + b*▸delay(u)"), "takes a signal and a time"),
    ("delay of three", ode("der(x) = a*x + b*▸delay(u, 1, 2)"), "takes a signal and a time"),
    ("delay of a product", ode("der(x) = a*x + b*delay(▸u*y, 1)"), "not a signal"),
    ("delay of a constant", ode("der(x) = a*x + b*u + delay(▸c, 1)"), "not a signal"),
    ("delay of a derivative", ode("der(x) = a*x + b*delay(▸der(y), 1)"), "not a signal"),
    ("delay of what is not declared", ode("der(x) = a*x + b*delay(▸z, 1)"), "unknown name 'z'"),
    ("derivative of a delay", ode("der(x) = a*x + b*der(▸delay(u, 1))"), "not a signal"),
    ("the future", ode("der(x) = a*x + b*delay(u, ▸c - 3)"), "less than nothing"),
    ("delay by a signal", ode("der(x) = a*x + b*delay(u, ▸y)"), "neither known nor a parameter"),
    ("delay by twice a parameter", ode("der(x) = a*x + b*delay(u, ▸2*a)"), "neither known nor a parameter"),
    ("delay by nothing by nothing", ode("der(x) = a*x + b*delay(u, 1/▸0)"), "division by zero"),
    ("delay that may become negative", ode("der(x) = a*x + b*delay(u, ▸b)"), "give the parameter min = 0"),
    ("delay with a negative bound", changed(PLAIN, "a*x + b*u", "a*x + delay(u, ▸b)", "b = {}", "b = { min = -1 }"), "give the parameter min = 0"),
    ("delay by a pure number", coil_ode("L*der(i) = delay(v, ▸gain) - R*i"), "the time of a delay has the unit [1]"),
    ("delay in milliseconds", coil("gain*v", "delay(v, ▸gain)", 'value = 2, unit = "1"', 'value = 2, unit = "ms"'), "declare it in s"),
    ("delay of eleven thousand samples", ode("der(x) = a*x + b*▸delay(u, 11)"), "more than 10000 sampling periods"),
    ("sum of a delayed voltage and a current", coil_ode("L*der(i) = delay(v, 2) - ▸i - R*i"), "differ in dimension"),
    ("signal named delay", coil("v = {", "▸delay = {", "gain*v - R*i", "gain - ▸R*i"), "'delay' is a function"),
]

TRANSFERS = [
    ("m above n", transfer("n = 2", "n = 2\nm = ▸3"), "m = 3 is larger than n = 2"),
    ("m above n in the second input", inputs('"w"', '"w"\nm = ▸2'), "m = 2 is larger than n = 1"),
    ("order 0", transfer("n = 2", "n = ▸0"), "whole number from 1 to 12"),
    ("order 13", transfer("n = 2", "n = ▸13"), "whole number from 1 to 12"),
    ("order as text", transfer("n = 2", 'n = ▸"2"\nm = 1'), "whole number from 1 to 12"),
    ("coefficient forgotten", transfer("[transfer]", "▸[transfer]", '"a1", ', ""), "coefficient a1 is neither unknown nor known"),
    ("two coefficients forgotten", transfer("[transfer]", "▸▸[transfer]", '"a0", "a1", ', ""), "coefficient a0 is neither unknown nor known"),
    ("coefficient of an input forgotten", transfer("n = 2", "n = 2\nm = ▸1"), "coefficient b1 is neither unknown nor known"),
    ("coefficient twice", transfer('"b0"', '"b0", ▸"a0"'), "'a0' is named twice"),
    ("unknown and known", transfer("n = 2", "n = 2\nknown = { ▸a1 = 0 }"), "'a1' is named twice"),
    ("coefficient of a higher order than n", transfer('"b0"', '"b0", ▸"a3"'), "order 3, above n = 2"),
    ("coefficient of a higher order than m", transfer('"b0"', '"b0", ▸"b1"'), "order 1, above m = 0"),
    ("coefficient without an order", transfer('"b0"', '"b0", ▸"gain"'), "does not end in the order"),
    ("coefficient of order 100", transfer('"b0"', '"b0", ▸"b100"'), "does not end in the order"),
    ("coefficient that is no name", transfer('"b0"', '"b0", ▸"b-1"'), "not a name"),
    ("coefficient named like a signal", transfer('"b0"', '▸"u0"', "u = {", "u0 = {", "n = 2", 'n = 2\ninput = "u0"'), "as well"),
    ("coefficient that differs by case from another", transfer('"b0"', '"b0", ▸"A0"'), "differs by case"),
    ("highest coefficient is zero", transfer("n = 2", "n = 2\nknown = { ▸a2 = 0 }"), "the highest derivative is 0"),
    ("unknowns as text", transfer('["a0", "a1", "b0"]', '▸"a0"'), "'unknowns' is not a list"),
    ("unknown that is a number", transfer('"b0"', "▸0"), "not a text"),
    ("known as a list", transfer("n = 2", "n = 2\nknown = ▸[1]"), "'known' is not a table"),
    ("known that is no number", transfer("n = 2", 'n = 2\nknown = { a2 = ▸"one" }'), "not a number"),
    ("output that is not a signal", transfer("n = 2", 'n = 2\noutput = ▸"z"'), "'z' is not a signal"),
    ("input that is not a signal", transfer("n = 2", 'n = 2\ninput = ▸"z"'), "'z' is not a signal"),
    ("no signal y", changed(TRANSFER, "y = {", "q = {", "[transfer]", "▸[transfer]"), "'y' is not a signal"),
    ("second input that is not a signal", inputs('signal = "w"', 'signal = ▸"z"'), "'z' is not a signal"),
    ("output as input", transfer("n = 2", 'n = 2\ninput = ▸"y"'), "'y' stands twice"),
    ("misspelt input", transfer("u = {", "force = {", "n = 2", 'n = 2\ninput = ▸"froce"'), "did you mean force?"),
    ("an input twice", inputs('signal = "w"', 'signal = ▸"u"'), "'u' stands twice"),
    ("input that is a number", transfer("n = 2", "n = 2\ninput = ▸3"), "not a text"),
    ("no input", transfer("n = 2", "n = 2\ninput = ▸[]"), "no input"),
    ("inputs that are texts", transfer("n = 2", 'n = 2\ninput = [▸"u", ▸"w"]'), "not a table"),
    ("m beside several inputs", inputs("n = 1", "n = 1\nm = ▸1"), "give each input its own m"),
    ("coefficient beside several inputs", inputs('["a0"]', '["a0", ▸"d0"]'), "list it with its input"),
    ("one coefficient in two inputs", inputs('"c0"', '▸"b0"'), "'b0' is named twice"),
    ("coefficient of the second input forgotten", inputs('[[transfer.input]]\nsignal = "w"\nunknowns = ["c0"]', '▸[[transfer.input]]\nsignal = "w"'), "its b0 is neither unknown nor known"),
]

# `check` has nothing against these: without a window a model can still be simulated.
ESTIMATOR_ALONE = [
    ("no sampling", "▸▸" + coil("[sampling]\nperiod = 0.001\nwindow = 0.02\n", ""), "no sampling period"),
    ("no period", coil("[sampling]\nperiod = 0.001\n", "▸[sampling]\n"), "no sampling period"),
    ("no window", coil("[sampling]", "▸[sampling]", "window = 0.02\n", ""), "no window"),
    ("nothing to estimate", "▸" + coil("[parameters]", ""  # the two are constants now
                                       ).replace('R = { unit = "ohm" }', 'R = { value = 1, unit = "ohm" }').replace('L = { unit = "H" }', 'L = { value = 1, unit = "H" }'), "nothing to estimate"),
    ("parameter in sin", ode("der(x) = sin(▸a*x) + b*u"), "'a' stands inside sin()"),
    ("parameter in a power of e", ode("der(x) = a*x + exp(2*(1 + ▸b))*u"), "'b' stands inside exp()"),
    ("parameter in an exponent", ode("der(x) = x^▸a + b*u"), "'a' stands in an exponent"),
    ("parameter under a root", ode("der(x) = sqrt(u*▸a) + b*u"), "'a' stands inside sqrt()"),
    ("parameter under a broken power", ode("der(x) = (▸a*x)^0.5 + b*u"), "power that is not a whole number"),
    ("parameter beside a signal in a denominator", ode("der(x) = u/(▸a + x) + b*u"), "beside a signal in a denominator"),
    ("parameter in a comparison", ode("der(x) = max(x, ▸a) + b*u"), "'a' stands inside max()"),
]

CASES = {"TOML": TOML, "keys": KEYS, "values": VALUES, "names": NAMES, "formulas": FORMULAS, "places": PLACES,
         "mathematics": MATHEMATICS, "delays": DELAYS, "transfer": TRANSFERS}

COMMANDS = [("check", "m.toml"), ("derive", "m.toml"), ("generate", "m.toml", "-o", "out")]


class Malformed(ModelCase):
    def refused(self, text, words, commands, name="m.toml"):
        content, places = without_marks(text)
        self.assertTrue(places, "no mark in the text")
        self.write(content, name)
        for command in commands:
            with self.subTest(command=command[0]):
                code, out, err, seconds = self.run_algest(*command)
                self.assertEqual(code, 2, out + err)
                found = complaints(err, name=name)
                self.assertEqual([place[:2] for place in found], places, err[:2000])
                self.assertTrue(any(words in place[2] for place in found), f"{words!r} is not said:\n{err[:2000]}")
                for _, _, complaint in found:
                    self.assertLess(len(complaint), 400)
                self.assertEqual(out, "")
                self.assertTrue(all(character.isprintable() or character == "\n" for character in err), ascii(err))
                self.assertLess(seconds, 1.0)
                self.assertEqual(self.entries(), [name])

    def test_what_they_are_made_from_is_sound(self):
        motor = MOTOR.replace(MARK, "")
        for text in (COIL, PLAIN, TRANSFER, SEVERAL_INPUTS, HEAT.replace('"K"', '"degC"'), HEAT.replace('"degC"', '"K"'), changed(motor, "robust", "square"),
                     changed(motor, "- K*w\"", "- K*w\"\nscale = 3", "- b*w\"", "- b*w\"\nscale = 0.1"),
                     changed(motor, 'unit = "A"', 'unit = "A", noise = 0.1', 'unit = "rad/s"', 'unit = "rad/s", noise = 0.1')):
            self.write(text.encode())
            self.assertEqual(self.run_algest("check", "m.toml")[:2], (0, "m.toml: ok\n"))
            self.assertEqual(self.run_algest("derive", "m.toml")[0], 0)

    def test_there_are_enough_and_each_is_another(self):
        texts = [text for cases in CASES.values() for _, text, _ in cases]
        self.assertGreaterEqual(len(texts), 120)
        self.assertEqual(len(texts), len(set(texts)))

    def test_what_an_estimator_needs_and_a_model_may_lack(self):
        for name, text, words in ESTIMATOR_ALONE:
            with self.subTest(name):
                self.refused(text, words, COMMANDS[1:])
                self.assertEqual(self.run_algest("check", "m.toml")[0], 0)

    def test_several_complaints_come_in_one_run_in_the_order_of_the_file(self):
        self.refused(COIL.replace('name = "m"', 'name = ▸"M"\n▸colour = "red"')
                     .replace("0.001", '▸"1 ms"').replace('unit = "V"', 'unit = ▸"Volt-ish", ▸nois = 1')
                     .replace("R = {", "▸double = {}\nR = {").replace("gain*v - R*i", "gain*▸z - ▸q*i")
                     + "kappa = ▸-1\n[estimator]\nsolve = ▸\"magic\"\nform = ▸0\n", "unknown name 'q'", COMMANDS)

    def test_complaints_end_after_a_hundred(self):
        self.write(('name = "m"\n' + "".join(f"k{k} = 1\n" for k in range(50_000))).encode())
        code, _, err, seconds = self.run_algest("check", "m.toml")
        self.assertEqual(code, 2)
        self.assertEqual(err.count(": error: "), 100)
        self.assertIn("the rest is left out", err)
        self.assertLess(seconds, 1.0)

    def test_strict_makes_an_error_of_a_missing_unit(self):
        text = coil('R = { unit = "ohm" }', "▸R = {}", 'i = { unit = "A" }', "▸i = {}")
        self.refused(text, "'R' has no unit", [("check", "m.toml", "--strict")])
        code, _, err, _ = self.run_algest("check", "m.toml")
        self.assertEqual(code, 0)
        self.assertEqual([place[:2] for place in complaints(err, "warning")], without_marks(text)[1])

    def test_hertz_gets_a_warning(self):
        content, places = without_marks(coil('i = { unit = "A" }', 'i = { unit = ▸"Hz" }', '"ohm"', '▸"V/Hz"', '"H"', '"V.s/Hz"').replace('"V.s/Hz"', '▸"V.s/Hz"'))
        self.write(content)
        for command in COMMANDS:
            code, _, err, _ = self.run_algest(*command)
            self.assertEqual(code, 0, err)
            found = complaints(err, "warning")
            self.assertEqual([place[:2] for place in found], places)
            self.assertIn("rad/s", found[0][2])

    def test_a_law_of_another_unit_than_its_signal_gets_a_warning(self):
        for law, words in (("▸i", "'v' [V] and 'i' [A] differ in dimension"), ("R*i + ▸i", "'R*i' [V] and 'i' [A] differ"), ("R*i*exp(▸v)", "the argument of exp has the unit [V]"), ("R*i", None), ("gain*R*i - v", None)):
            content, places = without_marks(feedback(f'signal = "v"\nlaw = "{law}"\n'))
            self.write(content)
            code, _, err, _ = self.run_algest("check", "m.toml")
            with self.subTest(law):
                self.assertEqual(code, 0, err)
                found = complaints(err, "warning")
                self.assertEqual(len(found), 0 if words is None else 1, err)
                if words:
                    self.assertEqual([place[:2] for place in found], places)
                    self.assertIn(words, found[0][2])

    def test_json_has_the_same_places(self):
        content, places = without_marks(coil('name = "m"', 'name = ▸"M"', "gain*v", "gain*▸z"))
        self.write(content)
        for command in (*COMMANDS[:2], ("generate", "m.toml", "-o", "out")):
            code, out, _, _ = self.run_algest(*command, "--json")
            self.assertEqual(code, 2)
            errors = json.loads(out)["error"]
            self.assertEqual([(error["line"], error["column"]) for error in errors], places)
            self.assertEqual([error["severity"] for error in errors], ["error", "error"])
            self.assertEqual(self.entries(), ["m.toml"])

    def test_what_is_no_readable_file(self):
        def refused(name, words):
            for command, *rest in COMMANDS:
                code, out, err, seconds = self.run_algest(command, name, *rest[1:])
                self.assertEqual((code, out), (2, ""), err)
                self.assertEqual([place[:2] for place in complaints(err, name=name)], [(0, 0)], err)
                self.assertIn(words, err)
                self.assertLess(seconds, 1.0)
                self.assertFalse((self.folder / "out").exists())
        (self.folder / "folder.toml").mkdir()
        refused("folder.toml", "is a directory")
        refused("nothing.toml", "no such file")
        with open(self.folder / "large.toml", "wb") as file:
            file.truncate(100_000_000)
        refused("large.toml", "larger than 1024 KiB")
        self.write(COIL.encode() + b"#" * 1024 * 1024, "comment.toml")
        refused("comment.toml", "larger than 1024 KiB")
        if os.geteuid() != 0:
            self.write(COIL.encode(), "secret.toml")
            (self.folder / "secret.toml").chmod(0)
            refused("secret.toml", "permissions")

    def test_a_sound_model_beside_a_malformed_one_is_generated_alone(self):
        self.write(COIL.encode())
        self.write(coil('name = "m"', 'name = "n"', "gain*v", "gain*z").encode(), "n.toml")
        code, _, err, _ = self.run_algest("generate", "n.toml", "m.toml", "-o", "out")
        self.assertEqual(code, 2)
        self.assertEqual(len(complaints(err, name="n.toml")), 1)
        self.assertEqual(self.entries(), ["m.toml", "n.toml", "out", "out/m", "out/m/m.hpp", "out/m/m.md", "out/m/m_tables.hpp"])


def _add(group, cases):
    def test(self):
        for name, text, words in cases:
            with self.subTest(name):
                self.refused(text, words, COMMANDS)
    setattr(Malformed, f"test_each_is_refused_where_it_is_wrong_{group}", test)


for _group, _cases in CASES.items():
    _add(_group, _cases)


if __name__ == "__main__":
    unittest.main()
