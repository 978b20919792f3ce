"""Numbers are checked where they are read, and named where they are refused.

Argument: the indet executable.
"""

import concurrent.futures
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program

NO_NUMBERS = ("nan", "inf", "-1e400", "1e400", "99999999999999999999", "", "1x")


class Options(program.ProgramTest):
    def numeric_options(self):
        """(subcommand, option, type, whether it takes two numbers), as the help shows them."""
        commands = re.findall(r"^  ([a-z]+)  ", self.run_indet("--help").stdout, re.MULTILINE)
        self.assertGreater(len(commands), 10)
        for command in [None, *commands]:
            text = self.run_indet(*([command] if command else []), "--help").stdout
            for name, kind, two in re.findall(r"^  (?:-\w,)?(--[\w-]+) (INT|FLOAT)\b( x 2)?", text, re.MULTILINE):
                yield command, name, kind, bool(two)

    def test_every_option_refuses_what_is_no_number(self):
        options = list(self.numeric_options())
        self.assertGreater(len(options), 50)
        # A real number may be as large as 1e20, if nothing else forbids it.
        runs = [(command, name, value) for command, name, kind, two in options
                for value in ([f"{text},1" for text in NO_NUMBERS] if two else NO_NUMBERS)
                if kind == "INT" or not value.startswith("9")]

        def run(case):
            command, name, value = case
            arguments = [f"{name}={value}", "inspect"] if command is None else [command, f"{name}={value}"]
            return program.run([program.INDET, *arguments], self.folder, {"OPENBLAS_NUM_THREADS": "1"})

        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            for case, done in zip(runs, pool.map(run, runs), strict=True):
                with self.subTest(case):
                    self.assertEqual(done.returncode, 2, done.stderr)
                    self.assertRegex(done.stderr, rf"^indet: {case[1]}: ")
        self.assertEqual(self.files(), [])

    def test_what_does_not_fit(self):
        for option, value, message in (("--disks", "4294967301", "4294967301 does not fit into 32 bits"),
                                       ("--seed", "9223372036854775808", "is not from 0 to 9223372036854775807"),
                                       ("--seed", "-1", "is not from 0 to 9223372036854775807"),
                                       ("--residual", "1e400", "is not a number that a double can hold")):
            done = self.run_indet("simulate", "--protocol", "cd1", "-o", "s.h5", f"{option}={value}", status=2)
            self.assertTrue(done.stderr.startswith(f"indet: {option}: "), done.stderr)
            self.assertIn(message, done.stderr)
        for option, value, message in (("--gravity", "1e-200,0", "gravity must be 0, or from 1e-60 to 1e+60"),
                                       ("--gravity", "1e200,0", "gravity must be 0, or from 1e-60 to 1e+60"),
                                       ("--radius", "1,1e200", "radius must be from 1e-60 to 1e+60"),
                                       ("--residual", "-1", "residual must be positive")):
            done = self.run_indet("simulate", "--protocol", "cd1", "-o", "s.h5", f"{option}={value}", status=3)
            self.assertIn(message, done.stderr)
        self.assertEqual(self.files(), [])

    def test_decimal_notation(self):
        self.run_indet("simulate", "--protocol", "cd1", "--disks", "010", "--seed", "+3", "--time-limit", "0.01",
                       "-o", "s.h5", status=5)
        config = self.config_of("s.h5")
        self.assertIn("disks = 10\n", config)
        self.assertIn("seed = 3\n", config)

    def test_numbers_of_a_configuration(self):
        for key, value in (("dt", "nan"), ("residual", "inf"), ("disks", "4294967301"), ("seed", "-1"), ("mu", '"1x"')):
            (self.folder / "c.toml").write_text(f"[simulate]\n{key} = {value}\n")
            done = self.run_indet("--config", "c.toml", "simulate", "--protocol", "cd1", "-o", "s.h5", status=3)
            self.assertTrue(done.stderr.startswith(f"indet: c.toml:2: {key}: "), done.stderr)


class Scenes(program.ProgramTest):
    def test_every_key_refuses_what_is_no_number(self):
        self.run_indet("simulate", "--protocol", "cd1", "--disks", "2", "--time-limit", "0.01", "-o", "s.h5", status=5)
        lines = self.config_of("s.h5", "parameters").split("[simulator]")[0].splitlines()
        keys = [line.split(" = ", 1) for line in lines if re.search(r" = .*\d", line)]
        numeric = {name for name, _ in keys}
        self.assertLessEqual({"disks", "columns", "seed", "radius", "density", "friction", "gravity", "width", "height",
                              "force_unit", "funnel_angle", "jitter"}, numeric)
        for name, value in keys:
            whole = name in ("disks", "columns", "seed")
            bad = ["nan", "inf", "1e400", '"1"'] + (["4294967301", "-1", "0.5", "99999999999999999999"] if whole else [])
            for number in bad:
                if (name, number) == ("seed", "4294967301"):
                    continue
                with self.subTest(key=name, number=number):
                    text = re.sub(r"-?\d[\d.e+-]*", number, value, count=1)
                    (self.folder / "scene.toml").write_text(f"{name} = {text}\n")
                    done = self.run_indet("simulate", "--protocol", "cd1", "--scene", "scene.toml", "-o", "t.h5", status=3)
                    self.assertTrue(done.stderr.startswith("indet: scene.toml:1: "), done.stderr)
                    if number not in ("1e400", "99999999999999999999"):  # TOML itself has none
                        self.assertIn(name, done.stderr)


if __name__ == "__main__":
    program.main()
