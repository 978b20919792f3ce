"""Every subcommand that computes for long is stopped while it does, and leaves no file.

The stages of a subcommand are told apart by the processor time that it has had: the inputs are so large that the stage
goes on long after the signal.
"""

import json
import math
import pathlib
import shutil
import signal
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

ANSWER = 1.5  # seconds; it is 0.2 on a machine with nothing else to do


def triangle(rows):
    """A triangular pyramid of disks between two walls."""
    height = math.sqrt(3)
    number = {}
    for j in range(rows):
        for i in range(rows - j):
            number[i, j] = len(number)
    contacts = [f"{number[i, 0]},-1" for i in range(rows)] + [f"{number[0, 0]},-2", f"{number[rows - 1, 0]},-3"]
    for (i, j), a in number.items():
        contacts += [f"{a},{number[other]}" for other in ((i + 1, j), (i, j + 1), (i - 1, j + 1)) if other in number]
    disks = [f"{k},{2 * i + j},{1 + j * height!r},1,1" for (i, j), k in number.items()]
    return {"disks.csv": "\n".join(["id,x,y,radius,mass", *disks, ""]),
            "contacts.csv": "\n".join(["a,b", *contacts, ""]),
            "walls.csv": f"id,px,py,nx,ny,name\n0,0,0,0,1,floor\n1,-1,0,1,0,left\n2,{2 * rows - 1},0,-1,0,right\n",
            "scene.toml": "gravity = [0, -1]\nmu = 0.5\n"}


class Signals(program.ProgramTest):
    def test_every_long_stage_is_stopped(self):
        self.write("large", triangle(110))
        self.write("triangle", triangle(40))
        for name in ("large", "triangle"):
            self.run_indet("import", "--format", "csv", name, "-o", f"{name}.h5")
        self.run_indet("simulate", "--protocol", "md1", "--disks", "95", "-o", "p.h5")
        self.run_indet("simulate", "--protocol", "cd1", "--disks", "220", "-o", "q.h5")
        self.run_indet("analyze", "p.h5", "-o", "r.h5")
        runs = [  # processor time (s) before the signal, and the run
            (0, "import --format csv large -o out"),
            (0.3, "analyze triangle.h5 --method lp -o out"),  # the polytope, dense
            (0.3, "analyze large.h5 -o out"),  # the polytope, sparse
            (1.5, "analyze q.h5 --accuracy exact -o out"),  # exact proofs
            (0.3, "analyze p.h5 --method pivoting-paper -o out"),
            (0.3, "compare p.h5"),
            (0.5, "sample triangle.h5 --method uniform -o out"),  # the polytope
            (0.5, "sample p.h5 --method uniform --effective 1000000 -o out"),  # the walk
            (0.1, "sample p.h5 --samples 1000000 -o out"),
            (0.3, "verify r.h5 --exact"),
            (0.3, "simulate --protocol cd1 --disks 2000 -o out"),  # leaves a checkpoint
            (0.1, "export large.h5 -o out.svg"),
            (0.3, "ensemble --seeds 50 -o e"),
        ]
        inputs = set(self.files())
        for index, (seconds, run) in enumerate(runs):
            number = (signal.SIGINT, signal.SIGTERM)[index % 2]
            for left in set(self.files()) - inputs:
                shutil.rmtree(self.folder / left) if (self.folder / left).is_dir() else (self.folder / left).unlink()
            with self.subTest(run, number=number):
                process = subprocess.Popen([program.INDET, *run.split()], cwd=self.folder,
                                           stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                self.addCleanup(process.kill)
                program.wait_until_under_way(process, number, seconds)
                sent = time.monotonic()
                process.send_signal(number)
                _, errors = process.communicate(timeout=20)
                answered = time.monotonic() - sent
                self.assertEqual(process.returncode, 128 + number, errors)
                self.assertLess(answered, ANSWER)
                self.assertIn("indet: interrupted; ", errors)
                for left in set(self.files()) - inputs:
                    self.assertIn(left, ("e", "out.checkpoint"))
                if (self.folder / "e").exists():
                    self.assertEqual(sorted(path.name for path in (self.folder / "e").iterdir()),
                                     ["ensemble.toml", "members", "tasks"])
                    self.assertEqual(list((self.folder / "e/members").iterdir()), [])
                    record = json.loads(next((self.folder / "e/tasks").iterdir()).read_text())
                    self.assertEqual((record["state"], record["in_hand"]), ("stopped", []))


if __name__ == "__main__":
    program.main()
