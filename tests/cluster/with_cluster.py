"""Runs a command beside a cluster: with_cluster.py NODES PROCESSORS COMMAND…; status 77 where there can be none."""

import subprocess
import sys

import loopback_cluster

if __name__ == "__main__":
    nodes, processors, *command = sys.argv[1:]
    reason = loopback_cluster.missing()
    if reason:
        print(f"skipped: {reason}")
        sys.exit(77)
    with loopback_cluster.cluster(int(nodes), int(processors)) as cluster:
        status = subprocess.run(command, env=cluster.environment).returncode
    sys.exit(status)
