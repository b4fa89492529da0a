# SPDX-License-Identifier: GPL-3.0-or-later
"""Effect files that are refused: exit 2, at the right line and column, and nothing is written. In the texts below the mark ▸ stands
where the complaint belongs (two complaints: two marks)."""
import re
import subprocess
import sys
import unittest

from environment import SOURCE

sys.path.insert(0, str(SOURCE / "tests/models"))
from model_case import ModelCase, complaints, without_marks  # noqa: E402

FRICTION = """\
name = "seal_friction"
aliases = ["seal_drag"]
summary = "friction of my seal"
shows = "the residual jumps where the speed changes its sign"
reference = "measured on our bench"

[enters]
units = ["N.m", "N"]

[roles]
speed = "speed"

[rewrite]
kind = "add_term"
term = "-Tseal*sgn({speed})"

[[parameter]]
name = "Tseal"
unit = "{equation}"
min = 0

[[rival]]
name = "viscous_friction"
experiment = "run at several speeds"
"""

WAVE = """\
name = "ripple"
summary = "a wave over the angle"
shows = "a wave"
reference = "measured on our bench"

[enters]
units = ["N.m"]
together = false

[roles]
angle = "angle"

[rewrite]
kind = "add_term"
term = "-Tr*sin(Nr*{angle})"

[[parameter]]
name = "Tr"
unit = "{equation}"

[[scan]]
name = "Nr"
unit = "1"
from = 2
to = 60
step = 1
"""

FRAME = """\
name = "drop"
summary = "a voltage against the current"
shows = "a jump"
reference = "measured on our bench"

[enters]
units = ["V"]

[roles]
current = "current"

[rewrite]
kind = "add_term"
term = "-Vd*sgn({current})"
d = "-Vd*sgn({d})"
q = "-Vd*sgn({q})*cos({angle})"

[[parameter]]
name = "Vd"
unit = "{equation}"
"""

LAG = """\
name = "slow_valve"
summary = "a valve that follows"
shows = "the slope of the input"
reference = "measured on our bench"

[roles]
input = "actuator"

[rewrite]
kind = "add_state"

[[edit]]
in = "all"
what = "{input}"
by = "opening"

[[state]]
name = "opening"
unit = "{input}"
initial = 0
equation = "tau*der(opening) = {input} - opening"

[[scan]]
name = "tau"
unit = "s"
of = "period"
from = 0.5
to = 64
factor = 2
fitted = true
"""

GAIN = """\
name = "wrong_scale"
summary = "a scale that is wrong"
shows = "a line"
reference = "measured on our bench"

[roles]
sensor = "sensor"

[rewrite]
kind = "transform_signal"

[[edit]]
in = "all"
what = "{sensor}"
by = "{sensor}/scale"
derivative = "{derivative}/scale"

[[parameter]]
name = "scale"
unit = "1"
neutral = 1
min = 0.1
"""

VALUE = """\
name = "wrong_value"
summary = "a constant that is wrong"
shows = "a line"
reference = "measured on our bench"

[roles]
known = "constant"

[rewrite]
kind = "free_constant"
what = "{known}"
"""

MODEL = """\
name = "m"
[sampling]
period = 0.001
[signals]
u = { unit = "V" }
w = { unit = "rad/s", noise = 0.1, initial = 0 }
[parameters]
J = { initial = 1, unit = "kg.m^2" }
K = { initial = 1, unit = "N.m/V" }
[[equation]]
ode = "J*der(w) = K*u"
"""
RECORDING = "t [s],u [V],w [rad/s]\n0,0,0\n0.001,1,0.1\n"   # sound, and too short to search in


def changed(text, *pairs):
    """The text with replacements; what is replaced must stand there exactly once."""
    for old, new in zip(pairs[::2], pairs[1::2]):
        assert text.count(old) == 1, (old, text.count(old))
        text = text.replace(old, new)
    return text


def friction(*pairs):
    return changed(FRICTION, *pairs)


def wave(*pairs):
    return changed(WAVE, *pairs)


def frame(*pairs):
    return changed(FRAME, *pairs)


