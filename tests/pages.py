# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages that algest writes: one file that needs nothing else, formulas that an XML parser reads."""
import collections
import re
import xml.etree.ElementTree as ElementTree

LARGEST = 1_500_000   # bytes: fit to be sent by mail


def page_faults(text):
    """What is wrong with the text of a page, a sentence each."""
    links = re.findall(r"\b(?:src|srcset|href|action|data|poster)\s*=\s*[\"']([^\"']*)", text)
    found = [f"loads {link}" for link in links if not link.startswith("#")]
    found += [f"has {way}" for way in ("<script", "<link", "<iframe", "<object", "@import", "url(") if way in text]
    if len(text) > LARGEST:
        found.append(f"is {len(text)} bytes long")
    names = collections.Counter(re.findall(r"\bid=[\"']([^\"']+)", text))
    found += [f"has the id {name} {count} times" for name, count in names.items() if count > 1]
    found += [f"leads to {link}, which is not there" for link in links if link.startswith("#") and link[1:] not in names]
    for formula in formulas(text):
        try:
            ElementTree.fromstring(formula)
        except ElementTree.ParseError as error:
            found.append(f"has a formula that is no XML, {error}: {formula}")
    return found


def formulas(text):
    return re.findall(r"<math.*?</math>", text, flags=re.DOTALL)


def words_of(formula):
    """A formula's letters, numbers and signs in their order, without what places them."""
    return "".join(ElementTree.fromstring(formula).itertext())
