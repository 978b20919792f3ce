"""Makes a report and opens it in headless Chromium: nothing is fetched, nothing complains, every figure shows.

Arguments: the indet executable, chromium.
"""

import csv
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

CHROMIUM = ""
# 40 samples, because fewer are not compared with the uniform distribution.
TINY = ["--seeds", "2", "--disks", "12", "--samples", "40"]
FIGURES = ["fig03", "fig06a", "fig06b", "fig07", "fig08", "fig08-solver", "fig09", "fig10", "fig11", "fig12", "fig12-solver", "fig13",
           "limits-tilt", "limits-load", "limits-dimension", "uniform-r", "uniform-forces", "uniform-places", "uniform-tests", "uniform-states", "uniform-friction"]
PROBE = """<script>addEventListener("load", () => {
  const seen = [...document.querySelectorAll("figure svg")].map(svg => {
    const box = svg.getBoundingClientRect();
    return box.width > 100 && box.height > 100 && svg.querySelectorAll("path,polygon,rect,circle,use").length > 5;
  });
  document.body.dataset.figures = seen.length;
  document.body.dataset.hidden = seen.filter(x => !x).length;
  document.body.dataset.fetched = performance.getEntriesByType("resource").filter(e => !e.name.startsWith("data:")).length;
});</script></body>"""


