"""The bash completion and the man pages know every subcommand and option.

Arguments: the indet executable, the folder of the build.
"""

import pathlib
import re
import shlex
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

BUILD = ""


def options_in(text):
    return set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", text))


def options_of(help_text):
    """Those that the help defines, not those that it mentions."""
    return set(re.findall(r"(?m)^  (?:-\w,)?(--[a-z][a-z-]*)", help_text))


def subcommands(help_text):
    return set(re.findall(r"(?m)^  (\w+) ", help_text.partition("Subcommands:")[2].partition("\n\n")[0]))


class Completion(program.ProgramTest):
    def complete(self, *words):
        """What bash offers for the last of the words."""
        script = ('source <("$0" completion bash); COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _indet; '
                  'printf "%s\\n" "${COMPREPLY[@]}"')
        done = subprocess.run(["bash", "-c", script, program.INDET, *words], cwd=self.folder, capture_output=True,
                              text=True, timeout=60, check=True)
        self.assertEqual(done.stderr, "")
        return set(done.stdout.splitlines())

    def test_subcommands(self):
        known = subcommands(self.run_indet("--help").stdout)
        self.assertLess({"import", "analyze", "inspect", "verify", "export"}, known)
        self.assertLessEqual(known, self.complete("indet", ""))
        self.assertEqual(self.complete("indet", "ex"), {"export"})

    def test_every_option_of_every_subcommand(self):
        shared = options_of(self.run_indet("--help").stdout)
        for name in subcommands(self.run_indet("--help").stdout):
            shown = self.run_indet(name, "--help").stdout
            own = options_of(shown)
            for nested in subcommands(shown):
                own |= options_of(self.run_indet(name, nested, "--help").stdout)
            self.assertEqual(self.complete("indet", name, "--"), own | shared, name)

    def test_options_after_global_ones(self):
        self.assertEqual(self.complete("indet", "--quiet", "analyze", "p.h5", "--form"), {"--formulation"})

    def test_files(self):
        (self.folder / "packing one.h5").write_text("")
        self.assertEqual(self.complete("indet", "analyze", "pack"), {"packing one.h5"})

    def test_values_of_options(self):
        self.assertEqual(self.complete("indet", "analyze", "--formulation", ""), {"auto", "nullspace", "dual", "edge"})
        self.assertEqual(self.complete("indet", "analyze", "--method", "p"), {"pivoting-paper", "pivoting-tableau"})
        self.assertEqual(self.complete("indet", "compare", "--accuracy", ""), {"fast", "standard"})
        for command in ("analyze", "compare"):
            self.assertEqual(self.complete("indet", command, "--neighbour", ""), {"first", "best", "random"})
            self.assertEqual(self.complete("indet", command, "--start", ""), {"common", "minimum"})
        self.assertEqual(self.complete("indet", "export", "p.h5", "--format", "s"), {"svg"})
        self.assertEqual(self.complete("indet", "completion", ""), {"bash"})
        self.assertEqual(self.complete("indet", "submit", "--engine", ""), {"slurm", "parallel"})
        self.assertEqual(self.complete("indet", "submit", "ensemble", "--preset", "s"), {"stiff"})

    def test_bash_completes_indet_with_it(self):
        line = f"source <({shlex.quote(program.INDET)} completion bash); complete -p indet"
        done = subprocess.run(["bash", "-c", line], capture_output=True, text=True, timeout=60, check=True)
        self.assertIn("-F _indet", done.stdout)


class Manual(program.ProgramTest):
    def page(self, name):
        page = self.folder / "share/man/man1" / f"{name}.1"
        self.assertTrue(page.is_file(), page)
        return re.sub(r"\\f[BIPR]", " ", page.read_text().replace("\\-", "-"))

    def test_every_page_mentions_every_option(self):
        if not shutil.which("help2man"):
            self.skipTest("help2man is not installed")
        subprocess.run(["cmake", "--install", BUILD, "--component", "manuals", "--prefix", self.folder],
                       capture_output=True, timeout=120, check=True)
        self.assertTrue((self.folder / "share/bash-completion/completions/indet").is_file())
        names = subcommands(self.run_indet("--help").stdout)
        for name in ["", *sorted(names)]:
            page = self.page(f"indet-{name}" if name else "indet")
            options = options_of(self.run_indet(*([name] if name else []), "--help").stdout)
            self.assertGreaterEqual(len(options), 1)
            self.assertLessEqual(options, options_in(page), name)
            text = " ".join(page.split())
            self.assertIn("4 no contact forces balance the load", text)
            if name:
                does = " ".join(self.run_indet(name, "--help").stdout.partition("\nUsage:")[0].split())
                self.assertIn(f"{name} - {does} ", text)


if __name__ == "__main__":
    program.main("BUILD")
