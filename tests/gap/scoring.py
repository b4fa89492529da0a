# SPDX-License-Identifier: GPL-3.0-or-later
"""How an answer of `algest discover` is judged against the truth of a case (answer.json)."""
import json
import math

VERDICTS = {   # from the best to the worst
    "right": "verdict, names and equations as in the answer",
    "honest": "ambiguous between what the answer allows; a gap without a name where only process noise is",
    "equal": "named a term, in its equation, that this recording cannot tell from the sensor's fault or wrong constant that is hidden",
    "cautious": "ambiguous, the truth among the alternatives, where the data would have told",
    "missed": "a gap, but no name for it",
    "denied": "something is hidden, and the answer is none",
    "partial": "named, all of it true, but not all of the truth",
    "misleading": "ambiguous without the truth",
    "wrong": "named what is not there",
}


def aliases(effects_json):
    return {e["name"]: {e["name"], *e["aliases"]} for e in json.loads(effects_json.read_text())["effects"]}


def accepted(answer, aliases):
    """For each effect the names that count for it, with their aliases."""
    return [set().union(*(aliases.get(name, {name}) for name in names)) for names in answer["accepted_names"]]


def names_match(found, wanted):
    """Every hidden effect is named, and nothing else."""
    rest = list(found)
    for choices in wanted:
        hit = next((name for name in rest if name in choices), None)
        if hit is None:
            return False
        rest.remove(hit)
    return not rest


def equations_match(found, answer, wanted):
    """Every equation of an effect carries the name of its signal, as `torque balance of w` carries w; o08 and o09 call x' v."""
    rest = list(found["effects"])
    for truth, choices in zip(answer["effects"], wanted):
        hit = next((e for e in rest if e["name"] in choices and signals_match(e["equation"], truth["equation"])), None)
        if hit is None:
            return False
        rest.remove(hit)
    return True


def signals_match(equations, truth):
    signals = {"x" if s == "v" and "force balance of x" in equations else s for s in truth.split(",")}
    return {e.split(" of ")[-1] for e in equations.split(", ")} == signals


def judge(found, answer, aliases):
    """One of VERDICTS."""
    wanted = accepted(answer, aliases)
    names = [e["name"] for e in found["effects"]]
    verdict, truth = found["verdict"], answer["verdict"]
    if verdict == "named":
        if truth in ("named", "unknown") and names_match(names, wanted) and equations_match(found, answer, wanted):
            return "right"
        part = [choices for choices in wanted if choices & set(names)]
        if truth == "named" and 0 < len(part) < len(wanted) and names_match(names, part):
            return "partial"
        terms = answer.get("equal_terms", [])
        if truth == "ambiguous" and len(names) == 1 and any(names[0] == name and signals_match(found["effects"][0]["equation"], place) for name, place in terms):
            return "equal"
        return "wrong"
    if verdict == "ambiguous":
        among = any(names_match(list(alternative), wanted) for alternative in found["alternatives"])
        allowed = {n for name in answer["may_stay_ambiguous"] for n in aliases.get(name, {name})}
        offered = {name for alternative in found["alternatives"] for name in alternative}
        if truth == "ambiguous":
            return "right" if among or offered & allowed else "misleading"
        if not among:
            return "misleading"
        return "honest" if allowed and offered <= allowed.union(*wanted) else "cautious"
    if verdict == truth:
        return "right"
    if verdict == "unknown":   # a gap without a name
        return "honest" if truth == "none" and "torque noise" in answer["note"] else "missed"
    return "denied"


def parameter_error(found, answer, aliases):
    """Largest relative error of the effects' strengths; None where names differ. A wave is compared by its amplitude."""
    worst = None
    for truth, choices in zip(answer["effects"], accepted(answer, aliases)):
        effect = next((e for e in found["effects"] if e["name"] in choices), None)
        if effect is None or not effect["parameters"] or not truth["params"]:
            return None
        values = [p["value"] for p in effect["parameters"]]
        true = list(truth["params"].values())
        if truth["name"] in ("cogging_torque", "sinusoidal_disturbance") and len(values) >= 2:
            error = abs(math.hypot(values[0], values[1]) / abs(true[0]) - 1)
        else:
            error = abs(abs(values[0]) / abs(true[0]) - 1)
        worst = error if worst is None else max(worst, error)
    return worst


def gap(found, answer):
    """(before, after) as multiples of the floor, of the worst output; process noise has a floor of its own in the answer."""
    before = after = 0.0
    for o in found["outputs"]:
        floor = max(o["noise_floor"], answer["noise_floor_nrmse"].get(o["signal"], 0.0))
        before = max(before, o["nrmse_before"] / floor)
        after = max(after, o["nrmse_after"] / floor)
    return before, after