def lag(*pairs):
    return changed(LAG, *pairs)


def gain(*pairs):
    return changed(GAIN, *pairs)


def term(text):
    return friction("-Tseal*sgn({speed})", text)


def without(text, key):
    """The text without the only line that starts with this key."""
    lines = text.splitlines(True)
    assert sum(line.startswith(key + " =") for line in lines) == 1, key
    return "".join(line for line in lines if not line.startswith(key + " ="))


TOML = [
    ("text not closed", friction('"friction of my seal"', '"friction of my seal▸'), "not closed on its line"),
    ("no value", friction("min = 0", "min = ▸"), "expected value"),
    ("key twice", friction("min = 0", "min = 0\nmin = ▸1"), "redefine"),
    ("not UTF-8", friction("my seal", "my seal▸\udcff"), "not UTF-8"),
    ("key of eleven parts", "a.b.c.d.e.f.g.h.i.j▸.k = 1\n", "more than 10 parts"),
    ("another format", "format = ▸2\n" + FRICTION, "this version reads format = 1"),
]

KEYS = [
    ("misspelt key", friction("shows", '▸show = "it jumps"\nshows'), "did you mean shows?"),
    ("key of another place", "▸min = 0\n" + FRICTION, "unknown key 'min'; keys here: format, name"),
    ("source for reference", '▸source = "me"\n' + FRICTION, "unknown key 'source'"),
    ("misspelt section", friction("[[rival]]", "[[▸rivals]]"), "did you mean rival?"),
    ("misspelt key of enters", wave("together", "▸togehter"), "did you mean together?"),
    ("misspelt key of rewrite", friction("[rewrite]", '[rewrite]\n▸terms = "-Tseal"'), "did you mean term?"),
    ("misspelt key of a parameter", friction("min", "▸mni"), "did you mean min?"),
    ("initial value of a parameter", friction("min", "▸initial"), "keys here: name, unit, min"),
    ("misspelt key of a scan", wave("step = 1", "step = 1\n▸spectrm = false"), "did you mean spectrum?"),
    ("misspelt key of a rival", friction("experiment", '▸experment = "x"\nexperiment'), "did you mean experiment?"),
    ("enters is a text", friction('[enters]\nunits = ["N.m", "N"]\n', "", "aliases", 'enters = ▸"N.m"\naliases'), "'enters' is not a table"),
    ("parameter is one table", friction("[[parameter]]", "▸[parameter]"), "write [[parameter]]"),
    ("scan is one table", wave("[[scan]]", "▸[scan]"), "write [[scan]]"),
    ("rival is a text", 'rival = ▸"coulomb_friction"\n' + FRICTION.split("[[rival]]")[0], "write [[rival]]"),
    ("roles is a list", 'roles = ▸["speed"]\n' + friction('[roles]\nspeed = "speed"\n', ""), "'roles' is not a table"),
]

