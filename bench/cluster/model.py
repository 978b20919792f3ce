#!/usr/bin/python3
"""How far an ensemble on a cluster goes: a model of the queue with measured costs.

usage: bench/cluster/model.py [TABLE.tsv] [PICTURE.svg]

Prints the table of docs/cluster.md and draws its picture. Each task has the seeds that `indet ensemble --shard` deals to it, and a node
of its own. It starts as in array.sh: within its time limit it starts no packing that would probably not be finished, and goes
back into the queue if that leaves some. What a node has in hand when it fails is lost. When all tasks are over, one more
job collects.
"""
import csv
import dataclasses
import heapq
import pathlib
import random
import statistics
import sys

HOUR = 3600
YEAR = 8766 * HOUR
RESERVE = 90  # seconds that indet keeps free at the end of a job
DETECTION = 300  # Slurm's SlurmdTimeout: a node that is silent for so long is down
REQUEUE = 150  # Slurm starts no job again within two minutes of its last start (cred_expire), and looks at the queue every half minute


class Measured:
    """The table of measure.py."""

    def __init__(self, path):
        with open(path, newline="") as file:
            self.rows = list(csv.DictReader(file, delimiter="\t"))

    def of(self, what, disks=None):
        """(packings, contacts, seconds, MB), by number of packings."""
        found = [row for row in self.rows if row["measurement"].startswith(what) and disks in (None, int(row["disks"]))]
        return sorted((int(r["packings"]), int(r["contacts"]), float(r["seconds"]), float(r["MB"] or 0)) for r in found)

    def costs(self, disks):
        """Seconds of the packings, by protocol."""
        protocols = ("cd1", "cd2", "md1", "md2")
        return [[seconds for _, _, seconds, _ in self.of(f"packing {p}-", disks)] for p in protocols]

    def contacts(self, disks):
        return statistics.mean(contacts for _, contacts, _, _ in self.of("packing ", disks))

    def per(self, what, column):
        """Growth of seconds (0) or MB (1) with the number of packings and with that of contacts: those of three disks, which have
        six contacts, tell the first, those of 95 disks the second."""
        (few, _, *least), (many, _, *most) = self.of(what, 3)[-2:]
        a = (most[column] - least[column]) / (many - few)
        (few, few_contacts, *least), (many, many_contacts, *most) = self.of(what, 95)[-2:]
        return a, max(0.0, (most[column] - least[column] - a * (many - few)) / (many_contacts - few_contacts))

    def collecting(self, packings, disks, column=0):
        a, b = self.per("collect", column)
        return a * packings + b * packings * self.contacts(disks)

    def starting(self, packings):
        """Of a task: it lists the plan of the whole ensemble, and looks at the packings of its own share."""
        few, _, many = self.of("start of a task")
        return few[2] + (many[2] - few[2]) / (many[0] - few[0]) * packings


@dataclasses.dataclass
class Scenario:
    name: str
    disks: int = 95
    seeds: int = 25000
    tasks: int = 1000
    slots: int = 1000  # tasks at a time
    limit: float = 24 * HOUR
    failures: float = 0  # of a node, a year
    launches: float = 1  # jobs that Slurm starts a second: an assumption, as clusters differ


@dataclasses.dataclass
class Outcome:
    work: float = 0  # seconds of all packings
    busy: float = 0  # seconds of all starts of tasks
    starts: int = 0
    failures: int = 0
    lost: float = 0  # seconds of work in hand that was computed again
    end: float = 0  # of the last task
    collecting: float = 0


def run_once(costs, estimates, left, startup, scenario, failure):
    """One start of a task. Returns the seconds that it lasts, the packings that it does, and the seconds that are lost."""
    elapsed, done, pace = startup, 0, 0  # the pace is that of the slowest so far, as a multiple of its estimate
    for cost, estimate in zip(costs[-left:], estimates[-left:]):
        if done > 0 and elapsed + pace * estimate > scenario.limit - RESERVE:
            break
        if elapsed + cost > min(failure, scenario.limit):
            return min(failure, scenario.limit), done, min(failure, scenario.limit) - elapsed
        elapsed += cost
        done += 1
        pace = max(pace, cost / estimate)
    return elapsed, done, 0


