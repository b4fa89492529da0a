# SPDX-License-Identifier: GPL-3.0-or-later
"""Model files spoilt at random, the same ones on every run: bytes, tokens and whole formulas."""
import random
import re

TOKEN = re.compile(rb'"""|\'\'\'|"[^"\n]*"|[A-Za-z_][A-Za-z0-9_]*|[0-9.]+(?:[eE][+-]?[0-9]+)?|\s+|#[^\n]*|.', re.DOTALL)

WORDS = [word.encode() for word in (
    "0 1 -1 2 33 -33 1.5 1e400 1e-400 9223372036854775807 99999999999999999999 nan inf -inf 0x1F 1979-05-27 true false der sin sqrt "
    "exp min max sgn abs log ( ) (( )) [ ] [[ ]] { } , . = == ^ ^^ ** * / // + - -- _ __ ; : # ' \" ''' \"\"\" \\ \\u0041 \\n \\ "
    "name unit ode kappa rows n m known unknowns input output signal law transfer equation signals parameters constants estimator "
    "feedback sampling period window solve \"robust\" \"square\" \"least_squares\" \"1\" \"V\" \"m/s\" \"\" [] {} u y x a0 b0 double").split()]
WORDS += [b"\n", b"\r\n", b"\r", b"\t", b" ", b"\0", b"\xff", b"\xc3", "é".encode(), "𝄞".encode(), "ω".encode(), b"\xef\xbb\xbf",
          b"(" * 200, b"-" * 200, b"[" * 300, b".a" * 40, b"9" * 500, b"a" * 500, b"^2" * 50, b"/a" * 50, b"der(" * 60]


def bytes_spoilt(text, draw):
    out = bytearray(text)
    for _ in range(draw.choice((1, 1, 2, 4, 16))):
        at = draw.randrange(len(out) + 1)
        what = draw.randrange(7)
        length = draw.choice((1, 1, 2, 8, 64))
        if what == 0:
            out[at:at + 1] = bytes([draw.randrange(256)])
        elif what == 1:
            del out[at:at + length]
        elif what == 2:
            out[at:at] = bytes(draw.randrange(256) for _ in range(length))
        elif what == 3:
            out[at:at] = out[at:at + length] * draw.choice((1, 2, 50))
        elif what == 4 and at < len(out):
            out[at] ^= 1 << draw.randrange(8)
        elif what == 5:
            del out[at:]
        else:
            other = draw.randrange(len(out) + 1)
            out[at:at] = out[other:other + 8 * length]
        if not out:
            break
    return bytes(out)


def tokens_spoilt(text, draw, others):
    tokens = TOKEN.findall(text)
    for _ in range(draw.choice((1, 1, 2, 3, 8))):
        if not tokens:
            break
        at = draw.randrange(len(tokens))
        what = draw.randrange(6)
        if what == 0:
            tokens[at] = draw.choice(WORDS)
        elif what == 1:
            tokens.insert(at, draw.choice(WORDS))
        elif what == 2:
            del tokens[at]
        elif what == 3:
            other = draw.randrange(len(tokens))
            tokens[at], tokens[other] = tokens[other], tokens[at]
        elif what == 4:
            tokens[at] = draw.choice(tokens)
        else:
            lines = draw.choice(others).splitlines(keepends=True)
            tokens.insert(at, draw.choice(lines))
    return b"".join(tokens)


def formula(draw, names, depth):
    """A formula that parses, mostly: signals, constants and parameters in every place."""
    if depth == 0 or draw.random() < 0.15:
        what = draw.random()
        if what < 0.8:
            return draw.choice(names)
        return draw.choice(("0", "1", "2", "0.1", "1e-3", "3"))
    part = [formula(draw, names, depth - 1) for _ in range(2)]
    what = draw.randrange(12)
    if what < 3:
        return f"{part[0]} + {part[1]}"
    if what < 4:
        return f"({part[0]} - {part[1]})"
    if what < 8:
        return f"({part[0]})*({part[1]})"
    if what < 9:
        return f"({part[0]})/({part[1]})"
    if what < 10:
        return f"({part[0]})^{draw.choice(('2', '3', '-1', '-2', '0', '0.5', '(1/2)', '4'))}"
    if what < 11:
        return f"{draw.choice(('sin', 'exp', 'sqrt', 'abs', 'sgn', 'log'))}({part[0]})"
    return f"-({part[0]})"


def formulas_model(draw):
    """A sound file around formulas of chance."""
    signals = ["x", "y", "u", "v"][:draw.randint(2, 4)]
    parameters = ["a", "b", "c", "d", "e"][:draw.randint(1, 5)]
    derivatives = [f"der({s})" for s in signals] + [f"der({signals[0]},2)"]
    text = 'name = "m"\n[sampling]\nperiod = 0.001\nwindow = 0.02\n[signals]\n'
    text += "".join(f"{s} = {{{draw.choice(('', '', ' noise = 0.1 ', ' unit = ' + chr(34) + 'V' + chr(34) + ' '))}}}\n" for s in signals)
    text += "[constants]\nk = { value = 2 }\nz = { value = 0 }\n[parameters]\n" + "".join(f"{p} = {{ initial = 1 }}\n" for p in parameters)
    for _ in range(draw.choice((1, 1, 2, 3))):
        inside = draw.random()
        if inside < 0.6:      # linear in the parameters
            terms = [f"{draw.choice(parameters)}*({formula(draw, signals + ['k'], draw.randint(0, 2))})" for _ in range(draw.randint(1, 5))]
            ode = f"{draw.choice(('', parameters[0] + '*'))}{draw.choice(derivatives)} = " + " + ".join(terms + [draw.choice(signals)])
        else:
            names = signals + parameters * 2 + derivatives + ["k", "z"]
            ode = f"{formula(draw, names, draw.randint(1, 3))} = {formula(draw, names, draw.randint(1, 4))}"
        text += f'[[equation]]\node = "{ode}"\n'
        if draw.random() < 0.3:
            text += f"kappa = {draw.randint(0, 3)}\n"
        if draw.random() < 0.2:
            text += f"rows = {draw.randint(1, 5)}\n"
    if draw.random() < 0.5:
        text += f'[estimator]\nsolve = "{draw.choice(("square", "robust", "least_squares"))}"\n'
    return text.encode()


def mutants(seed, count, models):
    """Yields `count` texts."""
    draw = random.Random(seed)
    for _ in range(count):
        what = draw.randrange(5)
        if what < 2:
            yield tokens_spoilt(draw.choice(models), draw, models)
        elif what < 3:
            yield bytes_spoilt(draw.choice(models), draw)
        elif what < 4:
            yield formulas_model(draw)
        else:
            yield tokens_spoilt(formulas_model(draw), draw, models)
