"""What VTK's own reader finds in files of ranges and in those that `export --format vtkhdf` writes.

Arguments: the indet executable, the LAMMPS dumps.
"""

import pathlib
import sys

import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkCommonDataModel import VTK_LINE, vtkDataObject
from vtkmodules.vtkFiltersCore import vtkCellDataToPointData, vtkGlyph3D, vtkTubeFilter
from vtkmodules.vtkFiltersGeneral import vtkShrinkFilter
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkFiltersSources import vtkGlyphSource2D
from vtkmodules.vtkIOHDF import vtkHDFReader

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

DATA = ""
OF_CONTACTS = {"body_a", "body_b", "gap", "mu", "R", "T"}


def arrays(data):
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}


class Grid:
    """The output of vtkHDFReader, and what it complained of."""

    def __init__(self, path):
        self.errors = []
        reader = vtkHDFReader()
        for event in (vtkCommand.ErrorEvent, vtkCommand.WarningEvent):
            reader.AddObserver(event, lambda *_: self.errors.append(event))
        self.readable = reader.CanReadFile(str(path))
        reader.SetFileName(str(path))
        reader.Update()
        self.data = reader.GetOutput()
        self.type = self.data.GetClassName()
        self.points = vtk_to_numpy(self.data.GetPoints().GetData())
        cells = self.data.GetCells()
        self.ends = vtk_to_numpy(cells.GetConnectivityArray()).reshape(-1, 2)
        self.types = {self.data.GetCellType(i) for i in range(self.data.GetNumberOfCells())}
        self.point_data = arrays(self.data.GetPointData())
        self.cell_data = arrays(self.data.GetCellData())


