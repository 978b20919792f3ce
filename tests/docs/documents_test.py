"""Does what the documents say: writes their files, runs their commands, compares the output.

In a document, a block whose first line is "# NAME" (or "// NAME"; NAME has an extension, and may be followed by a
colon and a remark) is a file. In a block of language "console" the lines that begin with "$ " are commands, and the
lines after a command are its output. Compared are words exactly and numbers to the digits that stand there; "…" on a
line of its own stands for any lines. What differs between machines or libraries is compared as "some number":
residuals (anything below 1e-6), times, pivots, digests, and what a random walk found, whose coordinates hang on the
rounding of a decomposition.

Arguments: the indet executable, the folder with the data of the tests, then documents. Those given in one run share a
folder, in their order.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

INDET, DATA, *DOCUMENTS = map(pathlib.Path, sys.argv[1:])
del sys.argv[1:]

BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
FILE_NAME = re.compile(r"(?:#|//) ([\w./-]+\.\w+)(?=:|$)", re.MULTILINE)
NUMBER = re.compile(r"[-+]?(?:inf|\d+(?:\.\d+)?(?:e[-+]?\d+)?)")
VARIES = re.compile(r"\d+ linear programs, \d+ pivots|\d+ extremal states|\d+ objectives have only one|[\d.]+ s\b|"
                    r"\b[0-9a-f]{64}\b|\b[0-9a-f]{12}(-dirty)?\b|\d+ checks")

RANDOM = re.compile(r"uniform: r = |converged after \d+ sweeps|simulated state: .* from the centre|inscribed ball: |"
                    r"log volume: ")


def pieces(line):
    """A line as words and numbers; those that vary from machine to machine become "#"."""
    if RANDOM.match(line):
        line = NUMBER.sub("#", line).replace("T of contact", "R of contact")
    line = VARIES.sub(lambda match: NUMBER.sub("#", match.group(0)) if " " in match.group(0) else "#", line)
    result = []
    position = 0
    for match in NUMBER.finditer(line):
        result.append(" ".join(line[position:match.start()].split()))
        result.append(match.group(0))
        position = match.end()
    return [*result, " ".join(line[position:].split())]


def same_piece(expected, found):
    if expected == found:
        return True
    try:
        a, b = float(expected), float(found)
    except ValueError:
        return False
    if abs(a) < 1e-6 and abs(b) < 1e-6:
        return True
    mantissa = expected.lower().partition("e")[0]
    decimals = len(mantissa.partition(".")[2])
    unit = 10.0 ** (int(expected.lower().partition("e")[2] or 0) - decimals) if decimals else 0
    return abs(a - b) <= 1.01 * unit


def same_line(expected, found):
    a, b = pieces(expected), pieces(found)
    return len(a) == len(b) and all(map(same_piece, a, b))


def same_text(expected, found):
    """Both are lists of lines; "…" alone in `expected` stands for any lines."""
    if not expected:
        return not found
    if expected[0].strip() == "…":
        return any(same_text(expected[1:], found[skip:]) for skip in range(len(found) + 1))
    return bool(found) and same_line(expected[0], found[0]) and same_text(expected[1:], found[1:])


def steps_of(text):
    """The blocks of a document, as ("file", name, text) and ("command", line, output)."""
    for language, body in BLOCK.findall(text):
        name = FILE_NAME.match(body)
        if language == "console":
            for part in re.split(r"^\$ ", body, flags=re.MULTILINE)[1:]:
                command, _, output = re.sub(r"\\\n", "", part).partition("\n")
                yield "command", command, output.splitlines()
        elif name:
            yield "file", name.group(1), body


class Comparison(unittest.TestCase):
    """The comparison must be able to fail."""

    def test_same(self):
        for expected, found in [("δR  17.23 mg", "δR 17.23 mg"), ("worst 2.0e-15 primal", "worst 0.0e+00 primal"),
                                ("1573 linear programs, 59327 pivots (dual)", "9 linear programs, 8 pivots (dual)"),
                                ("written to r.h5 (30.41 s)", "written to r.h5 (2.00 s)"), ("0.2062", "0.2061")]:
            self.assertTrue(same_line(expected, found), expected)
        self.assertTrue(same_text(["a", "…", "d"], ["a", "b", "c", "d"]))

    def test_different(self):
        for expected, found in [("δR  17.23 mg", "δT  17.23 mg"), ("rank 657", "rank 658"), ("0.2062", "0.2064"),
                                ("worst 2.0e-15 primal", "worst 2.0e-3 primal"), ("1504 certified", "certified"),
                                ("max inf", "max 3"), ("17.23", "-17.23")]:
            self.assertFalse(same_line(expected, found), expected)
        self.assertFalse(same_text(["a", "…", "d"], ["a", "b", "c"]))
        self.assertFalse(same_text(["a"], ["a", "b"]))


class Documents(unittest.TestCase):
    def test_everything_they_say(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        root = pathlib.Path(folder.name)
        (root / "tests").mkdir()
        (root / "tests/data").symlink_to(DATA)
        tools = root / ".tools"
        tools.mkdir()
        (tools / "indet").symlink_to(INDET)
        (tools / "python3").symlink_to(sys.executable)
        environment = os.environ | {"PATH": f"{tools}:{os.environ['PATH']}", "MPLBACKEND": "Agg", "COLUMNS": "120",
                                    "MPLCONFIGDIR": str(tools)}
        commands = 0
        for document in DOCUMENTS:
            for kind, name, content in steps_of(document.read_text()):
                if kind == "file":
                    (root / name).parent.mkdir(parents=True, exist_ok=True)
                    (root / name).write_text(content)
                    continue
                commands += 1
                with self.subTest(document=document.name, command=name):
                    done = subprocess.run(["bash", "-c", name], cwd=root, env=environment, text=True, timeout=300,
                                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
                    # A status other than 0 stands in the text because the command prints "$?".
                    self.assertTrue(done.returncode == 0 or "$?" in name, done.stdout)
                    if content:
                        self.assertTrue(same_text(content, done.stdout.splitlines()), done.stdout)
        self.assertGreater(commands, 0)
        for name in PICTURES:
            self.assertTrue((root / name).is_file(), name)
        for shown in DOCUMENTS[0].parent.glob("docs/images/*.svg"):
            if (root / shown.name).is_file():  # others are of experiments that take minutes
                self.assertEqual(strokes(shown), strokes(root / shown.name), f"{shown} is out of date")


def strokes(picture):
    """The colours of the lines of a picture, to three digits."""
    colours = re.findall(r"stroke:rgb\(([\d.]+)%,([\d.]+)%,([\d.]+)%\)", picture.read_text())
    return [tuple(round(float(part) / 100, 3) for part in colour) for colour in colours]


def pictures_in(document):
    """Files that a document says it makes: the argument of savefig, or of -o with the extension of a picture."""
    text = document.read_text()
    return re.findall(r"savefig\(\"([^\"]+)\"", text) + re.findall(r"-o (\S+\.(?:svg|png|pdf))", text)


PICTURES = [name for document in DOCUMENTS for name in pictures_in(document)]


class Links(unittest.TestCase):
    def test_every_relative_link_leads_somewhere(self):
        root = pathlib.Path(__file__).parents[2]
        documents = [root / "README.md", *root.glob("docs/**/*.md")]
        self.assertGreater(len(documents), 8)
        for document in documents:
            text = document.read_text()
            targets = re.findall(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)", text) + re.findall(r'src="([^":]+)"', text)
            for target in targets:
                self.assertTrue((document.parent / target).exists(), f"{document}: {target}")


if __name__ == "__main__":
    unittest.main(verbosity=0)