MISSING = [
    ("no name", "▸" + without(FRICTION.replace('name = "Tseal"', 'name  = "Tseal"').replace('name = "viscous', 'name  = "viscous'), "name"), "no name; add name = "),
    ("no summary", "▸" + without(FRICTION, "summary"), "no summary; add summary = "),
    ("no enters", "▸" + friction('[enters]\nunits = ["N.m", "N"]\n', ""), "no [enters]"),
    ("no units", friction("[enters]", "▸[enters]", 'units = ["N.m", "N"]', ""), "no units of equations"),
    ("no unit among the units", friction('["N.m", "N"]', "▸[]"), "no units of equations"),
    ("no rewrite", "▸" + re.sub(r"\[rewrite\](\n.+)*\n", "", FRICTION), "no [rewrite]"),
    ("no kind", without(friction("[rewrite]", "▸[rewrite]"), "kind"), 'add kind = "add_term"'),
    ("no term", without(friction("[rewrite]", "▸[rewrite]"), "term"), "no term"),
    ("no parameter", "▸" + re.sub(r"\[\[parameter\]\](\n.+)*\n", "", FRICTION), "no [[parameter]]"),
    ("parameter without a name", friction("[[parameter]]", "▸[[parameter]]", 'name = "Tseal"\n', ""), "no name"),
    ("parameter without a unit", friction("[[parameter]]", "▸[[parameter]]", 'unit = "{equation}"\n', ""), "no unit"),
    ("scan without a name", wave("[[scan]]", "▸[[scan]]", 'name = "Nr"\n', ""), "no name"),
    ("scan without a unit", wave("[[scan]]", "▸[[scan]]", 'unit = "1"\n', ""), "no unit"),
    ("scan without from", wave("[[scan]]", "▸[[scan]]", "from = 2\n", ""), "no from"),
    ("scan without to", wave("[[scan]]", "▸[[scan]]", "to = 60\n", ""), "no to"),
    ("scan without step", wave("[[scan]]", "▸[[scan]]", "step = 1\n", ""), "no step"),
    ("rival without a name", friction("[[rival]]", "▸[[rival]]", 'name = "viscous_friction"\n', ""), "no name"),
    ("rival without an experiment", friction("[[rival]]", "▸[[rival]]", 'experiment = "run at several speeds"\n', ""), "no experiment"),
    ("d without q", frame("[rewrite]", "▸[rewrite]", 'q = "-Vd*sgn({q})*cos({angle})"\n', ""), "d without q"),
    ("q without d", frame("[rewrite]", "▸[rewrite]", 'd = "-Vd*sgn({d})"\n', ""), "q without d"),
    ("an empty file", "▸▸▸▸▸", "no name"),
]

VALUES = [
    ("name with a blank", friction('"seal_friction"', '▸"seal friction"'), "is not the name of an effect"),
    ("name with capitals", friction('"seal_friction"', '▸"SealFriction"'), "lower case"),
    ("empty name", friction('"seal_friction"', '▸""'), "'name' is empty"),
    ("name that is a number", friction('"seal_friction"', "▸7"), "not a text"),
    ("alias with a blank", friction('"seal_drag"', '"x", ▸"seal drag"'), "is not the name of an effect"),
    ("aliases as a text", friction('["seal_drag"]', '▸"seal_drag"'), "'aliases' is not a list"),
    ("alias that is a number", friction('"seal_drag"', "▸7"), "not a text"),
    ("empty summary", friction('"friction of my seal"', '▸""'), "'summary' is empty"),
    ("summary of two lines", friction('"friction of my seal"', '▸"friction\\nof my seal"'), "not one plain line"),
    ("summary that is a list", friction('"friction of my seal"', '▸["a"]'), "not a text"),
    ("experiment of two lines", friction('"run at several speeds"', '▸"run\\nfast"'), "not one plain line"),
    ("outside as a text", 'outside = ▸"yes"\n' + FRICTION, "neither true nor false"),
    ("together as a number", wave("together = false", "together = ▸1"), "neither true nor false"),
    ("unit Nm", friction('["N.m", "N"]', '[▸"Nm", "N"]'), "write N.m"),
    ("unit that is none", friction('["N.m", "N"]', '["N.m", ▸"newtonmetre"]'), "UDUNITS does not know"),
    ("units as a text", friction('["N.m", "N"]', '▸"N.m"'), "'units' is not a list"),
    ("a placeholder where the effect enters", friction('["N.m", "N"]', '["N.m", ▸"{equation}"]'), "UDUNITS does not know"),
    ("unknown kind of role", friction('speed = "speed"', 'speed = ▸"velocity"'), "'velocity' is no kind of role; kind of role is one of own | speed |"),
    ("misspelt kind of role", friction('speed = "speed"', 'speed = ▸"sped"'), "did you mean speed?"),
    ("kind of role that is a number", friction('speed = "speed"', "speed = ▸1"), "not a text"),
    ("unknown kind of rewrite", friction('"add_term"', '▸"subtract"'), "'subtract' is no kind of rewrite"),
    ("misspelt kind of rewrite", friction('"add_term"', '▸"add_trem"'), "did you mean add_term?"),
    ("parameter's unit Nm", friction('"{equation}"', '▸"Nm"'), "write N.m"),
    ("parameter's unit with a role that is none", friction('"{equation}"', '▸"{equation}/({angle})"'), "nothing stands for '{angle}'; placeholders of a unit here: {equation}, {speed}"),
    ("parameter's unit not closed", friction('"{equation}"', '▸"{equation}/({speed)"'), "nothing stands for '{speed"),
    ("parameter's unit that is none", friction('"{equation}"', '▸"{equation}//{speed}"'), "whatever stands for its placeholders"),
    ("unit of a role beside a rotating frame", frame('"{equation}"', '▸"{equation}/({current})"'), "nothing stands for '{current}'"),
    ("unit that is a number", friction('"{equation}"', "▸1"), "not a text"),
    ("min as a text", friction("min = 0", 'min = ▸"none"'), "'min' is not a number"),
    ("min as true", friction("min = 0", "min = ▸true"), "'min' is not a number"),
    ("min without end", friction("min = 0", "min = ▸-inf"), "'min' is not finite"),
    ("from as a text", wave("from = 2", 'from = ▸"two"'), "'from' is not a number"),
    ("to as true", wave("to = 60", "to = ▸true"), "'to' is not a number"),
    ("to as a list", wave("to = 60", "to = ▸[60]"), "'to' is not a number"),
    ("step as a text", wave("step = 1", 'step = ▸"1 turn"'), "'step' is not a number"),
    ("a range from its end", wave("from = 2", "from = 90", "to = 60", "to = ▸60"), "to is not above from"),
    ("a range of nothing", wave("from = 2", "from = 60", "to = 60", "to = ▸60"), "to is not above from"),
    ("a step of 0", wave("step = 1", "step = ▸0"), "'step' is not positive"),
    ("a step back", wave("step = 1", "step = ▸-1"), "'step' is not positive"),
    ("a million values", wave("step = 1", "step = ▸5e-5"), "more than 10000 values"),
    ("unit of a scan that is none", wave('unit = "1"', 'unit = ▸"tours"'), "UDUNITS does not know"),
    ("spectrum as a text", wave("step = 1", 'step = 1\nspectrum = ▸"yes"'), "neither true nor false"),
    ("spectrum and a range", wave("from = 2\nto = 60\nstep = 1", "spectrum = true\nstep = ▸1", '"1"', '"rad/s"'), "'step' beside spectrum"),
    ("spectrum in hertz", wave("from = 2\nto = 60\nstep = 1", "spectrum = true", '"1"', '▸"1/min"'), 'write unit = "rad/s"'),
    ("rival with a blank", friction('"viscous_friction"', '▸"viscous friction"'), "is not the name of an effect"),
]

