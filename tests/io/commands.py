"""Running import, inspect and export as a user does.

Arguments: the indet executable, the LAMMPS dumps, the folder with the files of write_samples.
"""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

SAMPLES, DATA, INDET = (sys.argv.pop() for _ in range(3))
program.INDET = INDET

DISKS = "id,x,y,radius,mass\n0,0,1,1,1\n1,2,1,1,1\n"
WALLS = "id,px,py,nx,ny\n0,0,0,0,1\n"
CONTACTS = "a,b,mu,R,T\n0,-1,0.3,1,0\n1,-1,0.3,1,0\n1,0,0.3,0,0\n"
SCENE = "gravity = [0, -1]\n"


class CommandTest(program.ProgramTest):
    def write_scene(self, **changed):
        texts = {"disks.csv": DISKS, "walls.csv": WALLS, "contacts.csv": CONTACTS, "scene.toml": SCENE}
        scene = self.folder / "scene"
        scene.mkdir(exist_ok=True)
        for name, text in texts.items():
            (scene / name).write_text(changed.get(name.replace(".", "_"), text), errors="surrogateescape")

    def import_lammps(self, *arguments, status=0):
        return self.run_indet("import", "--format", "lammps", "--atoms", f"{DATA}/atoms.dump", "--contacts",
                              f"{DATA}/contacts.dump", *arguments, "-o", "p.h5", status=status)
