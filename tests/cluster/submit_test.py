"""`indet submit` on a cluster of four nodes: the result of one machine, whatever befalls tasks and nodes.

Arguments: the indet executable, the test case. Status 77 (skipped) where there can be no cluster.
"""

import collections
import json
import pathlib
import subprocess
import sys
import time

sys.path[:0] = [str(pathlib.Path(__file__).parent.parent / "support"), str(pathlib.Path(__file__).parent)]
import loopback_cluster
import program

ENSEMBLE = ["ensemble", "--seeds", "8", "--disks", "20", "--samples", "20"]
MEMBERS = 32
ARRAY = "1"  # the first job of a cluster


class ClusterTest(program.ProgramTest):
    def submit(self, cluster, *arguments, tasks=4):
        """Submits the ensemble to a cluster with this folder as the current one."""
        return json.loads(cluster.run(program.INDET, "submit", *ENSEMBLE, "--out", "shared folder", "--tasks", str(tasks), "--json",
                                      "--run", *arguments, cwd=self.folder))

    def records(self):
        return [json.loads(path.read_text()) for path in (self.folder / "shared folder/tasks").iterdir()]

    def wait_for(self, cluster, condition, what):
        cluster.wait_until(condition, 60, what)

    def finished(self):
        return sum(len(record["done"]) for record in self.records()) if (self.folder / "shared folder/tasks").exists() else 0

    def lives_on(self, node):
        tasks = json.loads(self.run_indet("status", "shared folder", "--json").stdout)["tasks"]
        return [task["alive"] for task in tasks if f"on {node}" in task["job"]]

    def logs(self):
        return "".join(path.read_text() for path in sorted((self.folder / "shared folder/cluster/log").iterdir()))

    def check(self, interrupted=0):
        """The result is that of one process; only what was in hand at an interruption may be computed twice."""
        self.run_indet(*ENSEMBLE, "--out", "alone")
        self.assertEqual(program.content(self.folder / "shared folder/ensemble.h5"),
                         program.content(self.folder / "alone/ensemble.h5"), self.logs())
        self.assertTrue((self.folder / "shared folder/report.html").exists(), self.logs())
        computed = collections.Counter(item["name"] for record in self.records() for item in record["done"])
        self.assertLessEqual(sum(computed.values()), MEMBERS + interrupted, computed)
        for record in self.records():
            for item in record["done"]:
                self.assertNotIn("simulate_start", item["seconds"], "a CD-1 packing was simulated again")
        status = json.loads(self.run_indet("status", "shared folder", "--json").stdout)
        self.assertEqual((status["done"], status["running"], status["stale"], status["failed"], status["collected"]),
                         (MEMBERS, 0, 0, 0, True))
        return computed


class Submit(ClusterTest):
    def test_the_result_is_that_of_one_machine(self):
        with loopback_cluster.cluster(4) as cluster:
            report = self.submit(cluster)
            self.assertEqual((report["items"], report["tasks"], len(report["jobs"])), (MEMBERS, 4, 2))
            cluster.wait_for_jobs()
        computed = self.check()
        self.assertEqual(set(computed.values()), {1})
        shards = {record["shard"] for record in self.records() if record["done"]}
        self.assertEqual(shards, {f"shard {number}/4" for number in range(1, 5)})
        for record in self.records():  # seeds stay together
            seeds = collections.Counter(item["name"].split("-")[1] for item in record["done"])
            self.assertLessEqual(set(seeds.values()), {4})

    def test_a_cancelled_task_stays_cancelled(self):
        with loopback_cluster.cluster(2) as cluster:
            self.submit(cluster, tasks=2)
            self.wait_for(cluster, lambda: self.finished() > 2, "nothing is finished")
            cluster.run("scancel", f"{ARRAY}_2")
            cluster.wait_for_jobs()
        self.assertNotIn("back into the queue", self.logs())
        self.check(interrupted=1)


    def test_a_test_that_fails_leaves_nothing_running(self):
        with self.assertRaisesRegex(RuntimeError, "fails"), loopback_cluster.cluster(1) as cluster:
            cluster.run("sbatch", "--wrap", "sleep 1000", cwd=self.folder)
            self.wait_for(cluster, lambda: any(state == "RUNNING" for _, state in cluster.jobs()), "it does not start")
            raise RuntimeError("fails")
        self.assertFalse(cluster.folder.exists())
        cluster.wait_until(lambda: not cluster.running(), 5, "something runs on")


