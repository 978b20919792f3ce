"""A Slurm cluster of several nodes on this machine, for as long as a test lasts.

Needs slurmctld, slurmd and their commands (Debian: slurm-wlm), and to be root; neither systemd nor munge. All it writes
is in a temporary folder. Nodes are processes of this host with ports of their own, so that several clusters can run side
by side.
"""

import contextlib
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import tempfile
import time

START = 60  # seconds that a cluster may take to come up; it is 1 to 7


def missing():
    """Why there can be no cluster here, or nothing."""
    if os.geteuid() != 0:
        return "only root can start slurmd"
    for command in ("slurmctld", "slurmd", "sbatch", "scontrol", "squeue", "sinfo", "scancel"):
        if shutil.which(command) is None:
            return f"there is no {command} (package slurm-wlm)"
    return ""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def configuration(folder, nodes, ports, processors, extra, partitions):
    lines = [
        "ClusterName=loopback", "SlurmctldHost=localhost(127.0.0.1)", f"SlurmctldPort={ports[0]}",
        "SlurmUser=root", "SlurmdUser=root", "AuthType=auth/none", "CredType=cred/none",
        "AuthInfo=cred_expire=5",  # else a requeued task does not start again for two minutes
        f"StateSaveLocation={folder}/state", f"SlurmdSpoolDir={folder}/spool/%n",
        f"SlurmctldPidFile={folder}/ctld.pid", f"SlurmdPidFile={folder}/slurmd.%n.pid",
        f"SlurmctldLogFile={folder}/log/ctld", f"SlurmdLogFile={folder}/log/slurmd.%n",
        "ProctrackType=proctrack/pgid", "TaskPlugin=task/none", "JobAcctGatherType=jobacct_gather/none",
        "AccountingStorageType=accounting_storage/none", "JobCompType=jobcomp/none", "SelectType=select/cons_tres",
        "SelectTypeParameters=CR_Core", "SwitchType=switch/none", "MpiDefault=none", "ReturnToService=2",
        "SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0,sched_min_interval=0", "KillWait=5",
        "MinJobAge=300", "SlurmdTimeout=10", "MessageTimeout=10", "InactiveLimit=0", "Waittime=0", "JobRequeue=1", *extra]
    for number in range(1, nodes + 1):
        lines.append(f"NodeName=node{number} NodeHostname={socket.gethostname()} NodeAddr=127.0.0.1 Port={ports[number]} "
                     f"CPUs={processors} CoresPerSocket={processors} RealMemory=1000 State=UNKNOWN")
    lines += partitions or [f"PartitionName=all Nodes=node[1-{nodes}] Default=YES MaxTime=INFINITE State=UP"]
    return "\n".join(lines) + "\n"


class Cluster:
    def __init__(self, folder, nodes):
        self.folder = folder
        self.nodes = nodes
        self.environment = {**{key: value for key, value in os.environ.items() if not key.startswith("SLURM")},
                            "SLURM_CONF": str(folder / "slurm.conf")}
        self.processes = {}  # by name: "controller", "node1", ...

    def start(self, name, command):
        with open(self.folder / f"log/{name}.out", "wb") as log:
            self.processes[name] = subprocess.Popen(command, env=self.environment, stdout=log, stderr=subprocess.STDOUT)

    def start_node(self, number):
        self.start(f"node{number}", ["slurmd", "-D", "-N", f"node{number}", "-f", self.environment["SLURM_CONF"]])

    def run(self, *command, cwd=None, timeout=60):
        """Runs a command beside the cluster; returns what it printed."""
        done = subprocess.run(command, cwd=cwd, env=self.environment, timeout=timeout, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        if done.returncode != 0:
            raise RuntimeError(f"{command}: status {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout

    def wait_until(self, condition, seconds, what):
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end:
                raise TimeoutError(f"{what}\n{self.run('squeue', '-a')}{self.run('sinfo')}{self.tails()}")
            time.sleep(0.1)

    def tails(self):
        return "".join(f"== {path}\n{path.read_text(errors='replace')[-2000:]}" for path in sorted((self.folder / "log").iterdir()))

    def idle_nodes(self):
        done = subprocess.run(["sinfo", "-h", "-N", "-t", "idle", "-o", "%N"], env=self.environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        return set(done.stdout.split())

    def jobs(self):
        """(job, state) of all that are not over, each task of an array on its own."""
        return [tuple(line.split()) for line in self.run("squeue", "-h", "-r", "-o", "%i %T").splitlines()]

    def wait_for_jobs(self, seconds=120):
        self.wait_until(lambda: not self.jobs(), seconds, "jobs do not end")

    def kill_node(self, number):
        """As a node that loses its power: slurmd and all that it started end without a word."""
        daemon = self.processes[f"node{number}"]
        for process in [daemon.pid, *self.offspring(f"node{number}")]:  # the daemon first: it would tell
            with contextlib.suppress(ProcessLookupError):
                os.kill(process, signal.SIGKILL)
        daemon.wait()

    def stop(self):
        for name in sorted(self.processes, reverse=True):  # nodes first
            self.processes[name].terminate()
        for process in self.processes.values():
            try:
                process.wait(timeout=10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        for process, _ in self.running():  # jobs, and slurmstepd, outlive slurmd
            with contextlib.suppress(ProcessLookupError):
                os.kill(process, signal.SIGKILL)

    def running(self):
        """(process id, environment) of all that was started with this cluster's environment, here or by a node."""
        mark = f"SLURM_CONF={self.folder}/slurm.conf".encode()
        found = []
        for entry in pathlib.Path("/proc").iterdir():
            if entry.name.isdigit():
                with contextlib.suppress(OSError):
                    environment = (entry / "environ").read_bytes().split(b"\0")
                    if mark in environment:
                        found.append((int(entry.name), environment))
        return found

    def offspring(self, node):
        """Process ids of what a node runs: slurmstepd first, which would tell of the end of the others."""
        steps, found = set(), []
        for process, environment in self.running():
            if f"SLURMD_NODENAME={node}".encode() not in environment:
                continue
            with contextlib.suppress(OSError):
                parent = int(pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[1])
                if pathlib.Path(f"/proc/{parent}/cmdline").read_bytes().startswith(b"slurmstepd"):
                    steps.add(parent)
                found.append(process)
        return [*steps, *(process for process in found if process not in steps)]


@contextlib.contextmanager
def cluster(nodes, processors=1, extra=(), partitions=()):
    """A cluster whose nodes are all idle; it ends with the block, whatever happens in it."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="slurm."))
    one = Cluster(folder, nodes)
    try:
        for name in ("state", "spool", "log", *(f"spool/node{number}" for number in range(1, nodes + 1))):
            (folder / name).mkdir()
        (folder / "slurm.conf").write_text(
            configuration(folder, nodes, free_ports(nodes + 1), processors, extra, partitions))
        one.start("controller", ["slurmctld", "-D", "-i", "-f", str(folder / "slurm.conf")])
        for number in range(1, nodes + 1):
            one.start_node(number)
        end = time.monotonic() + START
        while len(one.idle_nodes()) < nodes:
            if time.monotonic() > end:
                raise TimeoutError("the cluster does not come up\n" + one.tails())
            time.sleep(0.1)
        yield one
    finally:
        one.stop()
        shutil.rmtree(folder, ignore_errors=True)