NAMES = [
    ("parameter twice", friction("[[rival]]", '[[parameter]]\nname = ▸"Tseal"\nunit = ""\n[[rival]]'), "'Tseal' is declared twice"),
    ("parameters that differ by case", friction("[[rival]]", '[[parameter]]\nname = ▸"TSEAL"\nunit = ""\n[[rival]]'), "differ by case alone"),
    ("scan named like a parameter", wave('"Nr"', '▸"Tr"'), "'Tr' is declared twice"),
    ("parameter named like a role", friction('"Tseal"', '▸"speed"'), "'speed' is declared twice"),
    ("parameter that is a keyword", friction('"Tseal"', '▸"double"'), "is a C++ keyword"),
    ("parameter that is a function", friction('"Tseal"', '▸"abs"'), "is a function"),
    ("parameter with a blank", friction('"Tseal"', '▸"T seal"'), "is not a name"),
    ("parameter that begins with a digit", friction('"Tseal"', '▸"1T"'), "does not start with a letter"),
    ("role with a minus", friction('speed = "speed"', '▸any-speed = "speed"'), "is not a name"),
    ("role named equation", friction('speed = "speed"', '▸equation = "speed"'), "stands for the unit of the equation"),
    ("seven roles", friction('speed = "speed"', 'speed = "speed"\n' + "".join(f'x{k} = "input"\n' for k in range(1, 6)) + '▸x6 = "input"'), "more than 6 roles"),
    ("two scans", WAVE + '\n▸[[scan]]\nname = "M"\nunit = "1"\nfrom = 1\nto = 2\nstep = 1\n', "a second [[scan]]"),
    ("a rival twice", FRICTION + '[[rival]]\nname = ▸"viscous_friction"\nexperiment = "x"\n', "is a rival twice"),
    ("its own rival", friction('"viscous_friction"', '▸"seal_friction"'), "its own rival"),
    ("unused parameter", friction("[[rival]]", '[[parameter]]\nname = ▸"T2"\nunit = ""\n[[rival]]'), "'T2' stands in no term"),
    ("unused scan", wave("sin(Nr*{angle})", "sin({angle})", '"Nr"', '▸"Nr"'), "'Nr' stands in no term"),
    ("unused role", friction('speed = "speed"', 'speed = "speed"\n▸load = "input"'), "{load} stands in no term"),
]

