"""The comparisons of documents and pictures must be able to fail."""

import pathlib
import tempfile
import unittest

from comparison import same_line, same_text
from pictures import difference

IMAGES = pathlib.Path(__file__).parents[2] / "docs/images"


class Lines(unittest.TestCase):
    def test_what_a_reader_takes_for_the_same_is_the_same(self):
        for shown, printed in [("δR  17.23 mg", "δR 17.23 mg"), ("0.2062", "0.2061"), ("-0.2062", "-0.2063"),
                               ("largest residual 2.0e-15", "largest residual 1.1e-14"),
                               ("largest residual 2.0e-15", "largest residual 0.0e+00"),
                               ("bounds 5.5e-07 mg apart", "bounds 9.1e-07 mg apart"),
                               ("written to r.h5 (30.41 s)", "written to r.h5 (2.00 s)"),
                               ("radius r = 11.23 ± 0.16 mg", "radius r = 11.05 ± 0.14 mg"),
                               ("converged after 512 sweeps, fewest of T of contact 11",
                                "converged after 640 sweeps, fewest of R of contact 3"),
                               ("  1.2° 16 7.519 34.92 2.158 12.8 15.1 0.02821 27 0",
                                "  1.2° 16 7.519 34.92 2.158 12.8 15.3 0.02821 26.2 0"),
                               ("contents " + "0" * 64, "contents " + "f" * 64), ("max inf", "max inf")]:
            self.assertTrue(same_line(shown, printed), f"{shown} / {printed}")
        self.assertTrue(same_text(["a", "…", "d"], ["a", "b", "c", "d"]))
        self.assertTrue(same_text(["…", "d"], ["d"]))

    def test_what_differs_differs(self):
        for shown, printed in [
                ("δR  17.23 mg", "δT  17.23 mg"), ("17.23", "-17.23"), ("0.2062", "0.2064"), ("max inf", "max 3"),
                ("max inf", "max -inf"), ("1504 certified", "certified"), ("1504 certified", "1503 certified"),
                # Counts are compared whatever they count.
                ("rank 657", "rank 658"), ("865 extremal states", "866 extremal states"),
                ("16 of 1504 extrema", "17 of 1504 extrema"), ("96706 checks", "96707 checks"),
                ("1561 linear programs, 60337 pivots", "1561 linear programs, 60338 pivots"),
                # Small numbers are compared too.
                ("residual 2.0e-15", "residual 2.0e-13"), ("residual 2.0e-13", "residual 2.0e-15"),
                ("residual 2.0e-12", "residual 0.0e+00"), ("residual 2.0e-15", "residual 2.0e-03"),
                ("residual 2.0e-15", "residual -2.0e-15"), ("known to 1e-08 rad", "known to 1e-07 rad"),
                ("known to 1e-08 rad", "known to 3e-08 rad"), ("good to 1.5e-05 mg", "good to 1.9e-05 mg"),
                ("radius r = 11.23 ± 0.16 mg", "radius r = 23.05 ± 0.14 mg"), ("radius r = 11.23", "radius r = -11.23"),
                ("converged after 512 sweeps", "NOT converged after 512 sweeps"),
                ("radius r = 11.23 mg", "norm ‖F‖: 11.23 mg"), ("radius q = 11.23 mg", "radius q = 11.05 mg"),
                ("just before 16 7.519 34.92 2.158 12.8 15.1 0.02821 27 0",
                 "just before 16 7.529 34.92 2.158 12.8 15.1 0.02821 27 0"),
                ("  just before 16 7.519 34.92 2.158 12.8 15.1 0.02821 27 0",
                 "  just before 16 7.519 34.92 2.158 12.8 15.1 0.02931 27 0"),
                ("0.0000002", "0.0000009"), ("step 10 s.d. 3", "step 10 s.d. 4"), ("seed 10", "seed 11")]:
            self.assertFalse(same_line(shown, printed), f"{shown} / {printed}")
        self.assertFalse(same_text(["a", "…", "d"], ["a", "b", "c"]))
        self.assertFalse(same_text(["a"], ["a", "b"]))
        self.assertFalse(same_text(["a", "b"], ["a"]))


class Pictures(unittest.TestCase):
    def changed(self, name, old, new):
        """The difference between a picture and a copy in which the last `old` is `new`."""
        text = (IMAGES / name).read_text()
        head, found, tail = text.rpartition(old)
        self.assertTrue(found, old)
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / "copy.svg"
            copy.write_text(head + new + tail)
            return difference(IMAGES / name, copy)

    def test_a_picture_is_the_same_as_itself(self):
        for picture in IMAGES.glob("*.svg"):
            self.assertIsNone(difference(picture, picture))

    def test_last_digits_and_names_of_letters_do_not_matter(self):
        for picture in IMAGES.glob("*.svg"):
            self.assertIsNone(self.changed(picture.name, "</svg>", "<!-- drawn today -->\n</svg>"))
        self.assertIsNone(self.changed("delta-R.svg", "#glyph0-1", "#glyph9-1"))
        self.assertIsNone(self.changed("delta-R.svg", "stroke-width:0.4;", "stroke-width:0.45;"))

    def test_the_order_of_lines_does_not_matter_but_their_number_does(self):
        line, other = '<path d="M 0 0 L 9 9"/>', '<path d="M 0 0 L 9 0"/>'
        with tempfile.TemporaryDirectory() as folder:
            one, two, three = (pathlib.Path(folder) / name for name in ("1.svg", "2.svg", "3.svg"))
            one.write_text(f"<svg>{line}{other}</svg>")
            two.write_text(f"<svg>{other}{line}</svg>")
            three.write_text(f"<svg>{other}{other}</svg>")
            self.assertIsNone(difference(one, two))
            self.assertIsNotNone(difference(one, three))

    def test_pictures_of_different_things_differ(self):
        first, second = sorted(IMAGES.glob("*.svg"))[:2]
        self.assertIsNotNone(difference(first, second))

    def test_a_colour_a_position_a_width_a_line_and_a_word_matter(self):
        self.assertIn("stroke", self.changed("delta-R.svg", "stroke:rgb(", "stroke:rgb(7"))
        letter = '<use xlink:href="#glyph0-1" x="'
        self.assertIn("<use> x", self.changed("delta-R.svg", letter, letter + "1"))
        self.assertIn("stroke-width", self.changed("delta-R.svg", "stroke-width:0.4;", "stroke-width:0.9;"))
        self.assertIn("elements", self.changed("delta-R.svg", "</svg>", '<path d="M 0 0 L 9 9"/></svg>'))
        self.assertIn("density", self.changed("local-indeterminacy.svg", "probability density", "density"))
        self.assertIn("<path>", self.changed("local-indeterminacy.svg", " L", " L9"))


if __name__ == "__main__":
    unittest.main(verbosity=0)
