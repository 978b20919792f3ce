"""Does what the documents say: writes their files, runs their commands, compares the output (comparison.py) and the
pictures (pictures.py).

In a document, a block whose first line is "# NAME" (or "// NAME"; NAME has an extension, and may be followed by a
colon and a remark) is a file. In a block of language "console" the lines that begin with "$ " are commands, and the
lines after a command are all that it prints; "…" on a line of its own stands for any lines.

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

from comparison import same_text
from pictures import difference

INDET, DATA, *DOCUMENTS = map(pathlib.Path, sys.argv[1:])
del sys.argv[1:]

BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
FILE_NAME = re.compile(r"(?:#|//) ([\w./-]+\.\w+)(?=:|$)", re.MULTILINE)
# The pictures in docs/images, and the file that each of them is after the commands of the document that shows it
# (None: experiment_test.py or a program of bench/ makes it, which takes minutes).
PICTURES = {"delta-R.svg": "delta-R.svg", "mechanism.svg": "mechanism.svg", "yield-curve.svg": "yield-curve.svg", "steps.svg": "steps.svg", "small-ensemble.svg": "experiment/figures/fig07.svg",
            "ensemble-tilt.svg": None, "local-indeterminacy.svg": None, "tilting.svg": None, "sliding-contacts-of-cd2.svg": None}


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
                    self.assertTrue(same_text(content, done.stdout.splitlines()), done.stdout)
        self.assertGreater(commands, 0)
        for name in [name for document in DOCUMENTS for name in pictures_made_in(document)]:
            self.assertTrue((root / name).is_file(), name)
        for shown in {name for document in DOCUMENTS for name in pictures_shown_in(document)}:
            self.assertIn(shown.name, PICTURES)
            if PICTURES[shown.name]:
                self.assertIsNone(difference(shown, root / PICTURES[shown.name]), f"{shown} is out of date")


def pictures_made_in(document):
    """Files that a document says it makes: the argument of savefig, or of -o with the extension of a picture."""
    text = document.read_text()
    return re.findall(r"savefig\(\"([^\"]+)\"", text) + re.findall(r"-o (\S+\.(?:svg|png|pdf))", text)


def pictures_shown_in(document):
    """The pictures of docs/images that a document shows."""
    names = re.findall(r"(?:src=\"|\]\()(\S*images/[\w.-]+)", document.read_text())
    return [document.parent / name for name in names]


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

    def test_every_picture_is_shown_and_made_somewhere(self):
        root = pathlib.Path(__file__).parents[2]
        shown = {path.name for document in [root / "README.md", *root.glob("docs/*.md")]
                 for path in pictures_shown_in(document)}
        self.assertEqual(shown, {path.name for path in root.glob("docs/images/*")})
        self.assertEqual(shown, PICTURES.keys())


if __name__ == "__main__":
    unittest.main(verbosity=0)