TERMS = [
    ("empty term", friction('"-Tseal*sgn({speed})"', '▸""'), "'term' is empty"),
    ("term that is a number", friction('"-Tseal*sgn({speed})"', "▸1"), "not a text"),
    ("unknown name", term("-Tseal*sgn({speed}) + ▸Toff"), "unknown name 'Toff'; declare it under [[parameter]] or [[scan]]"),
    ("misspelt parameter", term("-▸Tsael*sgn({speed})"), "did you mean Tseal?"),
    ("role without braces", term("-Tseal*sgn(▸speed)"), "'speed' stands without braces; write {speed}"),
    ("unknown role", term("-Tseal*sgn(▸{angle})"), "nothing stands for '{angle}'; placeholders here: {speed}"),
    ("misspelt role", term("-Tseal*sgn(▸{sped})"), "did you mean speed?"),
    ("role with blanks", term("-Tseal*sgn(▸{ speed })"), "nothing stands for '{ speed }'"),
    ("parameter in braces", term("-▸{Tseal}*sgn({speed})"), "nothing stands for '{Tseal}'"),
    ("placeholder not closed", term("-Tseal*sgn(▸{speed)"), "'{' is never closed"),
    ("placeholder not opened", term("-Tseal*sgn(speed▸})"), "'}' without '{'"),
    ("unknown function", term("-Tseal*▸sign({speed})"), "sign"),
    ("no product sign", term("-▸Tseal{speed}"), "write * for a product"),
    ("parenthesis not closed", term("-Tseal*▸sgn({speed}"), "never closed"),
    ("an equation", term("F ▸= -Tseal*sgn({speed})"), "'=' in an expression"),
    ("division by zero", term("-Tseal*sgn({speed})/▸0"), "division by zero"),
    ("parameter in a function", term("-Tseal*sgn(▸Tseal*{speed})"), "parameter 'Tseal' stands inside sgn(): the equation is not linear in it; make it a factor of the term, or scan it"),
    ("parameter squared", friction('"-Tseal*sgn({speed})"', '▸"-Tseal^2*sgn({speed})"'), "not linear in its parameters"),
    ("one over a parameter", friction('"-Tseal*sgn({speed})"', '▸"-sgn({speed})/Tseal"'), "not linear in its parameters"),
    ("a part without a parameter", friction('"-Tseal*sgn({speed})"', '▸"-Tseal*sgn({speed}) - 3*{speed}"'), "has no parameter: 'speed'"),
    ("zero", friction('"-Tseal*sgn({speed})"', '▸"Tseal*{speed} - Tseal*{speed}"'), "the term is zero"),
    ("derivative of a parameter", term("-Tseal*der(▸Tseal)"), "der() of something that is not a role"),
    ("derivative of a function", term("-Tseal*der(▸sgn({speed}))"), "der() of something that is not a role"),
    ("derivative of half an order", term("-Tseal*der({speed},▸0.5)"), "the order of der()"),
    ("unit of another dimension", friction('"-Tseal*sgn({speed})"', '"▸-Tseal*{speed}"'), "in an equation in N.m: 'equation' [J] and '-Tseal*speed' [m2.kg.s-3.rad] differ in dimension"),
    ("sine of a speed", friction("sgn({speed})", "sin(▸{speed})"), "the argument of sin has the unit"),
    ("a frame's axis outside of it", frame('sgn({current})"', 'sgn({current})*cos(▸{angle})"'), "nothing stands for '{angle}'"),
    ("a role in a rotating frame", frame("sgn({d})", "sgn(▸{current})"), "nothing stands for '{current}'; placeholders here: {angle}, {d}, {q}"),
    ("unknown name in q", frame("cos({angle})", "cos(▸th)"), "unknown name 'th'"),
]

