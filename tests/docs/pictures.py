"""Whether two SVG pictures show the same: the same elements, in any order, with the same words, and every number in them
(positions, sizes, widths of lines, parts of colours) equal within a tolerance.

Outlines of letters and markers (<defs>) depend on the fonts and the version of the library that draws, and are left out;
where letters stand is compared."""

import re
import xml.etree.ElementTree

NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?")
# Names of letters and markers, and who drew the picture.
NAMES = re.compile(r"(?:^#|url\(#).*$")
LEFT_OUT = {"defs", "desc", "title", "metadata"}
TOLERANCE = 0.2  # of the unit of the picture, a point or a pixel, and of per cents of colours


def elements(path):
    """(tag, {attribute: value}, text) of everything that is drawn."""
    def visit(element):
        tag = element.tag.rpartition("}")[2]
        if tag in LEFT_OUT:
            return
        attributes = {name.rpartition("}")[2]: value for name, value in element.attrib.items()}
        attributes.pop("id", None)
        yield tag, attributes, (element.text or "").strip()
        for child in element:
            yield from visit(child)
    return list(visit(xml.etree.ElementTree.parse(path).getroot()))


def difference_of_values(shown, made):
    if NAMES.match(shown) and NAMES.match(made):
        return None
    if " ".join(NUMBER.sub("#", shown).split()) != " ".join(NUMBER.sub("#", made).split()):
        return f"{shown[:60]!r} and {made[:60]!r}"
    for a, b in zip(NUMBER.findall(shown), NUMBER.findall(made), strict=True):
        if abs(float(a) - float(b)) > TOLERANCE:
            return f"{a} and {b} in {shown[:60]!r}"
    return None


def difference_of_elements(shown, made):
    (tag, attributes, text), (other_tag, other_attributes, other_text) = shown, made
    if tag != other_tag or attributes.keys() != other_attributes.keys():
        return f"<{tag} {sorted(attributes)}> and <{other_tag} {sorted(other_attributes)}>"
    if text != other_text:
        return f"{text!r} and {other_text!r}"
    for name, value in attributes.items():
        found = difference_of_values(value, other_attributes[name])
        if found:
            return f"<{tag}> {name}: {found}"
    return None


def difference(shown, made):
    """What differs between two pictures, None if nothing."""
    a, b = elements(shown), elements(made)
    if len(a) != len(b):
        return f"{len(a)} and {len(b)} elements"
    pairs = [(x, y) for x, y in zip(a, b, strict=True) if difference_of_elements(x, y)]
    # Lines whose values differ by rounding alone may be drawn in another order.
    left = [y for _, y in pairs]
    for x, y in pairs:
        same = next((z for z in left if difference_of_elements(x, z) is None), None)
        if same is None:
            return difference_of_elements(x, y)
        left.remove(same)
    return None