class Vtk(program.ProgramTest):
    def grid(self, name):
        grid = Grid(self.folder / name)
        self.assertTrue(grid.readable)
        self.assertEqual(grid.errors, [])
        self.assertEqual(grid.type, "vtkUnstructuredGrid")
        return grid

    def import_lammps(self):
        self.run_indet("import", "--format", "lammps", "--atoms", f"{DATA}/atoms.dump", "--contacts",
                       f"{DATA}/contacts.dump", "--friction", "0.3", "-o", "p.h5")

    def assert_is_the_packing(self, grid, file):
        """Disks, feet and lines, and the numbers of contacts that every file has."""
        position, radius = file["particles/disks/position"][()], file["particles/disks/radius"][()]
        a, b = file["contacts/body_a"][()], file["contacts/body_b"][()]
        of_walls = b < 0
        wall = -(b[of_walls] + 1)
        normal, point = file["walls/normal"][()][wall], file["walls/point"][()][wall]
        centre = position[a[of_walls]]
        feet = centre - np.sum((centre - point) * normal, axis=1)[:, None] * normal
        np.testing.assert_allclose(grid.points[:, :2], np.concatenate([position, feet]), atol=1e-14 * np.abs(position).max())
        self.assertTrue((grid.points[:, 2] == 0).all())
        np.testing.assert_array_equal(grid.point_data["radius"], np.concatenate([radius, np.zeros(len(feet))]))
        np.testing.assert_array_equal(grid.point_data["body"], np.concatenate([np.arange(len(radius)), b[of_walls]]))
        end = b.copy()
        end[of_walls] = len(radius) + np.arange(len(feet))
        np.testing.assert_array_equal(grid.ends, np.stack([a, end], axis=1))
        self.assertLessEqual(grid.types, {VTK_LINE})
        for name in OF_CONTACTS - {"R", "T"}:
            np.testing.assert_array_equal(grid.cell_data[name], file["contacts"][name][()], name)

    def test_a_file_of_ranges_is_one_of_vtk(self):
        self.run_indet("simulate", "--protocol", "cd1", "--disks", "12", "--seed", "3", "-o", "p.h5")
        self.run_indet("analyze", "p.h5", "--smallest-distances", "-o", "r.h5")
        self.run_indet("export", "r.h5", "--format", "vtkhdf")
        self.assertIn("r.vtkhdf", self.files())
        with h5py.File(self.folder / "r.h5") as file:
            contacts = len(file["contacts/R"])
            columns = {name for name, data in file["ranges"].items() if data.shape[0] == contacts}
            self.assertLessEqual({"R_min", "T_max", "delta_R", "d_T", "outcome", "lower", "unique", "ray", "d_T_min", "d_min_lower"},
                                 columns)
            for name in ("r.h5", "r.vtkhdf"):
                grid = self.grid(name)
                self.assert_is_the_packing(grid, file)
                self.assertEqual(set(grid.cell_data), OF_CONTACTS | columns)
                for column in columns:
                    np.testing.assert_array_equal(grid.cell_data[column], file["ranges"][column][()], column)
                for column in ("R", "T"):
                    np.testing.assert_array_equal(grid.cell_data[column], file["contacts"][column][()], column)
            # In the file of ranges they are not stored twice.
            for column in columns - {"outcome", "d_min_outcome"}:
                self.assertEqual(file["VTKHDF/CellData"][column], file["ranges"][column], column)
            self.assertEqual(file["VTKHDF/CellData/R"], file["contacts/R"])

    def test_fixed_disks_and_levers(self):
        """A disk between two fixed ones, one of which has a lever of its own; and none of both, as above."""
        scene = {"disks.csv": "id,x,y,radius,mass,fixed\n0,0,0,1,1,\n5,-1,-1.7320508075688772,1,,1\n7,1,-1.7320508075688772,1,,1\n",
                 "contacts.csv": "a,b,lever_a,lever_b\n0,5,0.9,0.8\n7,0,,\n", "scene.toml": "mu = 0.3\n"}
        self.run_indet("analyze", self.packing(scene), "-o", "r.h5")
        self.run_indet("export", "r.h5", "-o", "r.vtkhdf")
        self.run_indet("verify", "r.h5")
        with h5py.File(self.folder / "r.h5") as file:
            for name in ("r.h5", "r.vtkhdf"):
                grid = self.grid(name)
                self.assert_is_the_packing(grid, file)
                np.testing.assert_array_equal(grid.point_data["fixed"], [0, 1, 1])
                np.testing.assert_array_equal(grid.cell_data["lever_a"], [0.9, np.nan])
                np.testing.assert_array_equal(grid.cell_data["lever_b"], [0.8, np.nan])
        with h5py.File(self.folder / "r.h5", "r+") as file:
            file["VTKHDF/PointData/fixed"][1] = 0
        self.assertIn("point 1: it is not where", self.run_indet("verify", "r.h5", status=5).stdout)

    def test_unbounded_and_unknown_values(self):
        """A disk between two vertical walls can be jammed: R_max = inf. Of an empty polytope all is NaN."""
        jammed = {"disks.csv": "id,x,y,radius,mass\n0,0,0,1,1\n", "contacts.csv": "a,b\n0,-1\n0,-2\n",
                  "walls.csv": "id,px,py,nx,ny\n0,-1,0,1,0\n1,1,0,-1,0\n", "scene.toml": "mu = 0.5\n"}
        self.run_indet("analyze", self.packing(jammed, name="j"), "-o", "r.h5")
        grid = self.grid("r.h5")
        np.testing.assert_array_equal(grid.cell_data["R_max"], [np.inf, np.inf])
        np.testing.assert_allclose(grid.cell_data["R_min"], [1, 1], rtol=1e-9)
        self.assertTrue(np.isnan(grid.cell_data["R"]).all())
        np.testing.assert_array_equal(grid.cell_data["outcome"][:, 1], [1, 1])
        self.run_indet("analyze", self.packing(program.incline(), name="i"), "-o", "e.h5", status=4)
        grid = self.grid("e.h5")
        self.assertTrue(np.isnan(grid.cell_data["R_max"]).all())
        np.testing.assert_array_equal(grid.cell_data["outcome"], np.full((1, 4), 4))

    def test_the_forces_are_those_of_the_state(self):
        self.run_indet("analyze", self.packing(program.pyramid()), "-o", "r.h5")
        self.run_indet("export", "r.h5", "--state", "R_max:4", "-o", "s.vtkhdf")
        grid = self.grid("s.vtkhdf")
        with h5py.File(self.folder / "r.h5") as file:
            state = file["extremal/states"][file["ranges/vertex"][4, 1]].reshape(-1, 2)
            self.assert_is_the_packing(grid, file)
        np.testing.assert_array_equal(grid.cell_data["R"], state[:, 0])
        np.testing.assert_array_equal(grid.cell_data["T"], state[:, 1])
        self.assertEqual(grid.cell_data["R"][4], grid.cell_data["R_max"][4])

    def test_a_packing_without_ranges_and_one_without_contacts(self):
        self.packing(program.pyramid())
        self.run_indet("export", "p.h5", "-o", "p.vtkhdf")
        grid = self.grid("p.vtkhdf")
        with h5py.File(self.folder / "p.h5") as file:
            self.assert_is_the_packing(grid, file)
        self.assertEqual(set(grid.cell_data), OF_CONTACTS)
        self.write("l", {"disks.csv": "id,x,y,radius,mass\n0,3,4,0.5,1\n", "contacts.csv": "a,b,mu\n"})
        self.run_indet("import", "--format", "csv", "l", "--balance-tol", "2", "-o", "l.h5")
        self.run_indet("export", "l.h5", "-o", "l.vtkhdf")
        grid = self.grid("l.vtkhdf")
        np.testing.assert_array_equal(grid.points, [[3, 4, 0]])
        np.testing.assert_array_equal(grid.point_data["radius"], [0.5])
        self.assertEqual(grid.data.GetNumberOfCells(), 0)

    def test_large_tables_are_compressed_and_read(self):
        rows = "\n".join(f"{i},{3 * i},1,1,1" for i in range(9000))
        scene = {"disks.csv": f"id,x,y,radius,mass\n{rows}\n", "walls.csv": "id,px,py,nx,ny\n0,0,0,0,1\n",
                 "contacts.csv": "a,b,mu,R,T\n" + "".join(f"{i},-1,0.5,1,0\n" for i in range(9000))}
        self.run_indet("export", self.packing(scene), "-o", "p.vtkhdf")
        with h5py.File(self.folder / "p.vtkhdf") as file:
            self.assertEqual(file["VTKHDF/CellData/R"].compression, "gzip")
        grid = self.grid("p.vtkhdf")
        with h5py.File(self.folder / "p.h5") as file:
            self.assert_is_the_packing(grid, file)
            np.testing.assert_array_equal(grid.cell_data["R"], file["contacts/R"][()])

    def test_the_pipelines_of_the_documentation(self):
        """Glyphs are circles of the radius of the disks; tubes are as thick as the force of their contact."""
        self.import_lammps()
        self.run_indet("export", "p.h5", "-o", "p.vtkhdf")
        grid = self.grid("p.vtkhdf")
        source = vtkGlyphSource2D()
        source.SetGlyphTypeToCircle()
        source.FilledOff()
        source.SetResolution(64)
        glyph = vtkGlyph3D()
        glyph.SetInputData(grid.data)
        glyph.SetSourceConnection(source.GetOutputPort())
        glyph.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "radius")
        glyph.SetScaleModeToScaleByScalar()
        glyph.SetScaleFactor(2)
        glyph.Update()
        circles = vtk_to_numpy(glyph.GetOutput().GetPoints().GetData()).reshape(len(grid.points), -1, 3)
        distance = np.linalg.norm(circles - grid.points[:, None], axis=2)
        expected = grid.point_data["radius"][:, None]
        np.testing.assert_allclose(distance, np.broadcast_to(expected, distance.shape), atol=1e-5 * expected.max())

        shrink = vtkShrinkFilter()  # gives each line its own ends
        shrink.SetInputData(grid.data)
        shrink.SetShrinkFactor(1)
        to_points = vtkCellDataToPointData()
        to_points.SetInputConnection(shrink.GetOutputPort())
        surface = vtkGeometryFilter()
        surface.SetInputConnection(to_points.GetOutputPort())
        surface.PassThroughCellIdsOn()  # its threads may return the lines in any order
        tube = vtkTubeFilter()
        tube.SetInputConnection(surface.GetOutputPort())
        tube.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "R")
        tube.SetVaryRadiusToVaryRadiusByAbsoluteScalar()
        tube.SetNumberOfSides(8)
        tube.Update()
        sides = vtk_to_numpy(tube.GetOutput().GetPoints().GetData()).reshape(len(grid.ends), 2, 8, 3)
        contact = arrays(tube.GetOutput().GetCellData())["vtkOriginalCellIds"][::8]
        np.testing.assert_array_equal(np.sort(contact), np.arange(len(grid.ends)))
        ends = grid.points[grid.ends[contact]]
        thickness = np.linalg.norm(sides - ends[:, :, None], axis=3)
        R = grid.cell_data["R"][contact, None, None]
        np.testing.assert_allclose(thickness, np.broadcast_to(R, thickness.shape), atol=1e-5 * R.max())

    def test_such_a_file_is_no_packing(self):
        self.packing(program.pyramid())
        self.run_indet("export", "p.h5", "-o", "p.vtkhdf")
        for command in (["analyze"], ["inspect"], ["verify"], ["export"]):
            done = self.run_indet(*command, "p.vtkhdf", status=3)
            self.assertIn("p.vtkhdf: holds contacts for readers of VTK, not a packing", done.stderr)

    def test_another_dataset_in_place_of_a_link_is_noticed(self):
        self.run_indet("analyze", self.packing(program.pyramid()), "-o", "r.h5")
        text = self.run_indet("verify", "r.h5").stdout
        self.assertIn(" 0 contradictions", text)
        with h5py.File(self.folder / "r.h5", "r+") as file:
            values = file["ranges/R_max"][()]
            del file["VTKHDF/CellData/R_max"]
            file["VTKHDF/CellData/R_max"] = values + 1
        done = self.run_indet("verify", "r.h5", status=5)
        self.assertIn("/VTKHDF: CellData/R_max: it is not /ranges/R_max", done.stdout)
        self.assertIn("content_sha256", done.stdout)


if __name__ == "__main__":
    program.main("DATA")
