"""Runs indet, and measures what it takes."""
import json
import os
import subprocess


def run(indet, *arguments, report=False):
    """Processor time of a subcommand, its largest memory in MB (what the caller holds at least), and, if asked for, its report
    in JSON. Status 5 (uncertain) counts as done."""
    command = [indet, "--threads", "1", *map(str, arguments), "--quiet"] + (["--json"] if report else [])
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                               env=os.environ | {"OPENBLAS_NUM_THREADS": "1"})
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 5):
        raise RuntimeError(f"{arguments}: status {process.returncode}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, json.loads(output) if report else None
