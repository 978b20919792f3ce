"""Runs inspect and export as a user does (arguments: commands.py)."""

import json
import os
import shutil
import unittest
import xml.etree.ElementTree

import h5py
import numpy as np

from commands import SAMPLES, CommandTest


class Inspect(CommandTest):
    def test_a_packing_fits_one_screen(self):
        self.import_lammps("--friction", "0.3")
        text = self.run_indet("inspect", "p.h5").stdout
        self.assertLess(len(text.splitlines()), 25)
        for part in ["import lammps", "220, radius", "376 (2M − 3N = 92)", "wr, wx, wy", "indet analyze p.h5"]:
            self.assertIn(part, text)

    def test_ranges(self):
        with h5py.File(f"{SAMPLES}/ranges.h5") as file:
            digest = file["ranges"].attrs["sha256"]
        text = self.run_indet("inspect", f"{SAMPLES}/ranges.h5").stdout
        self.assertIn(digest, text)
        self.assertLess(len(text.splitlines()), 25 + 4)  # a screen, and the four reactions
        report = json.loads(self.run_indet("inspect", f"{SAMPLES}/ranges.h5", "--json").stdout)
        self.assertEqual(report["ranges_sha256"], digest)
        self.assertTrue(report["intact"])
        self.assertEqual(report["ranges"]["status"], "unbounded")
        self.assertEqual(report["ranges"]["certified"], 12)

    def changed(self, change):
        shutil.copy(f"{SAMPLES}/ranges.h5", self.folder / "r.h5")
        with h5py.File(self.folder / "r.h5", "r+") as file:
            change(file)

    def test_any_changed_number_is_noticed(self):
        def set_item(path, index, value):
            def change(file):
                file[path][index] = value
            return change

        def set_attribute(path, name, value):
            def change(file):
                file[path].attrs.modify(name, value)
            return change

        for change in [set_item("ranges/R_min", 2, 1.25), set_item("extremal/states", (3, 4), 0.5),
                       set_item("ranges/unique", (1, 1), 0), set_item("particles/disks/angle", 0, 1e-300),
                       set_item("contacts/R", 0, 9), set_attribute("equilibrium", "nullity", 5)]:
            self.changed(change)
            report = json.loads(self.run_indet("inspect", "r.h5", "--json").stdout)
            self.assertFalse(report["intact"])
            self.assertIn("DIFFERS", self.run_indet("inspect", "r.h5").stdout)

    def test_files_that_were_tampered_with_are_refused(self):
        def replace(path, **dataset):
            def change(file):
                del file[path]
                file.create_dataset(path, **dataset)
            return change

        def link(path, target):
            def change(file):
                del file[path]
                file[path] = target
            return change

        def external(file):
            del file["ranges/lower"]
            (self.folder / "secret").write_bytes(bytes(160))
            file.create_dataset("ranges/lower", shape=(5, 4), dtype="f8", external=[("secret", 0, 160)])

        def virtual(file):
            del file["ranges/lower"]
            layout = h5py.VirtualLayout(shape=(5, 4), dtype="f8")
            layout[:] = h5py.VirtualSource("other.h5", "x", shape=(5, 4))
            file.create_virtual_dataset("ranges/lower", layout)

        for change, message in [
                (replace("contacts/mu", shape=(5,), dtype="f4", data=np.zeros(5)), None),
                (lambda f: f.__delitem__("contacts/mu"), "/contacts/mu: is missing"),
                (replace("contacts/mu", data=np.zeros(6)), "/contacts/mu: has shape [6] instead of [5]"),
                (replace("contacts/mu", data=np.zeros(5, "i4")), "/contacts/mu: must hold floating-point numbers"),
                (replace("contacts/mu", data=np.full(5, -1.0)), "contact 0: mu must not be negative"),
                (replace("particles/disks/id", shape=(10**12,), dtype="i4", chunks=(1024,)),
                 "/particles/disks/id: announces 4000000000000 bytes"),
                (replace("particles/disks/id", shape=(2**40, 2**40), dtype="i4", chunks=(2**10, 2**10)), "rank 2"),
                (replace("extremal/states", shape=(2**31, 10), dtype="f8"), "/extremal/states: announces"),
                (replace("extremal/norm", shape=(2**31,), dtype="f8"), "/extremal/norm: has shape [2147483648]"),
                (link("contacts/mu", h5py.SoftLink("/contacts/R")), "/contacts/mu: is a link to elsewhere"),
                (link("contacts/mu", h5py.ExternalLink("other.h5", "/x")), "/contacts/mu: is a link to elsewhere"),
                (external, "/ranges/lower: keeps its data in another file"),
                (virtual, "/ranges/lower: is a virtual dataset"),
                (replace("contacts/mu", data=np.zeros(5), compression="lzf"), "uses filter 32000"),
                (lambda f: f["equilibrium"].attrs.modify("status", "splendid"), "\"splendid\" is unknown"),
                (lambda f: f.attrs.__delitem__("complete"), "was not written to its end"),
                (lambda f: f.attrs.modify("schema_version", [3, 0]), "has version 3 of the format"),
        ]:
            with self.subTest(message):
                self.changed(change)
                if message is None:
                    self.run_indet("inspect", "r.h5")  # another precision is fine
                    continue
                self.assertIn(message, self.run_indet("inspect", "r.h5", status=3).stderr)

    def test_other_files_are_refused(self):
        (self.folder / "text").write_text("no HDF5")
        self.assertIn("cannot be opened as an HDF5 file", self.run_indet("inspect", "text", status=3).stderr)
        self.assertIn("there is no such file", self.run_indet("inspect", "none", status=3).stderr)

    def test_a_read_only_file_can_be_inspected(self):
        shutil.copy(f"{SAMPLES}/ranges.h5", self.folder / "r.h5")
        os.chmod(self.folder / "r.h5", 0o444)
        self.run_indet("inspect", "r.h5")