class Analysis(ClusterTest):
    def test_the_ranges_of_one_packing_are_those_of_one_process(self):
        self.run_indet("simulate", "--protocol", "cd1", "--disks", "200", "--seed", "1", "-o", "p.h5")
        self.run_indet("analyze", "p.h5", "--method", "barrier", "-o", "alone.h5")
        with loopback_cluster.cluster(4) as cluster:
            report = json.loads(cluster.run(program.INDET, "submit", "analyze", "p.h5", "--method", "barrier", "--out", "shared folder",
                                            "--tasks", "8", "--json", "--run", cwd=self.folder))
            self.assertEqual(report["tasks"], 8)
            cluster.wait_for_jobs()
        self.assertEqual(program.content(self.folder / "shared folder/ranges.h5"), program.content(self.folder / "alone.h5"), self.logs())
        computed = collections.Counter(item["name"] for record in self.records() for item in record["done"])
        self.assertEqual((len(computed), set(computed.values())), (report["items"], {1}))
        self.assertEqual({record["shard"] for record in self.records() if record["done"]},
                         {f"shard {number}/8" for number in range(1, 9)})
        status = json.loads(self.run_indet("status", "shared folder", "--json").stdout)
        self.assertEqual((status["kind"], status["done"], status["collected"]), ("analysis", report["items"], True))


class Signals(ClusterTest):
    def test_tasks_that_are_signalled_go_on_where_they_were(self):
        with loopback_cluster.cluster(4) as cluster:
            self.submit(cluster)
            self.wait_for(cluster, lambda: self.finished() >= 4, "nothing is finished")
            signals = 0
            while any(job.startswith(ARRAY + "_") for job, _ in cluster.jobs()):
                subprocess.run(["scancel", "--signal=USR1", "--batch", ARRAY], env=cluster.environment,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # it may be between two starts
                signals += 1
                self.assertLess(signals, 40, self.logs())
                time.sleep(2.5)
            cluster.wait_for_jobs()
        self.assertGreater(signals, 1)
        self.assertIn("back into the queue", self.logs())
        stopped = sum(record["state"] == "stopped" for record in self.records())
        self.assertGreater(stopped, 0)
        self.check(interrupted=stopped)


class Preemption(ClusterTest):
    def test_tasks_that_are_preempted_go_on_where_they_were(self):
        partition = "Nodes=node[1-4] MaxTime=INFINITE State=UP PriorityTier"
        with loopback_cluster.cluster(
                4, extra=["PreemptType=preempt/partition_prio", "PreemptMode=REQUEUE"],
                partitions=[f"PartitionName=all Default=YES {partition}=1 PreemptMode=REQUEUE",
                            f"PartitionName=urgent {partition}=10 PreemptMode=OFF"]) as cluster:
            self.submit(cluster)
            self.wait_for(cluster, lambda: self.finished() >= 4, "nothing is finished")
            cluster.run("sbatch", "--partition=urgent", "--nodes=2", "--wrap", "sleep 1", cwd=self.folder)
            cluster.wait_for_jobs()
        self.assertIn("DUE TO PREEMPTION", self.logs())
        stopped = sum(record["state"] == "stopped" for record in self.records())
        self.assertEqual(stopped, 2, self.logs())
        self.check(interrupted=stopped)


class DeadNode(ClusterTest):
    def test_another_node_takes_over(self):
        with loopback_cluster.cluster(4) as cluster:
            self.submit(cluster)
            self.wait_for(cluster, lambda: self.finished() >= 2, "nothing is finished")
            cluster.kill_node(2)
            self.wait_for(cluster, lambda: True not in self.lives_on("node2"), "status does not see that the task is dead")
            cluster.wait_for_jobs()
        self.assertEqual(sum(record["state"] == "running" for record in self.records()), 1)  # the dead one
        self.check(interrupted=1)


class TimeLimit(ClusterTest):
    def test_tasks_that_are_cut_by_their_limit_go_on_where_they_were(self):
        """Each task has a minute of work, and a start has half of one: the limit of two less the time for its end."""
        arguments = ["ensemble", "--seeds", "8", "--disks", "95", "--samples", "500"]
        with loopback_cluster.cluster(2) as cluster:
            cluster.run(program.INDET, "submit", *arguments, "--out", "shared folder", "--tasks", "2", "--time", "2", "--run",
                        cwd=self.folder)
            cluster.wait_for_jobs(600)
        self.assertGreater(self.logs().count("back into the queue"), 1)
        subprocess.run([program.INDET, *arguments, "--out", "alone"], cwd=self.folder, check=True, timeout=900,
                       stdout=subprocess.DEVNULL)
        self.assertEqual(program.content(self.folder / "shared folder/ensemble.h5"),
                         program.content(self.folder / "alone/ensemble.h5"), self.logs())
        computed = collections.Counter(item["name"] for record in self.records() for item in record["done"])
        print(f"{len(self.records())} starts, {self.logs().count('back into the queue')} of them cut")
        self.assertEqual(set(computed.values()), {1}, computed)


if __name__ == "__main__":
    reason = loopback_cluster.missing()
    if reason:
        print(f"skipped: {reason}")
        sys.exit(77)
    program.main()
