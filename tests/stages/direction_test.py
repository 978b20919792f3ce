"""Each stage sees the headers of the stages it is built on, and no others.

Arguments: compile_commands.json of the build, the folder libindet.
"""

import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

LIBRARY, COMMANDS = (pathlib.Path(sys.argv.pop()) for _ in range(2))

# From first to last; a stage may see only what stands before it.
ORDER = ["base", "statistics", "packing", "exact", "contact", "nullspace", "lp", "pivoting", "polytope", "range", "sampling", "verify", "io",
         "report"]
HEADERS = {"base": "error.h", "statistics": "bootstrap.h", "packing": "packing.h", "exact": "contact_problem.h", "contact": "contact_matrix.h", "nullspace": "null_space.h",
           "lp": "lp_solver.h", "pivoting": "tableau.h", "polytope": "force_polytope.h", "range": "analyze.h",
           "sampling": "convex_body.h", "verify": "verify.h",
           "io": "packing_file.h", "report": "packing_picture.h", "sim": "world.h",
           "ensemble": "plan.h"}


def compile_command(stage):
    """The command that compiles some source of the stage, without its source and output."""
    for entry in json.loads(COMMANDS.read_text()):
        if f"CMakeFiles/indet_{stage}.dir/" not in entry["command"]:
            continue
        words = [word for word in shlex.split(entry["command"]) if not word.endswith("ccache")]
        output = words.index("-o")
        del words[output:output + 2]
        words.remove("-c")
        words.remove(entry["file"])
        return words, entry["directory"]
    raise LookupError(stage)


def compile_text(stage, text, *options):
    command, directory = compile_command(stage)
    with tempfile.NamedTemporaryFile("w", suffix=".cc") as source:
        source.write(text)
        source.flush()
        return subprocess.run([*command, *options, source.name], cwd=directory, capture_output=True, text=True,
                              timeout=120, check=False)


def visible_from(stage):
    """The stages whose headers a source of this stage can include."""
    lines = [f'#if __has_include("indet/{other}/{header}")\nvisible {other}\n#endif'
             for other, header in HEADERS.items()]
    done = compile_text(stage, "\n".join(lines) + "\n", "-E", "-P")
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    return {line.split()[1] for line in done.stdout.splitlines() if line.startswith("visible ")}


class Direction(unittest.TestCase):
    def test_a_contact_source_that_includes_a_range_header_does_not_compile(self):
        wrong = compile_text("contact", '#include "indet/range/analyze.h"\n', "-fsyntax-only")
        self.assertNotEqual(wrong.returncode, 0)
        self.assertIn("indet/range/analyze.h: No such file or directory", wrong.stderr)

    def test_a_contact_source_that_includes_an_error_header_compiles(self):
        right = compile_text("contact", '#include "indet/base/error.h"\n', "-fsyntax-only")
        self.assertEqual(right.returncode, 0, right.stderr)

    def test_each_stage_sees_only_what_comes_before(self):
        for number, stage in enumerate(ORDER):
            with self.subTest(stage):
                visible = visible_from(stage)
                self.assertIn(stage, visible)
                self.assertLessEqual(visible, set(ORDER[:number + 1]))

    def test_simulators_see_the_packing_type_alone(self):
        self.assertEqual(visible_from("sim"), {"base", "packing", "sim"})
        for stage in ORDER:
            self.assertFalse({"sim", "ensemble"} & visible_from(stage))

    def test_the_verifier_includes_nothing_of_the_solver(self):
        sources = sorted((LIBRARY / "verify").glob("*.*"))
        included = {stage for path in sources for stage in re.findall(r'#include "indet/(\w+)/', path.read_text())}
        self.assertIn("packing", included)
        self.assertFalse(included & {"contact", "nullspace", "lp", "pivoting", "polytope"})


if __name__ == "__main__":
    unittest.main(verbosity=0)