EDITS = [
    ("misspelt key of an edit", gain("what", "▸waht = 1\nwhat"), "did you mean what?"),
    ("misspelt key of a state", lag("initial", "▸inital"), "did you mean initial?"),
    ("no edit", gain("[rewrite]", "▸[rewrite]", GAIN[GAIN.index("[[edit]]"):GAIN.index("[[parameter]]")], ""), "no [[edit]]"),
    ("no state", lag("[rewrite]", "▸[rewrite]", LAG[LAG.index("[[state]]"):LAG.index("[[scan]]")], "", '"opening"', '"{input}"'), "no [[state]]"),
    ("an edit of nothing", gain("[[edit]]", "▸[[edit]]", 'what = "{sensor}"\n', ""), "no what"),
    ("an edit by nothing", gain("[[edit]]", "▸[[edit]]", 'by = "{sensor}/scale"\n', ""), "no by"),
    ("a state without equation", lag("[[state]]", "▸[[state]]", 'equation = "tau*der(opening) = {input} - opening"\n', ""), "no equation"),
    ("unknown reach", gain('"all"', '▸"both"'), "'both' is no reach of an edit"),
    ("unknown part", gain('in = "all"', 'at = ▸"first"'), "'first' is no part of an equation"),
    ("what is no role", gain('what = "{sensor}"', 'what = ▸"w"'), "'w' is no role; write one of [roles] in braces"),
    ("a term beside what", gain('in = "all"', 'add = "scale*{sensor}"', "what = ", "what = ▸", "by = ", "by = ▸", "\nderivative = ", "\nderivative = ▸"), "'what' beside 'add'"),
    ("unknown name in by", gain('"{sensor}/scale"', '"{sensor}/▸scal"'), "did you mean scale?"),
    ("role without braces in by", gain('"{sensor}/scale"', '"▸sensor/scale"'), "'sensor' stands without braces"),
    ("parameter in braces in by", gain('"{sensor}/scale"', '"{sensor}/{▸scale}"'), "'scale' stands in braces"),
    ("by not closed", gain('"{sensor}/scale"', '▸"{sensor/scale"'), "do not pair"),
    ("by that is no formula", gain('"{sensor}/scale"', '"{sensor}/▸/scale"'), "an operand is missing"),
    ("a state beside a transformed signal", GAIN + '\n▸[[state]]\nname = "x"\nequation = "der(x) = {sensor}"\n', "[[state]] beside another kind"),
    ("an edit beside a term", friction("[[parameter]]", '▸[[edit]]\nadd = "x"\n[[parameter]]'), "[[edit]] beside kind"),
    ("a parameter beside a constant", VALUE + '\n▸[[parameter]]\nname = "x"\nunit = "1"\n', "[[parameter]] beside kind"),
    ("no constant", without(VALUE.replace("[rewrite]", "▸[rewrite]"), "what"), "no what"),
    ("a constant that is no role", VALUE.replace('what = "{known}"', 'what = ▸"K"'), "'K' is no role"),
    ("neutral of a term", friction("min = 0", "neutral = ▸1"), "'neutral' of a term"),
    ("neutral that is no role", gain("neutral = 1", 'neutral = ▸"one"'), "no value at which the effect does nothing"),
    ("of something else", lag('"period"', '▸"hour"'), "nothing that a range can be counted in"),
    ("step beside factor", lag("factor = 2", "factor = 2\nstep = ▸1"), "'step' beside 'factor'"),
    ("factor of 1", lag("factor = 2", "factor = ▸1"), "'factor' is below 1.01"),
    ("factor from 0", lag("from = 0.5", "from = ▸0"), "'from' is not positive"),
    ("unit of a state", lag('unit = "{input}"', 'unit = ▸"Nm"'), "write N.m"),
    ("no parameter of a gain", "▸" + GAIN[:GAIN.index("[[parameter]]")].replace("/scale", "/2"), "no [[parameter]]"),
    ("unused state", lag('by = "opening"', 'by = "{input}"', "tau*der(opening) = {input} - opening", "tau*{input} = {input}", 'name = "opening"', 'name = ▸"opening"'), "stands in no term"),
]