class Export(CommandTest):
    def elements(self, name):
        root = xml.etree.ElementTree.parse(self.folder / name).getroot()
        self.assertEqual(root.tag, "{http://www.w3.org/2000/svg}svg")
        styles = [path.get("style", "") for path in root.iter("{http://www.w3.org/2000/svg}path")]
        return lambda part: sum(part in style for style in styles)

    def test_a_picture_of_forces(self):
        self.import_lammps("--friction", "0.3")
        self.run_indet("export", "p.h5")
        count = self.elements("p.svg")
        self.assertEqual(count("fill:rgb(93%,93%,93%)"), 220)
        # Contacts, three walls, the legend.
        self.assertEqual(count("stroke:rgb(10%,10%,10%)"), 376 + 3 + 1)

    def test_a_picture_of_delta_R(self):
        self.run_indet("export", f"{SAMPLES}/ranges.h5", "--style", "delta-R", "-o", "d.svg")
        count = self.elements("d.svg")
        self.assertEqual(count("fill:rgb(93%,93%,93%)"), 3)
        self.assertEqual(count("stroke:rgb(99.215686%,90.588235%,14.509804%)"), 1)

    def test_every_format(self):
        for name, magic in [("a.pdf", b"%PDF"), ("a.png", b"\x89PNG"), ("a.svg", b"<?xml"), ("a.csv", b"contact,")]:
            self.run_indet("export", f"{SAMPLES}/ranges.h5", "--state", "max-norm", "-o", name)
            self.assertTrue((self.folder / name).read_bytes().startswith(magic))

    def test_states(self):
        # The row of /extremal/states that each of them is: R of contact 0 is 1000 k + 0.5.
        with h5py.File(f"{SAMPLES}/ranges.h5") as file:
            mg = file["parameters"].attrs["mg"]
        for state, row in [("max-norm", 6), ("state:3", 3), ("R_max:0", 0), ("T_max:4", 2)]:
            self.run_indet("export", f"{SAMPLES}/ranges.h5", "--state", state, "-o", "s.csv")
            line = (self.folder / "s.csv").read_text().splitlines()[1]
            self.assertAlmostEqual(float(line.split(",")[9]), (1000 * row + 0.5) / mg, places=9, msg=state)

    def test_states_that_are_not_there(self):
        for state, message in [("R_max:5", "the contacts are 0 … 4"), ("R_min:0", "there is no extremal state"),
                               ("state:7", "there is no extremal state"), ("R_max:99999999999", "the contacts are")]:
            done = self.run_indet("export", f"{SAMPLES}/ranges.h5", "--state", state, "-o", "s.svg", status=3)
            self.assertIn(message, done.stderr)
        for state in ["best", "N_max:1", "R_max:-1", "R_max:", "state:1.5"]:
            done = self.run_indet("export", f"{SAMPLES}/ranges.h5", "--state", state, "-o", "s.svg", status=2)
            self.assertIn("must be sim, limit, max-norm", done.stderr)
        self.import_lammps("--friction", "0.3")
        done = self.run_indet("export", "p.h5", "--state", "max-norm", status=3)
        self.assertIn("compute them first: indet analyze p.h5", done.stderr)
        done = self.run_indet("export", "p.h5", "--style", "delta-R", status=3)
        self.assertIn("compute them first: indet analyze p.h5", done.stderr)
        done = self.run_indet("export", "p.h5", "-o", "p.gif", status=3)
        self.assertIn("the formats are csv, svg, pdf, png", done.stderr)
        self.assertEqual(self.files(), ["p.h5"])

    def test_a_scene_can_be_imported_again(self):
        self.import_lammps("--friction", "0.3")
        self.run_indet("export", "p.h5", "--format", "csv", "-o", "scene")
        self.run_indet("import", "--format", "csv", "scene", "-o", "q.h5")
        with h5py.File(self.folder / "p.h5") as p, h5py.File(self.folder / "q.h5") as q:
            for group in ["particles", "contacts", "walls"]:
                def check(name, thing, group=group, q=q):
                    if isinstance(thing, h5py.Dataset):
                        np.testing.assert_array_equal(thing[()], q[group][name][()])
                p[group].visititems(check)


if __name__ == "__main__":
    unittest.main(verbosity=0)
