"""Whether what a document shows is what the program prints.

Words are compared exactly, and numbers by what a reader sees:

- a number is the same if it differs by no more than one unit of the last digit that is shown;
- numbers that are written as powers of ten and lie below 1e-6 are residuals at the level of rounding, which differs
  between processors and libraries: they are the same within a factor of 30, and 0 is the same as anything below 1e-14;
- numbers that a random walk found are the same within a factor of 2, for the walk's coordinates hang on the rounding
  of a decomposition; which force it knows least is not compared;
- times ("2.5 s"), digests and revisions are not compared;
- every other number is a count or a result, and must be as it is shown.
"""

import re

NUMBER = re.compile(r"(?<![A-Za-z_])[-+]?(?:inf|\d+(?:\.\d+)?(?:e[-+]?\d+)?)")
# What differs from run to run or from build to build.
VARIES = re.compile(r"\b\d+(?:\.\d+)? s\b|\b[0-9a-f]{64}\b|\b[0-9a-f]{12}(?:-dirty)?\b")
# Lines that tell what a random walk found, and the name of a force in them.
RANDOM = re.compile(r"radius r = |norm ‖F‖: |converged after \d+ sweeps|simulated state among the samples: |"
                    r"size: largest ball|natural logarithm of the volume| +standard errors: r ")
# Rows of `limit --steps`, of whose ten columns the seventh and the ninth (r, width) are such numbers.
STEP = re.compile(r" +(?:just before|[-\d.]+°)(?: +\S+){9}$")
FORCE = re.compile(r"(?:[RT] of contact \d+|‖F‖)$")
ROUNDING = 1e-6
FACTOR = 30
NOTHING = 1e-14


def pieces(line):
    """A line as words and numbers in turn; what varies becomes "#"."""
    line = VARIES.sub("#", line)
    result = []
    position = 0
    for match in NUMBER.finditer(line):
        result.append(" ".join(line[position:match.start()].split()))
        result.append(match.group(0))
        position = match.end()
    return [*result, " ".join(line[position:].split())]


def unit_of(number):
    """One unit of the last digit of a number as it is written; 0 for whole numbers, which are exact."""
    mantissa, _, exponent = number.lower().partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 10.0 ** (int(exponent or 0) - decimals) if decimals else 0.0


def is_rounding(number):
    """Whether a number is a power of ten below the level of rounding; a typed 1e-08 is a constant and exact."""
    return "e" in number.lower() and "." in number and abs(float(number)) < ROUNDING


def same_number(shown, printed):
    if shown == printed:
        return True
    try:
        a, b = float(shown), float(printed)
    except ValueError:
        return False
    if is_rounding(shown) and is_rounding(printed):
        low, high = sorted((abs(a), abs(b)))
        return a * b >= 0 and (high <= FACTOR * low or (low == 0 and high < NOTHING))
    return abs(a - b) <= 1.01 * unit_of(shown)


def same_random_number(shown, printed):
    a, b = float(shown), float(printed)
    return a * b > 0 and 0.5 <= a / b <= 2


def same_line(shown, printed):
    is_random = RANDOM.match(shown) and RANDOM.match(printed)
    if is_random:
        shown, printed = FORCE.sub("#", shown), FORCE.sub("#", printed)
    a, b = pieces(shown), pieces(printed)
    if len(a) != len(b) or a[0::2] != b[0::2]:
        return False
    same = [same_random_number if is_random else same_number] * (len(a) // 2)
    if STEP.match(shown) and STEP.match(printed):
        same[-4] = same[-2] = same_random_number
    return all(compare(x, y) for compare, x, y in zip(same, a[1::2], b[1::2], strict=True))


def same_text(shown, printed):
    """Both are lists of lines; "…" alone in `shown` stands for any lines."""
    if not shown:
        return not printed
    if shown[0].strip() == "…":
        return any(same_text(shown[1:], printed[skip:]) for skip in range(len(printed) + 1))
    return bool(printed) and same_line(shown[0], printed[0]) and same_text(shown[1:], printed[1:])