CASES = {"TOML": TOML, "keys": KEYS, "missing": MISSING, "values": VALUES, "names": NAMES, "terms": TERMS, "edits": EDITS}


class Malformed(ModelCase):
    def setUp(self):
        super().setUp()
        self.write(MODEL.encode())
        self.write(RECORDING.encode(), "m.csv")
        (self.folder / "effects").mkdir()

    def effect(self, name="e.toml"):
        return str(self.folder / "effects" / name)

    def answer(self):
        return self.run_algest("discover", "m.toml", "m.csv", "-o", "out")

    def refused(self, text, words):
        content, places = without_marks(text)
        self.assertTrue(places, "no mark in the text")
        self.write(content, "effects/e.toml")
        code, out, err, seconds = self.answer()
        self.assertEqual(code, 2, out + err)
        found = complaints(err, name=self.effect())
        self.assertEqual([place[:2] for place in found], places, err[:2000])
        self.assertTrue(any(words in place[2] for place in found), f"{words!r} is not said:\n{err[:2000]}")
        for _, _, complaint in found:
            self.assertIn("; ", complaint)   # what would be right
            self.assertLess(len(complaint), 400)
        self.assertEqual(err.count(": error: "), len(places), err)   # nothing else is to blame
        self.assertEqual(out, "")
        self.assertLess(seconds, 1.0)
        self.assertEqual(self.entries(), ["effects", "effects/e.toml", "m.csv", "m.toml"])

    def sound(self):
        """The effects are; it is the recording that is refused."""
        code, _, err, _ = self.answer()
        self.assertEqual(code, 2)
        self.assertEqual(err.count(": error: "), 1, err)
        self.assertIn("m.csv: error: too short", err)

    def test_what_they_are_made_from_is_sound(self):
        self.sound()   # the library
        for text in (FRICTION, WAVE, FRAME, LAG, VALUE, GAIN, "format = 1\noutside = true\n" + FRICTION, friction("min = 0", "min = -0.5"), friction("min = 0", 'min = "1/3"'),
                     term("-Tseal*{speed}/(2*{speed})"), friction("-Tseal*sgn({speed})", "-Tseal*der({speed})", '"{equation}"', '"{equation}/({speed}).s"'),
                     wave("from = 2\nto = 60\nstep = 1", "spectrum = true", '"1"', '"rad/s"', '"angle"', '"time"')):
            self.write(text.encode(), "effects/e.toml")
            self.sound()

    def test_the_rewrites_of_the_docs_are_sound(self):
        page = (SOURCE / "docs/discover.md").read_text(encoding="utf-8")
        texts = re.findall(r"```toml-rewrite\n(.*?)```", page, flags=re.DOTALL)
        self.assertEqual([re.search(r'kind = "(\w+)"', text)[1] for text in texts], ["replace", "transform_signal", "add_state", "free_constant"])
        for text in texts:
            self.write(text.encode(), "effects/e.toml")
            self.sound()

    def test_what_only_a_reader_misses_is_a_warning(self):
        for key in ("shows", "reference"):
            self.write(without(FRICTION, key).encode(), "effects/e.toml")
            self.sound()
            _, _, err, _ = self.answer()
            self.assertIn(f'{self.effect()}:1:1: warning: no {key}; add {key} = "', err)
            self.assertEqual(err.count(": warning: "), 1, err)

    def test_the_library_lacks_nothing(self):
        self.assertNotIn("warning", self.answer()[2])

    def test_there_are_enough_and_each_is_another(self):
        texts = [text for cases in CASES.values() for _, text, _ in cases]
        self.assertGreaterEqual(len(texts), 100)
        self.assertEqual(len(texts), len(set(texts)))

    def test_several_complaints_come_in_one_run_in_the_order_of_the_file(self):
        self.refused(FRICTION.replace('"seal_friction"', '▸"Seal"').replace('"friction of my seal"', "▸1").replace('"N.m", "N"', '▸"Nm", "N"')
                     .replace("sgn({speed})", "sgn(▸sped)").replace("min = 0", 'min = ▸"no"').replace("experiment", '▸experiments = ""\nexperiment'), "unknown name 'sped'")

    def test_two_effects_of_one_name(self):
        self.write(FRICTION.encode(), "effects/a.toml")
        self.write(FRICTION.encode(), "effects/b.toml")
        code, _, err, _ = self.answer()
        self.assertEqual(code, 2)
        self.assertEqual([place[:2] for place in complaints(err, name=self.effect("b.toml"))], [(1, 8)])
        self.assertIn("'seal_friction' is an effect of " + self.effect("a.toml") + " as well", err)

    def test_an_effect_of_the_library_may_be_replaced(self):
        self.write(friction('"seal_friction"', '"coulomb_friction"').encode(), "effects/e.toml")
        self.sound()

    def test_what_is_no_readable_file(self):
        (self.folder / "effects" / "folder.toml").mkdir()
        with open(self.folder / "effects" / "large.toml", "wb") as file:
            file.truncate(100_000_000)
        code, _, err, _ = self.answer()
        self.assertEqual(code, 2)
        self.assertIn(self.effect("folder.toml") + ": error: is a directory", err)
        self.assertIn(self.effect("large.toml") + ": error: larger than 1024 KiB", err)

    def test_every_key_is_in_the_table_of_the_docs(self):
        """The reader's own lists, as it says them when a key is unknown."""
        sections = {}
        for effect in (FRICTION + "[[scan]]\n", LAG, VALUE):
            text = "none = 1\n" + re.sub(r"(\[(enters|rewrite|\[\w+\])\])\n", r"\1\nnone = 1\n", effect)
            self.write(text.encode(), "effects/e.toml")
            said = re.findall(r"e\.toml:(\d+):\d+: error: unknown key 'none'; keys here: (.*)", self.answer()[2])
            lines = text.splitlines()
            for number, keys in said:
                sections.setdefault("top" if number == "1" else lines[int(number) - 2], set()).update(keys.split(", "))
        self.assertEqual(set(sections), {"top", "[enters]", "[rewrite]", "[[edit]]", "[[state]]", "[[parameter]]", "[[scan]]", "[[rival]]"})
        documented = {}
        page = (SOURCE / "docs/discover.md").read_text(encoding="utf-8").split("## Every key of an effect file")[1]
        where = ""
        for row in re.findall(r"^\|([^|]*)\|([^|]*)\|", page, flags=re.MULTILINE)[2:]:
            where = row[0].strip("` ") or where
            documented.setdefault(where, set()).update(re.findall(r"`(\w+)`", row[1]))
        tables = {"enters", "roles", "rewrite", "edit", "state", "parameter", "scan", "rival"}   # have rows of their own
        self.assertEqual(documented.pop("top"), sections.pop("top") - tables)
        documented.pop("[roles]", None)   # holds names
        self.assertEqual(documented, sections)

    def test_every_kind_of_role_is_in_the_docs(self):
        self.write(friction('speed = "speed"', 'speed = "none"').encode(), "effects/e.toml")
        kinds = re.search(r"kind of role is one of (.*)", self.answer()[2])[1].split(" | ")
        page = (SOURCE / "docs/discover.md").read_text(encoding="utf-8").split("| role | what may stand for it |")[1].split("\n\n")[0]
        self.assertEqual(re.findall(r"^\| `(\w+)` \|", page, flags=re.MULTILINE), kinds)


def _add(group, cases):
    def test(self):
        for name, text, words in cases:
            with self.subTest(name):
                self.refused(text, words)
    setattr(Malformed, f"test_each_is_refused_where_it_is_wrong_{group}", test)


for _group, _cases in CASES.items():
    _add(_group, _cases)


if __name__ == "__main__":
    unittest.main()