class ReportTest(program.ProgramTest):
    @classmethod
    def setUpClass(cls):
        """Makes the report that most tests look at, once."""
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        for command in (["ensemble", *TINY, "-o", "e"], ["report", "e"]):
            done = program.run([program.INDET, *command], folder.name)
            assert done.returncode == 0, done.stderr
        cls.made = pathlib.Path(folder.name) / "e"

    def make(self):
        return pathlib.Path(shutil.copytree(self.made, self.folder / "e"))

    def test_it_opens_in_a_browser_that_has_no_network(self):
        folder = self.make()
        text = (folder / "report.html").read_text()
        for address in re.findall(r"https?://[^\s\"'<>)]+", text):
            self.assertTrue(address.startswith("http://www.w3.org/"), address)
        self.assertEqual(len(re.findall(r"\bid=[\"']([^\"']+)", text)), len(set(re.findall(r"\bid=[\"']([^\"']+)", text))))
        probed = folder / "probed.html"
        probed.write_text(text.replace("</body>", PROBE))
        done = subprocess.run([CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr",
                               f"--user-data-dir={self.folder}/profile", "--dump-dom", probed.as_uri()],
                              capture_output=True, text=True, timeout=120, check=True)
        self.assertNotIn("CONSOLE", done.stderr)
        body = re.search(r"<body([^>]*)>", done.stdout).group(1)
        self.assertIn(f'data-figures="{len(FIGURES) + 3}"', body)
        self.assertIn('data-hidden="0"', body)
        self.assertIn('data-fetched="0"', body)

    def test_what_is_not_known_is_no_number(self):
        self.run_indet("ensemble", "--seeds", "1", "--disks", "12", "--samples", "40", "-o", "one")
        self.run_indet("ensemble", "--seeds", "2", "--disks", "12", "--protocols", "cd1", "--samples", "0", "--uniform-seeds",
                       "0", "--smallest-distances", "-o", "simulated")
        self.run_indet("ensemble", "--seeds", "2", "--disks", "12", "--protocols", "md1", "--samples", "0", "--uniform-seeds",
                       "0", "-o", "springs")
        self.write("p", program.pyramid())
        self.run_indet("import", "--format", "csv", "p", "-o", "p.h5")
        self.run_indet("ensemble", "p.h5", "-o", "file", "--smallest-distances")
        for folder in ("one", "simulated", "springs", "file"):
            self.run_indet("report", folder)
            page = (self.folder / folder / "report.html").read_text()
            text = re.sub(r"<[^>]*>", " ", re.sub(r"<(svg|style).*?</\1>", "", page, flags=re.DOTALL))
            for wrong in (r"\bnan\b", r"\binf\b", r"\b1 values\b", r"– (mg|%)", r"±\s*(mg|%|\.)"):
                found = re.search(rf".{{0,80}}{wrong}.{{0,30}}", text)
                self.assertIsNone(found, f"{folder}: {found and found.group(0)}")
            for path in (self.folder / folder / "figures").glob("*.csv"):
                if path.name in ("comparison.csv", "uniform.csv"):
                    self.assertNotRegex(path.read_text(), r"\bnan\b")

    def test_every_figure_is_there_as_vectors_numbers_and_script(self):
        folder = self.make() / "figures"
        for name in FIGURES:
            self.assertTrue((folder / f"{name}.pdf").read_bytes().startswith(b"%PDF"), name)
            with open(folder / f"{name}.csv", newline="") as file:
                rows = list(csv.reader(file))
            self.assertGreater(len(rows), 1)
            self.assertEqual({len(row) for row in rows}, {len(rows[0])})
            before = (folder / f"{name}.svg").read_text()
            (folder / f"{name}.svg").unlink()
            subprocess.run(["gnuplot", f"{name}.gp"], cwd=folder, check=True, capture_output=True)
            self.assertEqual((folder / f"{name}.svg").read_text(), before)

    def test_the_table_beside_the_paper_is_there_as_numbers(self):
        with open(self.make() / "figures/comparison.csv", newline="") as file:
            rows = {row["quantity"]: row for row in csv.DictReader(file)}
        self.assertEqual(rows["sliding contacts Ms ≤ 2M − 3N (Fig. 6b)"]["here"], "8 of 8")
        self.assertIn("33 ± 1.4 mg", rows["r of perturb-and-resolve [38], CD-1"]["paper"])
        # 12 disks are not the paper's 95.
        self.assertEqual({row["verdict"] for row in rows.values()}, {""})
        text = (self.folder / "e/report.html").read_text()
        self.assertIn("for N = 95 and μ = 0.3; here N = 12 and μ = 0.3. Hence there is no verdict.", text)
        self.assertNotIn('class="agrees"', text)

    def test_uniform_sampling_is_there_as_a_table_with_the_numbers_of_the_ensemble(self):
        folder = self.make()
        with open(folder / "figures/uniform.csv", newline="") as file:
            header, *rows = csv.reader(file)
        self.assertEqual(header, ["", "CD-1", "CD-2", "MD-1", "MD-2", "if equal"])
        shown = {name: values for name, *values in rows}
        self.assertEqual(shown["the same in the paper (mg)"], ["33 ± 1.4", "34 ± 1.3", "41 ± 1.7", "40 ± 1.5", ""])
        with h5py.File(folder / "ensemble.h5") as file:
            runs = {name: column[()] for name, column in file["table/runs"].items()}
        for i, protocol in enumerate((b"cd1", b"cd2", b"md1", b"md2")):
            mine = runs["protocol"] == protocol
            done = mine & (runs["uniform"] == b"converged")
            self.assertEqual(shown["packings sampled uniformly, converged"][i], f"{done.sum()} of {mine.sum()}")
            for name, column, digits in (("r of the uniform distribution (mg)", "uniform_r", 1),
                                         ("ratio of both", "bias_ratio", 2)):
                values = runs[column][mine]
                values = values[~np.isnan(values)]
                mean, *error = shown[name][i].split(" ± ")
                self.assertEqual(mean, f"{values.mean():.{digits}f}")
                if len(values) > 1:
                    self.assertEqual(error, [f"{values.std(ddof=1) / len(values) ** 0.5:.{digits}f}"])
        text = (folder / "report.html").read_text()
        self.assertIn("Are all contact states equally likely?", text)
        self.assertIn("<td>the same in the paper (mg)</td><td>33 ± 1.4</td>", text)

    def test_without_uniform_sampling_nothing_is_said_about_it(self):
        self.run_indet("ensemble", *TINY[:-1], "5", "--uniform-seeds", "0", "-o", "e")
        self.run_indet("report", "e")
        self.assertNotIn("equally likely", (self.folder / "e/report.html").read_text())
        self.assertEqual(list((self.folder / "e/figures").glob("uniform*")), [])

    def test_two_contacts_follow_the_formulas(self):
        text = (self.make() / "report.html").read_text()
        self.assertLess(float(re.search(r"difference from the formulas: ([\d.e+-]+)\.", text).group(1)), 1e-9)

    def test_a_folder_without_an_ensemble_is_refused(self):
        self.assertIn("has no ensemble.h5", self.run_indet("report", ".", status=3).stderr)


if __name__ == "__main__":
    program.main("CHROMIUM")
