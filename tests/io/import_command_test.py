"""Runs import as a user does (arguments: commands.py)."""

import json
import unittest

import h5py
import numpy as np
import pandas as pd

from commands import CONTACTS, DISKS, WALLS, CommandTest


class Import(CommandTest):
    def test_a_scene_becomes_a_file(self):
        self.write_scene()
        report = json.loads(self.run_indet("import", "--format", "csv", "scene", "-o", "p.h5", "--json").stdout)
        self.assertEqual((report["disks"], report["walls"], report["contacts"]), (2, 1, 3))
        self.assertTrue(report["forces_known"])
        self.assertEqual(report["force_residual"], 0)
        self.assertEqual(report["coulomb_violations"], 0)
        self.assertEqual(report["non_transmitting"], 1)
        self.assertEqual(self.files(), ["p.h5", "scene"])

    def test_bad_input_ends_with_status_3_and_no_file(self):
        for part, text, message in [
                ("disks_csv", DISKS + "2,nan,1,1,1\n", "scene/disks.csv:4: x must be a finite number"),
                ("disks_csv", DISKS + "2,4,1,0,1\n", "scene/disks.csv:4: radius must be positive"),
                ("disks_csv", DISKS + "2,4,1,1,-1\n", "scene/disks.csv:4: mass must be positive"),
                ("disks_csv", DISKS + "2,4,1,1\n", "scene/disks.csv:4: 4 fields, but there are 5 columns"),
                ("disks_csv", "", "scene/disks.csv: the file is empty"),
                ("disks_csv", "id,x,y,radius\n", "scene/disks.csv:1: column mass is missing"),
                ("disks_csv", "id,x,y,radius,mass,id\n", "scene/disks.csv:1: column id is given twice"),
                ("walls_csv", "id,px,py,nx,ny\n0,0,0,0,2\n", "scene/walls.csv:2: the normal (0, 2) must have length 1"),
                ("contacts_csv", CONTACTS + "0,-1,0.3,1,0\n", "scene/contacts.csv:5: this contact is given twice"),
                ("contacts_csv", CONTACTS + "0,0,0.3,1,0\n", "scene/contacts.csv:5: disk 0 cannot touch itself"),
                ("contacts_csv", CONTACTS + "-1,-1,0.3,1,0\n", "scene/contacts.csv:5: a wall cannot touch a wall"),
                ("contacts_csv", CONTACTS + "7,-1,0.3,1,0\n", "scene/contacts.csv:5: column a: there is no disk 7"),
                ("contacts_csv", "a,b,mu\n0,-1,-0.3\n", "scene/contacts.csv:2: mu must not be negative"),
                ("contacts_csv", "a,b,mu,nx,ny\n1,0,0.3,0,1\n", "scene/contacts.csv:2: the normal (0, 1) disagrees"),
                ("walls_csv", "id,px,py,nx,ny,name\n0,0,0,0,1,W\udce4nde\n",
                 "scene/walls.csv:2: the byte 0xE4 is not UTF-8 text (it may be Latin-1): save the file as UTF-8"),
                ("walls_csv", "id,px,py,nx,ny\n0,0,1.5,0,1\n",
                 "scene/contacts.csv:2: the centre of disk 0 is behind wall 0: does the normal (0, 1) point into the domain?"),
                ("walls_csv", "id,px,py,nx,ny\n0,0,-27,0,1\n",
                 "scene/contacts.csv:2: disk 0 and wall 0 are 27 apart, more than the radius 1: they do not touch"),
                ("walls_csv", "id,px,py,nx,ny\n0,0,2,0,1\n", "scene/contacts.csv:2: the centre of disk 0 is behind wall 0"),
                ("disks_csv", DISKS.replace("1,2,1,1,1", "1,29,1,1,1"),
                 "scene/contacts.csv:4: disk 1 and disk 0 are 27 apart, more than the radius 1: they do not touch"),
                ("disks_csv", DISKS.replace(",", ";").replace("1;2;1;1;1", "1;2,5;1.0;1;1"),
                 'scene/disks.csv:3: the number "1.0" has another decimal mark than "2,5" in line 3'),
                ("disks_csv", DISKS + "2,4,5,1,1,1\n", "scene/disks.csv:4: 6 fields, but there are 5 columns (id, x, y, "
                                                      "radius, mass); decimal commas are read only where semicolons"),
                ("disks_csv", "sep=|\n" + DISKS, "scene/disks.csv:1: fields are separated by commas, semicolons or tabs"),
                ("scene_toml", "gravity = [0, 0]\n", "gravity: --gravity 0,-1, which most disks want instead of 0,0"),
        ]:
            with self.subTest(message):
                self.write_scene(**{part: text})
                done = self.run_indet("import", "--format", "csv", "scene", "-o", "p.h5", status=3)
                self.assertIn(message, done.stderr)
                self.assertEqual(done.stdout, "")
                self.assertEqual(self.files(), ["scene"])

    def test_forces_that_do_not_balance_are_refused(self):
        self.write_scene(contacts_csv=CONTACTS.replace("1,-1,0.3,1,0", "1,-1,0.3,1.5,0"))
        done = self.run_indet("import", "--format", "csv", "scene", "-o", "p.h5", status=3)
        self.assertIn("the forces do not balance: on disk 1 the net force is 0.5 mg", done.stderr)
        self.assertIn("--balance-tol", done.stderr)
        self.assertEqual(self.files(), ["scene"])
        self.run_indet("import", "--format", "csv", "scene", "-o", "p.h5", "--balance-tol", "1")
        self.assertEqual(self.files(), ["p.h5", "scene"])

    def test_unknown_forces_are_said_to_be_unknown(self):
        self.write_scene(contacts_csv="a,b,mu\n0,-1,0.3\n1,-1,0.3\n")
        done = self.run_indet("import", "--format", "csv", "scene", "-o", "p.h5")
        self.assertIn("the forces are unknown", done.stdout)

    def test_tables_in_other_hands_give_the_same_packing(self):
        """As Excel writes them in Germany and elsewhere, and pandas with its index."""
        def german(text):
            return text.replace(",", ";").replace(".", ",").replace("\n", "\r\n")

        def pandas(text):
            header, *rows = text.splitlines()
            return "\n".join(["," + header, *(f"{i},{row}" for i, row in enumerate(rows))]) + "\n"

        digests = set()
        for name, other in [("plain", str), ("german", german), ("sep", lambda text: "sep=,\r\n" + text),
                            ("sep_german", lambda text: "\ufeffsep=;\r\n" + german(text)), ("pandas", pandas),
                            ("tabs", lambda text: text.replace(",", "\t"))]:
            self.write_scene(disks_csv=other(DISKS.replace("1,2,1,1,1", "1,2.0,1.0,1.00,10e-1")), walls_csv=other(WALLS),
                             contacts_csv=other(CONTACTS))
            self.run_indet("import", "--format", "csv", "scene", "-o", f"{name}.h5")
            with h5py.File(self.folder / f"{name}.h5") as file:
                digests.add(file.attrs["content_sha256"])
        self.assertEqual(len(digests), 1)

    def test_forces_that_are_known_in_part_are_checked_where_all_of_a_disk_are(self):
        """Some forces of the LAMMPS packing are taken away, and one of those that stay is wrong. What is reported is
        compared with a balance of our own."""
        self.import_lammps("--friction", "0.3")
        self.run_indet("export", "p.h5", "--format", "csv", "-o", "known")
        disks, contacts = (pd.read_csv(self.folder / "known" / f"{name}.csv") for name in ("disks", "contacts"))
        rng = np.random.default_rng(3)
        contacts.loc[rng.random(len(contacts)) < 0.1, ["R", "T"]] = np.nan
        contacts.loc[rng.random(len(contacts)) < 0.1, "T"] = np.nan
        contacts.loc[contacts.R.idxmax(), "R"] += 0.01

        row = dict(zip(disks.id, range(len(disks))))
        net = np.column_stack([np.zeros(len(disks)), -disks.mass, np.zeros(len(disks))]) / disks.mass.mean()
        for c in contacts.itertuples():
            force = np.array([c.R * c.nx + c.T * c.ny, c.R * c.ny - c.T * c.nx]) / disks.mass.mean()
            for body, sign in [(c.a, 1), (c.b, -1)]:
                if body >= 0:
                    net[row[body]] += [*(sign * force), c.T / disks.mass.mean()]
        complete = np.isfinite(net).all(axis=1)
        worst = np.hypot(net[:, 0], net[:, 1])
        self.assertTrue(20 < complete.sum() < 200)
        self.assertTrue(0.005 / disks.mass.mean() < worst[complete].max())

        contacts.to_csv(self.folder / "known" / "contacts.csv", index=False)
        done = self.run_indet("import", "--format", "csv", "known", "-o", "q.h5", status=3)
        self.assertIn(f"the net force is {worst[complete].max():.3g} mg", done.stderr)
        arguments = ["import", "--format", "csv", "known", "-o", "q.h5", "--balance-tol", "0.1"]
        report = json.loads(self.run_indet(*arguments, "--json").stdout)
        known = contacts[["R", "T"]].notna().to_numpy().sum()
        self.assertFalse(report["forces_known"])
        self.assertEqual((report["known_forces"], report["checked_disks"]), (known, complete.sum()))
        np.testing.assert_allclose(report["force_residual"], worst[complete].max(), rtol=1e-9)
        np.testing.assert_allclose(report["torque_residual"], np.abs(net[complete, 2]).max(), atol=1e-12)
        self.assertIn(f"{known} of 752 forces known; their balance was checked on {complete.sum()} of 220 disks, which "
                      "have all of them\n", self.run_indet(*arguments).stdout)
        text = self.run_indet("inspect", "q.h5").stdout
        self.assertIn(f"  simulated forces  {known} of 752 known; all of them on {complete.sum()} of 220 disks\n", text)
        self.assertIn(f"  balance           force to {worst[complete].max():.1e} mg", text)
        self.run_indet("export", "q.h5", "-o", "q.svg")
        self.assertIn(f"{known} of 752 forces known", (self.folder / "q.svg").read_text() +
                      self.run_indet("export", "q.h5", "-o", "q.svg", "--json").stdout)

    def test_coulomb_violations_are_a_warning(self):
        done = self.import_lammps("--friction", "0.1")
        self.assertRegex(done.stderr, r"warning: \d+ of 376 contacts violate the Coulomb conditions")

    def test_a_real_lammps_packing(self):
        report = json.loads(self.import_lammps("--friction", "0.3", "--json").stdout)
        self.assertEqual((report["disks"], report["contacts"]), (220, 376))
        self.assertLess(report["force_residual"], 2e-11)
        self.assertLess(report["torque_residual"], 1e-14)
        self.assertEqual(report["warnings"], [])
        with h5py.File(self.folder / "p.h5") as file:
            self.assertEqual(file["parameters"].attrs["mu"], 0.3)
            self.assertEqual(file["contacts/normal"].shape, (376, 2))
            self.assertIn("--friction", list(file["provenance"].attrs["argv"]))

    def test_what_a_dump_does_not_say_must_be_given(self):
        self.assertIn("--friction", self.import_lammps(status=2).stderr)
        done = self.import_lammps("--friction", "0.3", "--timestep", "5", status=3)
        self.assertIn("there is no frame of timestep 5", done.stderr)
        done = self.import_lammps("--friction", "0.3", "--columns", "fx", status=2)
        self.assertIn("must have the form NAME=COLUMN", done.stderr)
        done = self.import_lammps("--friction", "0.3", "--gravity", "0,-2", status=3)
        self.assertIn("the forces do not balance", done.stderr)
        self.assertEqual(self.files(), [])

    def test_usage_errors(self):
        self.run_indet("import", "--format", "csv", "scene", status=2)
        for arguments in [["xml", "scene"], ["csv"], ["csv", "scene", "--friction", "0.3"], ["lammps", "scene"],
                          ["lammps", "--friction", "0.3"]]:
            self.run_indet("import", "--format", *arguments, "-o", "p.h5", status=2)


if __name__ == "__main__":
    unittest.main(verbosity=0)
