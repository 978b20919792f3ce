"""Data flows one way: the includes of each stage are what CMake says that it depends on.

Arguments: the root of the repository. With --write, the list in docs/ARCHITECTURE.md is made anew.
"""

import pathlib
import re
import sys
import tempfile
import unittest

import includes

WRITE = "--write" in sys.argv
if WRITE:
    sys.argv.remove("--write")
ROOT = pathlib.Path(sys.argv.pop()).resolve()
PAGE = ROOT / "docs/ARCHITECTURE.md"
LIST = re.compile(r"(<!-- stages -->\n```text\n)(.*?)(```\n)", re.DOTALL)

# The only files that include the header of a C library, or one that shows it.
BEHIND_HDF5_FILE = {f"libindet/io/{name}" for name in (
    "content_digest.cc", "content_digest.h", "hdf5_file.cc", "hdf5_guard.cc", "hdf5_guard.h", "hdf5_session.cc",
    "hdf5_writing.cc", "hdf5_writing.h")}
WRAPPERS = {
    "glpk.h": {"libindet/lp/glpk_problem.cc"},
    "hdf5.h": {"libindet/io/hdf5_session.h"},
    "libindet/io/content_digest.h": BEHIND_HDF5_FILE,
    "libindet/io/hdf5_guard.h": BEHIND_HDF5_FILE,
    "libindet/io/hdf5_session.h": BEHIND_HDF5_FILE,
    "libindet/io/hdf5_writing.h": BEHIND_HDF5_FILE,
    "openssl/evp.h": {"libindet/io/sha256.cc"},
    "zlib.h": {"libindet/io/gzip.cc"},
    "pugixml.hpp": {"libindet/io/yade_archive.cc"},
    "cairo.h": {"libindet/drawing/canvas.cc"},
    "SuiteSparseQR.hpp": {"libindet/nullspace/sparse_qr.cc"},
}


class Direction(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stages = includes.read_stages(ROOT)

    def test_the_includes_of_a_stage_are_its_depends(self):
        self.assertGreater(len(self.stages), 15)
        for name, stage in self.stages.items():
            with self.subTest(name):
                self.assertEqual(stage.includes, stage.depends)

    def test_no_stage_leads_back_to_itself(self):
        self.assertEqual(set(includes.in_order(self.stages)), set(self.stages))

    def test_libraries_include_nothing_of_the_program(self):
        for path in includes.sources(ROOT, "libindet", "libsim"):
            for quoted, name in includes.included(ROOT / path):
                self.assertFalse(quoted and name.startswith(("apps/", "tests/", "bench/")), f"{path}: {name}")

    def test_every_include_is_the_path_of_a_file_from_the_root(self):
        for path in includes.sources(ROOT, *includes.CODE):
            for quoted, name in includes.included(ROOT / path):
                if quoted:
                    self.assertTrue((ROOT / name).is_file(), f"{path}: {name}")
                else:
                    self.assertFalse(name.startswith(("libindet/", "libsim/", "apps/")), f"{path}: {name}")

    def test_the_simulators_see_the_packing_type_alone(self):
        self.assertEqual(self.stages["sim"].depends, {"base", "packing"})

    def test_the_checker_includes_nothing_of_the_solver(self):
        self.assertFalse(self.stages["verify"].includes & {"equilibrium", "nullspace", "lp", "pivoting", "polytope"})

    def test_each_library_has_one_wrapper(self):
        for path in includes.sources(ROOT, "libindet", "libsim", "apps"):
            for _, name in includes.included(ROOT / path):
                wrappers = WRAPPERS.get(name)
                self.assertTrue(wrappers is None or str(path) in wrappers, f"{path} includes {name}")

    def test_the_list_in_the_documents_is_made_from_the_includes(self):
        page = PAGE.read_text()
        made = includes.arrows(self.stages)
        if WRITE:
            PAGE.write_text(LIST.sub(lambda found: found[1] + made + found[3], page))
        self.assertEqual(LIST.search(PAGE.read_text())[2], made)


class Reader(unittest.TestCase):
    """The reader of includes finds what is wrong."""

    def tree(self, files):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        root = pathlib.Path(folder.name)
        for name, text in files.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        return includes.read_stages(root)

    def test_an_include_that_is_not_among_the_depends_is_seen(self):
        stages = self.tree({"libindet/a/CMakeLists.txt": "indet_add_stage(a SOURCES a.cc)\n",
                            "libindet/a/a.cc": '#include "libindet/b/b.h"\n',
                            "libindet/b/CMakeLists.txt": "indet_add_stage(b SOURCES b.cc DEPENDS a\n  LIBRARIES a::b)\n",
                            "libindet/b/b.h": "\n"})
        self.assertEqual((stages["a"].includes, stages["a"].depends), ({"b"}, set()))
        self.assertEqual((stages["b"].includes, stages["b"].depends), (set(), {"a"}))

    def test_a_circle_is_seen(self):
        stages = self.tree({"libindet/a/CMakeLists.txt": "indet_add_stage(a SOURCES a.cc DEPENDS b)\n",
                            "libindet/a/a.cc": '#include "libindet/b/b.h"\n',
                            "libindet/b/CMakeLists.txt": "indet_add_stage(b SOURCES b.cc DEPENDS a)\n",
                            "libindet/b/b.h": '#include "libindet/a/a.h"\n'})
        with self.assertRaisesRegex(ValueError, "a circle among a, b"):
            includes.in_order(stages)


if __name__ == "__main__":
    unittest.main(verbosity=0)