def simulate(scenario, measured, seed=1):
    chance = random.Random(seed)
    by_protocol = measured.costs(scenario.disks)
    means = [statistics.mean(costs) for costs in by_protocol]
    shares = [[] for _ in range(scenario.tasks)]
    for number in range(scenario.seeds):  # seeds cost the same by estimate, and go around
        shares[number % scenario.tasks] += [(chance.choice(costs), mean) for costs, mean in zip(by_protocol, means)]
    packings = 4 * scenario.seeds
    startup = measured.starting(packings)
    outcome = Outcome(work=sum(cost for share in shares for cost, _ in share), collecting=startup + measured.collecting(packings, scenario.disks))
    left = [len(share) for share in shares]
    ready = [(0.0, task) for task in range(scenario.tasks)]  # when a task may start
    free = [0.0] * scenario.slots  # when a slot is free
    heapq.heapify(free)
    launch = 0.0
    while ready:
        may, task = heapq.heappop(ready)
        begin = launch = max(may, heapq.heappop(free), launch + 1 / scenario.launches)
        failure = chance.expovariate(scenario.failures / YEAR) if scenario.failures > 0 else float("inf")
        share = shares[task]
        seconds, done, lost = run_once([c for c, _ in share], [e for _, e in share], left[task], startup, scenario, failure)
        left[task] -= done
        failed = seconds == failure
        outcome.starts += 1
        outcome.failures += failed
        outcome.busy += seconds
        outcome.lost += lost
        outcome.end = max(outcome.end, begin + seconds)
        heapq.heappush(free, begin + seconds + (DETECTION if failed else 0))
        if left[task] > 0:
            heapq.heappush(ready, (begin + seconds + (DETECTION if failed else 0) + REQUEUE, task))
    return outcome


SCENARIOS = (
    Scenario("95 disks"),
    Scenario("400 disks", disks=400),
    Scenario("400 disks, 100 tasks", disks=400, tasks=100, slots=100),
    Scenario("400 disks, 200 tasks at a time", disks=400, slots=200),
    Scenario("400 disks, time limit 30 min", disks=400, limit=HOUR / 2),
    Scenario("400 disks, each node fails once a year", disks=400, failures=1),
    Scenario("400 disks, each node fails every third day", disks=400, failures=120),
    Scenario("400 disks, time limit 30 min, each node fails every third day", disks=400, failures=120, limit=HOUR / 2),
    Scenario("95 disks, a million packings", seeds=250000),
    Scenario("400 disks, 10 000 tasks", disks=400, tasks=10000, slots=10000),
    Scenario("400 disks, 10 000 tasks, of which ten start a second", disks=400, tasks=10000, slots=10000, launches=10),
)


def by_default(packings, disks, measured):
    """Tasks of half an hour, and at most a thousand, as `indet submit` makes them."""
    work = packings * statistics.mean(map(statistics.mean, measured.costs(disks)))
    tasks = min(1000, max(1, round(work / (HOUR / 2))))
    return Scenario("", disks=disks, seeds=packings // 4, tasks=tasks, slots=tasks)


def duration(seconds):
    if seconds < 120:
        return f"{seconds:.0f} s"
    if seconds < 2 * HOUR:
        return f"{seconds / 60:.0f} min"
    return f"{seconds / HOUR:.0f} h" if seconds > 100 * HOUR else f"{seconds / HOUR:.1f} h"


def print_table(measured):
    print("| packings of | work | until the last task ends | collection | starts | nodes that fail | computed twice |\n"
          "|---|---|---|---|---|---|---|")
    for scenario in SCENARIOS:
        o = simulate(scenario, measured)
        print(f"| {scenario.name} | {duration(o.work)} | {duration(o.end)} | {duration(o.collecting)} | {o.starts} | {o.failures} | "
              f"{100 * o.lost / o.work:.2f} % |")


def draw(measured, path):
    import matplotlib
    matplotlib.use("svg")
    import matplotlib.pyplot as plt
    plt.rcParams.update({"svg.hashsalt": "cluster", "font.size": 9, "axes.spines.top": False, "axes.spines.right": False})
    counts = [1000, 3000, 10**4, 3 * 10**4, 10**5, 3 * 10**5, 10**6]
    figure, (time, memory) = plt.subplots(1, 2, figsize=(8.4, 4))
    for disks, colour in ((95, "C0"), (400, "C1")):
        time.plot(counts, [simulate(by_default(n, disks, measured), measured).end for n in counts], "-", color=colour,
                  label=f"all tasks, {disks} disks")
        time.plot(counts, [measured.collecting(n, disks) for n in counts], "--", color=colour, label=f"collection, {disks} disks")
        memory.plot(counts, [measured.collecting(n, disks, 1) / 1000 for n in counts], "--", color=colour, label=f"{disks} disks")
    time.plot(counts, [measured.starting(n) for n in counts], ":", color="C2", label="start of each task")
    for axes in (time, memory):
        axes.set(xscale="log", yscale="log", xlabel="packings")
    time.set_yticks([1, 60, HOUR, 24 * HOUR], ["1 s", "1 min", "1 h", "1 day"])
    time.minorticks_off()
    memory.set(ylabel="GB that the collection takes")
    for axes in (time, memory):
        axes.legend(frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2, fontsize=8)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def main():
    root = pathlib.Path(__file__).parent.parent.parent / "docs"
    measured = Measured(sys.argv[1] if len(sys.argv) > 1 else root / "measurements/cluster.tsv")
    print_table(measured)
    draw(measured, sys.argv[2] if len(sys.argv) > 2 else root / "measurements/cluster.svg")


if __name__ == "__main__":
    main()
